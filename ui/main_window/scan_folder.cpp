#include "ui/main_window/scan_folder.h"

#include <QDir>
#include <QFileInfo>
#include <utility>

namespace scantrove {

bool ScanFolder::make(const QString& path) {
  removeIfEmpty();
  if (!QDir().mkpath(QFileInfo(path).path()) || !QDir().mkdir(path)) return false;
  path_ = path;
  return true;
}

void ScanFolder::removeIfEmpty() {
  const QString path = std::exchange(path_, {});
  if (!path.isEmpty()) QDir().rmdir(path);  // fails if the folder is not empty
}

}  // namespace scantrove
