#include "core/capture/phones/device_files.h"

#include <spdlog/spdlog.h>

namespace scantrove {

bool isFolder(const std::filesystem::path& path) {
  std::error_code error;
  return std::filesystem::is_directory(path, error);
}

std::filesystem::path fileIfPresent(const std::filesystem::path& path) {
  std::error_code error;
  return std::filesystem::is_regular_file(path, error) ? path : std::filesystem::path();
}

void UnusableFrames::add(const std::string& reason) {
  if (++count_ == 1) first_reason_ = reason;
}

void UnusableFrames::warn(const std::string& source) const {
  if (count_ > 0) spdlog::warn("{}: {} frames cannot be used: {}", source, count_, first_reason_);
}

}  // namespace scantrove
