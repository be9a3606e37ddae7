#pragma once
#include <QStringList>
#include <QWidget>

class QVBoxLayout;

namespace scantrove {

class SavedScansPanel;

/// What the window shows before anything is open: what this is, and the ways to begin.
class StartPage : public QWidget {
  Q_OBJECT

 public:
  explicit StartPage(QWidget* parent = nullptr);
  void setRecent(const QStringList& sources);
  [[nodiscard]] SavedScansPanel* savedScans() const { return kept_; }

 signals:
  void folderRequested();
  void recordingRequested();
  void cameraRequested();
  void sourceChosen(const QString& source);

 private:
  SavedScansPanel* kept_;
  QVBoxLayout* recent_;
  QWidget* recent_box_;
};

/// A source in words: "Demo: tabletop", "kitchen".
[[nodiscard]] QString sourceTitle(const QString& source);

}  // namespace scantrove
