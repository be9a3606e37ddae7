#pragma once
#include <filesystem>

namespace scantrove {

/// What a path that a person gave belongs to.
struct OpenedPath {
  enum class Kind {
    scan,     ///< a saved scan: its folder, or the session.sqlite in it
    project,  ///< a project: its folder, or the file by which it is recognised
    other     ///< a recording, or nothing that can be opened
  };
  Kind kind = Kind::other;
  std::filesystem::path folder;  ///< of the scan or project, absolute; other: empty
};

/// Recognises the path by names of files, and by the content of those that other programs use, too. A file
/// may be given without a folder. It does not check that scan or project can be read. Any thread.
[[nodiscard]] OpenedPath recognizePath(const std::filesystem::path& given);

}  // namespace scantrove
