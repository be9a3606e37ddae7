#include "core/project/opened_path.h"

#include <system_error>

#include "core/project/project.h"
#include "core/session/session_store.h"

namespace scantrove {
namespace {

namespace fs = std::filesystem;

constexpr const char* kSessionFile = "session.sqlite";

}  // namespace

OpenedPath recognizePath(const fs::path& given) {
  std::error_code failure;
  if (given.empty()) return {};
  fs::path path = fs::absolute(given, failure).lexically_normal();
  if (failure) return {};
  if (!path.has_filename()) path = path.parent_path();
  if (fs::is_directory(path, failure)) {
    if (SessionStore::isSession(path)) return {OpenedPath::Kind::scan, path};
    if (isProjectFolder(path)) return {OpenedPath::Kind::project, path};
    return {};
  }
  if (path.filename() == kSessionFile && fs::is_regular_file(path, failure))
    return {OpenedPath::Kind::scan, path.parent_path()};
  if (isProjectFile(path)) return {OpenedPath::Kind::project, path.parent_path()};
  return {};
}

}  // namespace scantrove
