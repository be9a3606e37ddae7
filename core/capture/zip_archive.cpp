#include "core/capture/zip_archive.h"

#include <zip.h>

#include <utility>

#include "core/base/regular_file.h"

namespace scantrove {

struct ZipArchive::Handle {
  zip_t* archive = nullptr;
  std::string name;
};

ZipArchive::ZipArchive(std::unique_ptr<Handle> handle) : handle_(std::move(handle)) {}

ZipArchive::~ZipArchive() { zip_discard(handle_->archive); }

Result<std::shared_ptr<ZipArchive>> ZipArchive::open(const std::filesystem::path& file) {
  SCANTROVE_TRY(checkRegularFile(file));
  int code = 0;
  zip_t* const archive = zip_open(file.c_str(), ZIP_RDONLY, &code);
  if (archive == nullptr) {
    zip_error_t error;
    zip_error_init_with_code(&error, code);
    const std::string reason = zip_error_strerror(&error);
    zip_error_fini(&error);
    return fail(file.string() + " cannot be read as a zip archive (" + reason + ").",
                "Was it copied completely from the device?");
  }
  auto handle = std::make_unique<Handle>();
  handle->archive = archive;
  handle->name = file.string();
  return std::shared_ptr<ZipArchive>(new ZipArchive(std::move(handle)));
}

bool ZipArchive::contains(const std::string& name) const {
  return zip_name_locate(handle_->archive, name.c_str(), 0) >= 0;
}

Result<std::string> ZipArchive::read(const std::string& name, std::uint64_t max_bytes) const {
  const std::string what = name + " in " + handle_->name;
  zip_stat_t status;
  if (zip_stat(handle_->archive, name.c_str(), 0, &status) != 0 || (status.valid & ZIP_STAT_SIZE) == 0)
    return fail("There is no " + what + ".");
  if (status.size > max_bytes)
    return fail(what + " is too large (" + std::to_string(status.size) + " bytes).");
  const std::unique_ptr<zip_file_t, int (*)(zip_file_t*)> file(
      zip_fopen_index(handle_->archive, status.index, 0), &zip_fclose);
  if (!file) return fail(what + " cannot be read (" + zip_strerror(handle_->archive) + ").");
  std::string bytes(status.size, '\0');
  std::uint64_t done = 0;
  while (done < status.size) {
    const zip_int64_t got = zip_fread(file.get(), bytes.data() + done, status.size - done);
    if (got <= 0) return fail(what + " is damaged or truncated.");
    done += static_cast<std::uint64_t>(got);
  }
  return bytes;
}

}  // namespace scantrove
