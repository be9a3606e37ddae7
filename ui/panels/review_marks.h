#pragma once
#include <QWidget>
#include <functional>
#include <vector>

#include "ui/models/key_frame_reviews.h"

namespace scantrove {

/// A mark for each key frame: a ring is open, a green disc checked, a red cross left out. Marks that do not
/// pass the filter are pale. A click goes to a key frame.
class ReviewMarks : public QWidget {
  Q_OBJECT

 public:
  /// `place_of`: the horizontal position of a key frame in the parent of the marks.
  ReviewMarks(const KeyFrameReviews& reviews, std::function<int(int index)> place_of,
              QWidget* parent = nullptr);
  void setCurrent(int index);
  void setFilter(ReviewFilter filter);
  [[nodiscard]] QSize sizeHint() const override { return {120, 11}; }
  /// The horizontal middle of a mark, in this widget.
  [[nodiscard]] int middleOf(int index) const;

 signals:
  void chosen(int index);

 protected:
  void paintEvent(QPaintEvent* event) override;
  void mousePressEvent(QMouseEvent* event) override;
  bool event(QEvent* event) override;

 private:
  [[nodiscard]] int nearestTo(int x) const;

  const KeyFrameReviews& reviews_;
  std::function<int(int)> place_of_;
  int current_ = -1;
  ReviewFilter filter_ = ReviewFilter::all;
};

/// "open", "checked" or "left out", for people.
[[nodiscard]] QString inWords(ReviewState state);

}  // namespace scantrove
