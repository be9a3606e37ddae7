#pragma once
#include <cstddef>
#include <deque>
#include <memory>

#include "core/scan/scan_snapshot.h"

namespace scantrove {

class LabelCloudScene;

/// Takes what snapshots bring over into the scene: all but the bricks at once, these a few at a time, so that
/// the window is not held up by a session that is opened. One thread, the window's.
class SnapshotArrivals {
 public:
  explicit SnapshotArrivals(LabelCloudScene& scene) : scene_(scene) {}

  void add(std::shared_ptr<const ScanSnapshot> snapshot);
  /// For about so long. True: all that was added is there.
  bool takeOver(double most_ms);
  [[nodiscard]] bool isEmpty() const { return waiting_.empty(); }
  void clear() { waiting_.clear(); }

 private:
  struct Arrival {
    std::shared_ptr<const ScanSnapshot> snapshot;
    std::size_t next_brick = 0;
  };
  LabelCloudScene& scene_;
  std::deque<Arrival> waiting_;
};

}  // namespace scantrove
