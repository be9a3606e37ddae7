#pragma once
#include <filesystem>
#include <optional>

namespace scantrove {

/// A file identified by its inode, even when its name changes. Takes no lock, and closing it releases none.
/// (POSIX record locks of a process end when it closes any ordinary descriptor of the file.) One thread.
class HeldFile {
 public:
  enum class Place {
    same,      ///< found under its name
    removed,   ///< no longer has a name
    moved,     ///< has another name
    replaced,  ///< another file has its name
  };

  /// None: no such file, or a symbolic link.
  [[nodiscard]] static std::optional<HeldFile> hold(const std::filesystem::path& path);
  HeldFile(HeldFile&& other) noexcept;
  HeldFile& operator=(HeldFile&& other) noexcept;
  ~HeldFile();

  [[nodiscard]] Place place() const;
  /// Its current name. Empty: none, or unknown.
  [[nodiscard]] std::filesystem::path nameNow() const;

 private:
  HeldFile(std::filesystem::path path, int file) : path_(std::move(path)), file_(file) {}

  std::filesystem::path path_;
  int file_ = -1;
};

/// Whether `path` names the file open as `descriptor`.
[[nodiscard]] bool isNameOf(const std::filesystem::path& path, int descriptor);

}  // namespace scantrove
