#pragma once
#include <QString>
#include <QStringList>
#include <QUndoCommand>
#include <functional>
#include <vector>

#include "ui/panels/saved_scans_panel.h"

namespace scantrove {

/// List entries of the sessions in a folder, newest first, with their thumbnails. Reads summary rows, not
/// whole sessions. Any thread.
[[nodiscard]] std::vector<SavedScanEntry> savedScansIn(const QString& folder);

/// The names of the sessions in a folder that can be read, sorted. As savedScansIn() it reads every summary,
/// which takes long in a large project. Any thread.
[[nodiscard]] QStringList savedScanNamesIn(const QString& folder);

/// Undo step that moves a scan to the desktop's trash.
class DeleteScan : public QUndoCommand {
 public:
  using Fail = std::function<void(const QString& message)>;
  /// `done` is called after each step.
  DeleteScan(const QString& folder, std::function<void()> done, Fail fail);
  void redo() override;
  void undo() override;

 private:
  QString folder_, in_trash_;
  std::function<void()> done_;
  Fail fail_;
};

}  // namespace scantrove
