#pragma once
#include <QWidget>
#include <memory>
#include <vector>

#include "core/scan/scan_snapshot.h"

class QLabel;
class QSlider;
class QToolButton;

namespace scantrove {

/// Slider for browsing the key frames after a scan. Hidden while there are none.
class TimeLine : public QWidget {
  Q_OBJECT

 public:
  explicit TimeLine(QWidget* parent = nullptr);
  void showSnapshot(const ScanSnapshot& snapshot);
  void clear();
  [[nodiscard]] QSlider* slider() const { return slider_; }
  [[nodiscard]] QString text() const;

 public slots:
  void step(int count);

 signals:
  void requested(int index);  ///< index into ScanSnapshot::key_frames

 private:
  void showText(int index);

  QSlider* slider_;
  QLabel* text_;
  std::shared_ptr<const std::vector<int>> key_frames_;
};

}  // namespace scantrove
