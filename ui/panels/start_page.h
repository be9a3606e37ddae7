#pragma once
#include <QStringList>
#include <QWidget>

class QVBoxLayout;

namespace scantrove {

class ElidedLabel;
class SavedScansPanel;

/// Shown while nothing is open: a description of the program and ways to start.
class StartPage : public QWidget {
  Q_OBJECT

 public:
  explicit StartPage(QWidget* parent = nullptr);
  /// The open project, and where it is on disk.
  void setProject(const QString& name, const QString& folder);
  void setRecent(const QStringList& sources);
  [[nodiscard]] SavedScansPanel* savedScans() const { return saved_scans_; }

 signals:
  void projectRequested();
  void newProjectRequested();
  void folderRequested();
  void recordingRequested();
  void cameraRequested();
  void sourceChosen(const QString& source);

 private:
  [[nodiscard]] QWidget* makeProjectRow();

  ElidedLabel* project_ = nullptr;
  SavedScansPanel* saved_scans_;
  QVBoxLayout* recent_;
  QWidget* recent_box_;
};

/// Title of a source, for example "Demo: tabletop" or "kitchen".
[[nodiscard]] QString sourceTitle(const QString& source);

}  // namespace scantrove
