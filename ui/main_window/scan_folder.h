#pragma once
#include <QString>

namespace scantrove {

/// A folder that this program made for a scan to write into. A scan that could not begin leaves it empty, and
/// then it goes again; a folder that holds anything, or was there before, stays.
class ScanFolder {
 public:
  ScanFolder() = default;
  ~ScanFolder() { removeIfEmpty(); }
  ScanFolder(const ScanFolder&) = delete;
  ScanFolder& operator=(const ScanFolder&) = delete;

  /// Makes `path`; of the folder before nothing is known any more. False: it was there, or cannot be made.
  [[nodiscard]] bool make(const QString& path);
  void removeIfEmpty();

 private:
  QString path_;  ///< empty: this program made none
};

}  // namespace scantrove
