#pragma once

#include "core/base/shard.hpp"
#include "core/interlock/boundary_file.hpp"

/// How studies of boundaries share their work among processes.
namespace pliant::scene {

/// Computes the rays of one shard into `file`, going on with what is there under the same key.
base::TerminationType runBoundaryShard(const interlock::BoundarySubject& subject,
                                       const interlock::BoundaryOptions& options, const std::string& key,
                                       const base::Shard& shard, const std::filesystem::path& file,
                                       base::ExecutionContext& context);

/// Reads all of them. Throws base::InputError with the file as location if one has another key, or lacks rays.
void readBoundaryShards(const interlock::BoundarySubject& subject, const interlock::BoundaryOptions& options,
                        const std::string& key, const std::vector<std::filesystem::path>& files,
                        interlock::KnownStates& known);

}  // namespace pliant::scene
