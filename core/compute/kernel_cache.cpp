#include "core/compute/kernel_cache.h"

#include <fcntl.h>
#include <sys/stat.h>
#include <unistd.h>

#include <array>
#include <cerrno>
#include <cstdlib>
#include <string>
#include <system_error>
#include <utility>
#include <vector>

#include "core/compute/cached_kernels.h"
#include "core/compute/private_folder.h"

namespace scantrove {
namespace {

namespace fs = std::filesystem;

std::string valueOf(const char* variable) {
  const char* value = std::getenv(variable);
  return value != nullptr ? value : "";
}

/// The cache folder of freedesktop.org's base directory specification, which ignores relative paths. Empty if
/// there is none.
fs::path ownFolder() {
  const fs::path cache = valueOf("XDG_CACHE_HOME");
  if (cache.is_absolute()) return cache / "scantrove/kernels";
  const fs::path home = valueOf("HOME");
  return home.is_absolute() ? home / ".cache/scantrove/kernels" : fs::path();
}

/// Creates `folder` and tests it by writing a file. Returns the reason on failure.
std::error_code prepare(const fs::path& folder) {
  if (folder.empty()) return std::make_error_code(std::errc::no_such_file_or_directory);
  std::error_code failure;
  const bool is_new = fs::create_directories(folder, failure);
  if (failure) return failure;
  if (is_new) ::chmod(folder.c_str(), 0700);
  std::string name = (folder / "scantrove-XXXXXX").string();
  const int file = ::mkstemp(name.data());
  if (file < 0) return std::error_code(errno, std::generic_category());
  static constexpr std::array<char, 1 << 16> kPiece{};
  for (int i = 0; i < 16 && !failure; ++i) {
    if (::write(file, kPiece.data(), kPiece.size()) != static_cast<ssize_t>(kPiece.size()))
      failure.assign(errno, std::generic_category());
  }
  ::close(file);
  ::unlink(name.c_str());
  return failure;
}

/// Error: a damaged file could not be removed.
Result<void> removeAll(const std::vector<fs::path>& files) {
  std::error_code failure;
  for (const fs::path& file : files) {
    fs::remove(file, failure);
    if (failure)
      return fail("Cannot remove the damaged file " + file.string() + ": " + failure.message() + ".");
  }
  return {};
}

constexpr const char* kCompiledAnew = "; they are compiled anew for this run.";

}  // namespace

KernelCache::KernelCache() {
  const std::string given = valueOf("POCL_CACHE_DIR");
  const bool is_ours = given.empty();
  folder_ = is_ours ? ownFolder() : fs::path(given);
  if (const std::error_code failure = prepare(folder_)) {
    usePrivateFolder(
        {"Compiled kernels cannot be kept in '" + folder_.string() + "' (" + failure.message() + ")",
         std::string("Set ") + (is_ours ? "XDG_CACHE_HOME" : "POCL_CACHE_DIR") +
             " to a folder that can be written to."});
  } else if (const Result<void> mended = mend(is_ours); !mended) {
    usePrivateFolder(mended.error());
  }
  ::setenv("POCL_CACHE_DIR", folder_.c_str(), 1);
}

KernelCache::~KernelCache() {
  if (is_private_) {
    removePrivateFolder(folder_);
  } else {
    recordKernels(folder_);
  }
}

Result<void> KernelCache::mend(bool is_ours) {
  const auto damaged = damagedKernels(folder_);
  if (!damaged) return fail(damaged.error());
  if (damaged->empty()) return {};
  const std::string what = std::to_string(damaged->size()) + " of the compiled kernels in " +
                           folder_.string() + " " + (damaged->size() == 1 ? "is" : "are") + " damaged";
  if (!is_ours || !removeAll(*damaged))
    return fail(what, "Remove that folder, so that compiled kernels are kept again.");
  remark_ = Error{what + kCompiledAnew, ""};
  recordKernels(folder_);
  return {};
}

void KernelCache::usePrivateFolder(const Error& reason) {
  auto made = makePrivateFolder();
  is_private_ = made.has_value();
  if (is_private_) folder_ = std::move(*made);
  remark_ = is_private_ ? Error{reason.what + kCompiledAnew, reason.advice}
                        : Error{reason.what + ", nor elsewhere: " + made.error().what, reason.advice};
}

}  // namespace scantrove
