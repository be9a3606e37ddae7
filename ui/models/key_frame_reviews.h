#pragma once
#include <QObject>
#include <vector>

#include "core/scan/scan_snapshot.h"

namespace scantrove {

/// Key frames that a person browses.
enum class ReviewFilter { all, open, checked };

/// The review states of the key frames of the shown scan.
class KeyFrameReviews : public QObject {
  Q_OBJECT

 public:
  explicit KeyFrameReviews(QObject* parent = nullptr) : QObject(parent) {}

  void update(const ScanSnapshot& snapshot);
  void clear();
  /// Shows the state at once; the next snapshot has the stored one.
  void set(int index, ReviewState state);

  /// In the order of the scan.
  [[nodiscard]] const std::vector<FrameReview>& all() const { return reviews_; }
  /// Null: there is no such key frame.
  [[nodiscard]] const FrameReview* at(int index) const;
  [[nodiscard]] ReviewCounts counts() const;
  /// The nearest key frame of the filter after `from`, or before it with a negative `step`; at the end it
  /// goes on at the other end. -1: no other one.
  [[nodiscard]] int next(int from, int step, ReviewFilter filter) const;

 signals:
  void changed();

 private:
  std::vector<FrameReview> reviews_;
};

[[nodiscard]] bool passes(ReviewState state, ReviewFilter filter);

}  // namespace scantrove
