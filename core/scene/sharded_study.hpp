#pragma once

#include <filesystem>
#include <memory>
#include <vector>

#include "core/base/shard.hpp"
#include "core/scene/study.hpp"

namespace pliant::scene {

/// What a study is as well if several processes can share its work.
class ShardedStudy {
 public:
  virtual ~ShardedStudy() = default;
  /// Computes one share and keeps it in `file`, going on with what is there.
  virtual base::TerminationType runShard(const base::Shard& shard, const std::filesystem::path& file,
                                         base::ExecutionContext& context) const = 0;
  /// The result of the whole, the same bytes (but for times) as without shards; `files` are those of all shards in
  /// their order. Throws base::InputError if one of them is not there, not finished, or of another scene or study.
  virtual std::shared_ptr<const Result> merge(const std::vector<std::filesystem::path>& files,
                                              base::ExecutionContext& context) const = 0;
};

}  // namespace pliant::scene
