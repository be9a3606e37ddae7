#pragma once
#include <QWidget>
#include <memory>
#include <vector>

#include "core/scan/scan_snapshot.h"

class QLabel;
class QSlider;
class QToolButton;

namespace scantrove {

/// The key frames of a scan that has ended, in a row to go through. Hidden while there are none.
class TimeLine : public QWidget {
  Q_OBJECT

 public:
  explicit TimeLine(QWidget* parent = nullptr);
  void showSnapshot(const ScanSnapshot& snapshot);
  void clear();
  [[nodiscard]] QSlider* slider() const { return slider_; }
  [[nodiscard]] QString text() const;

 public slots:
  void step(int places);

 signals:
  void requested(int place);  ///< of ScanSnapshot::key_frames

 private:
  void showText(int place);

  QSlider* slider_;
  QLabel* text_;
  std::shared_ptr<const std::vector<int>> key_frames_;
};

}  // namespace scantrove
