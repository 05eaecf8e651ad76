#include "app/cli/shards.hpp"

#include <charconv>
#include <map>
#include <optional>

#include "core/base/error.hpp"

namespace pliant::cli {

namespace fs = std::filesystem;
using base::InputError;

namespace {

constexpr int mostShards = 100'000;

fs::path shardFolder(const fs::path& out, const std::string& study) { return out / (study + ".shards"); }

/// Two numbers with `between` between them, the first from 1 up to the second.
std::optional<base::Shard> parsed(const std::string& text, const std::string& between) {
  const std::size_t split = text.find(between);
  if (split == std::string::npos) return std::nullopt;
  base::Shard shard;
  const auto read = [](const char* first, const char* last, int& number) {
    const auto [end, error] = std::from_chars(first, last, number);
    return error == std::errc() && end == last;
  };
  const char* begin = text.data();
  if (!read(begin, begin + split, shard.index) ||
      !read(begin + split + between.size(), begin + text.size(), shard.count))
    return std::nullopt;
  if (shard.index < 1 || shard.index > shard.count || shard.count > mostShards) return std::nullopt;
  return shard;
}

}  // namespace

base::Shard shardOf(const std::string& text) {
  if (const auto shard = parsed(text, "/")) return *shard;
  throw InputError("--shard " + text, "Expected a number and the count of shards, such as 3/8.");
}

fs::path shardFile(const fs::path& out, const std::string& study, const base::Shard& shard) {
  return shardFolder(out, study) / (std::to_string(shard.index) + "_of_" + std::to_string(shard.count) + ".states");
}

bool hasShards(const fs::path& out, const std::string& study) { return fs::is_directory(shardFolder(out, study)); }

std::vector<fs::path> allShardFiles(const fs::path& out, const std::string& study) {
  const fs::path folder = shardFolder(out, study);
  std::map<int, fs::path> files;
  int count = 0;
  if (hasShards(out, study))
    for (const fs::directory_entry& entry : fs::directory_iterator(folder)) {
      const auto shard = parsed(entry.path().stem().string(), "_of_");
      if (!shard || entry.path().extension() != ".states") continue;
      if (count != 0 && shard->count != count)
        throw InputError(folder.string(), "There are shards of " + std::to_string(std::min(count, shard->count)) +
                                              " and of " + std::to_string(std::max(count, shard->count)) +
                                              "; remove those that are not meant.");
      count = shard->count;
      files[shard->index] = entry.path();
    }
  if (files.empty()) throw InputError(folder.string(), "There are no shards; compute them with `run --shard` first.");
  std::vector<fs::path> all;
  for (int index = 1; index <= count; ++index) {
    if (!files.contains(index))
      throw InputError(folder.string(), "Shard " + std::to_string(index) + " of " + std::to_string(count) +
                                            " is missing, of " +
                                            std::to_string(count - static_cast<int>(files.size())) + " that are.");
    all.push_back(files[index]);
  }
  return all;
}

const scene::ShardedStudy& sharded(const scene::Study& study) {
  if (const scene::ShardedStudy* split = study.sharded()) return *split;
  throw InputError("study " + study.name(),
                   "A " + study.type() + " cannot be split into shards; name studies that can with --study.");
}

}  // namespace pliant::cli
