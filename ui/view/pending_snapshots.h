#pragma once
#include <cstddef>
#include <deque>
#include <memory>

#include "core/scan/scan_snapshot.h"

namespace scantrove {

class LabelCloudScene;

/// Transfers snapshots into the scene: bricks a few at a time, everything else at once, so that opening a
/// session does not block the window. Use from the window's thread.
class PendingSnapshots {
 public:
  explicit PendingSnapshots(LabelCloudScene& scene) : scene_(scene) {}

  void add(std::shared_ptr<const ScanSnapshot> snapshot);
  /// Transfers bricks for about `max_ms`. True when all are transferred.
  bool transfer(double max_ms);
  [[nodiscard]] bool isEmpty() const { return pending_.empty(); }
  void clear() { pending_.clear(); }

 private:
  struct Pending {
    std::shared_ptr<const ScanSnapshot> snapshot;
    std::size_t next_brick = 0;
  };
  LabelCloudScene& scene_;
  std::deque<Pending> pending_;
};

}  // namespace scantrove
