#pragma once
#include <QWidget>
#include <memory>
#include <vector>

#include "core/scan/scan_snapshot.h"
#include "ui/models/key_frame_reviews.h"

class QComboBox;
class QLabel;
class QSlider;

namespace scantrove {

class ReviewMarks;

/// Slider for browsing the key frames after a scan, with their review states. Hidden while there are none.
class TimeLine : public QWidget {
  Q_OBJECT

 public:
  explicit TimeLine(QWidget* parent = nullptr);
  void showSnapshot(const ScanSnapshot& snapshot);
  void clear();
  [[nodiscard]] QSlider* slider() const { return slider_; }
  [[nodiscard]] QComboBox* filterBox() const { return filter_box_; }
  [[nodiscard]] QString text() const;
  [[nodiscard]] KeyFrameReviews& reviews() { return reviews_; }
  [[nodiscard]] int current() const;
  void go(int index);

 public slots:
  /// To the next key frame of the filter, or the previous one with a negative count.
  void step(int count);

 signals:
  void requested(int index);  ///< index into ScanSnapshot::key_frames

 private:
  void makeFilter();
  [[nodiscard]] ReviewFilter filter() const;
  /// The horizontal position of a key frame of the slider.
  [[nodiscard]] int placeOf(int index) const;
  void showText(int index);

  KeyFrameReviews reviews_;
  QSlider* slider_;
  QLabel* text_;
  QComboBox* filter_box_;
  ReviewMarks* marks_;
  std::shared_ptr<const std::vector<int>> key_frames_;
};

}  // namespace scantrove
