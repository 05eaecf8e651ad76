#include "core/scene/boundary_shards.hpp"

#include "core/base/error.hpp"

namespace pliant::scene {

base::TerminationType runBoundaryShard(const interlock::BoundarySubject& subject,
                                       const interlock::BoundaryOptions& options, const std::string& key,
                                       const base::Shard& shard, const std::filesystem::path& file,
                                       base::ExecutionContext& context) {
  interlock::BoundaryFile memory(file, key);
  return interlock::computeRays(subject, options, shard, context, memory);
}

void readBoundaryShards(const interlock::BoundarySubject& subject, const interlock::BoundaryOptions& options,
                        const std::string& key, const std::vector<std::filesystem::path>& files,
                        interlock::KnownStates& known) {
  for (const std::filesystem::path& file : files)
    if (!known.read(file, key))
      throw base::InputError(file.string(), "This shard is not of the scene and study as they are now; run it again.");
  if (const auto missing = interlock::missingRays(subject, options, known); !missing.empty())
    throw base::InputError(files[static_cast<std::size_t>(missing.front()) % files.size()].string(),
                           "This shard is not finished: " + std::to_string(missing.size()) +
                               " limits are missing in all shards together. Run it again; it goes on where it was.");
}

}  // namespace pliant::scene
