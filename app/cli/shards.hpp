#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "core/scene/sharded_study.hpp"

/// Where the shards of studies are kept: OUT/STUDY.shards/3_of_8.states.
namespace pliant::cli {

/// From "3/8". Throws base::InputError.
base::Shard shardOf(const std::string& text);

std::filesystem::path shardFile(const std::filesystem::path& out, const std::string& study, const base::Shard& shard);
bool hasShards(const std::filesystem::path& out, const std::string& study);
/// The files of all shards in their order. Throws base::InputError if some are not there, or are of different counts.
std::vector<std::filesystem::path> allShardFiles(const std::filesystem::path& out, const std::string& study);

/// Throws base::InputError if the study cannot be split.
const scene::ShardedStudy& sharded(const scene::Study& study);

}  // namespace pliant::cli
