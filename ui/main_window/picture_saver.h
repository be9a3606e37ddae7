#pragma once
#include <QObject>
#include <QPointer>
#include <QProgressDialog>
#include <QString>

#include "core/scan/scan_event.h"

namespace scantrove {

class MainWindow;

/// Saves pictures and turntable videos of the open scan. The worker draws them; a dialog that does not block
/// the window shows the progress and cancels.
class PictureSaver : public QObject {
  Q_OBJECT

 public:
  explicit PictureSaver(MainWindow& window);

  /// Each asks for a new file first.
  void savePicture();
  void saveVideo();
  /// The ending of `file` chooses picture or video.
  void saveTo(const QString& file);

  /// Null if nothing is being drawn.
  [[nodiscard]] QProgressDialog* progress() const { return progress_; }

 private:
  void choose(const QString& title, const QString& ending, const QString& filter);
  void handleEvent(const ScanEvent& event);
  void end();

  MainWindow& window_;
  QPointer<QProgressDialog> progress_;
  bool is_cancelled_ = false;
};

}  // namespace scantrove
