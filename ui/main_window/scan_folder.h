#pragma once
#include <QString>

namespace scantrove {

/// A folder created for a scan. Removed again if the scan leaves it empty because it could not start.
class ScanFolder {
 public:
  ScanFolder() = default;
  ~ScanFolder() { removeIfEmpty(); }
  ScanFolder(const ScanFolder&) = delete;
  ScanFolder& operator=(const ScanFolder&) = delete;

  /// Creates `path` and releases the previous folder. False if it exists or cannot be created.
  [[nodiscard]] bool make(const QString& path);
  void removeIfEmpty();

 private:
  QString path_;  ///< empty: no folder
};

}  // namespace scantrove
