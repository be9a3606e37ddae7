#pragma once
#include <filesystem>
#include <string>

namespace scantrove {

/// Whether `path` is a folder.
[[nodiscard]] bool isFolder(const std::filesystem::path& path);

/// `path` if it is a file, else an empty path.
[[nodiscard]] std::filesystem::path fileIfPresent(const std::filesystem::path& path);

/// Counts frames whose metadata cannot be used; the log names their number and the first reason.
class UnusableFrames {
 public:
  void add(const std::string& reason);
  void warn(const std::string& source) const;

 private:
  int count_ = 0;
  std::string first_reason_;
};

}  // namespace scantrove
