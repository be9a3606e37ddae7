#pragma once
#include <QElapsedTimer>
#include <QString>
#include <QWidget>

#include "core/scan/scan_snapshot.h"

class QLabel;
class QProgressBar;

namespace scantrove {

class ElidedLabel;

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
  void setCount(const QString& text);

  ElidedLabel* title_;
  QProgressBar* bar_;
  QLabel* count_;
  QElapsedTimer since_start_;
};

}  // namespace scantrove
