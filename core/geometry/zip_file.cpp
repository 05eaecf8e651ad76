#include "core/geometry/zip_file.hpp"

#include <zip.h>

#include <memory>

#include "core/base/error.hpp"
#include "core/base/pending_file.hpp"

namespace pliant::geometry {

namespace {

constexpr std::uint16_t firstOfJanuary1980 = 1 << 5 | 1;

struct ZipDeleter {
  void operator()(zip_source_t* source) const { zip_source_free(source); }
  void operator()(zip_t* archive) const { zip_discard(archive); }
};
using ZipSource = std::unique_ptr<zip_source_t, ZipDeleter>;
using ZipArchive = std::unique_ptr<zip_t, ZipDeleter>;

}  // namespace

void writeZip(const std::vector<ZipEntry>& entries, const std::filesystem::path& file) {
  const auto check = [&](bool good) {
    if (!good) throw base::InputError(file.string(), "The archive cannot be made.");
  };
  const ZipSource memory(zip_source_buffer_create(nullptr, 0, 0, nullptr));
  check(memory != nullptr);
  ZipArchive archive(zip_open_from_source(memory.get(), ZIP_TRUNCATE, nullptr));
  check(archive != nullptr);
  zip_source_keep(memory.get());  // closing the archive lets go of it once
  for (const auto& [name, bytes] : entries) {
    ZipSource source(zip_source_buffer(archive.get(), bytes.data(), bytes.size(), 0));
    check(source != nullptr);
    const zip_int64_t index = zip_file_add(archive.get(), name.c_str(), source.get(), ZIP_FL_ENC_UTF_8);
    check(index >= 0);
    (void)source.release();  // the archive's now
    check(zip_file_set_dostime(archive.get(), static_cast<zip_uint64_t>(index), 0, firstOfJanuary1980, 0) == 0);
  }
  check(zip_close(archive.get()) == 0);
  (void)archive.release();

  zip_stat_t size;
  check(zip_source_stat(memory.get(), &size) == 0 && zip_source_open(memory.get()) == 0);
  std::string bytes(size.size, '\0');
  check(zip_source_read(memory.get(), bytes.data(), bytes.size()) == static_cast<zip_int64_t>(bytes.size()));
  zip_source_close(memory.get());
  base::writeFile(file, bytes);
}

}  // namespace pliant::geometry
