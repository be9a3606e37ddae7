#pragma once
#include <QElapsedTimer>
#include <QString>
#include <QWidget>

#include "core/scan/scan_snapshot.h"

class QLabel;
class QProgressBar;

namespace scantrove {

/// What is being scanned and how far it is: frames of a recording, elapsed time of a camera.
class ProgressStrip : public QWidget {
  Q_OBJECT

 public:
  explicit ProgressStrip(QWidget* parent = nullptr);
  void begin(const QString& title);
  void showSnapshot(const ScanSnapshot& snapshot);
  void clear();
  [[nodiscard]] QString text() const;

 private:
  QLabel* title_;
  QProgressBar* bar_;
  QLabel* count_;
  QElapsedTimer since_start_;
};

}  // namespace scantrove
