#include "ui/view/pending_snapshots.h"

#include <algorithm>
#include <chrono>
#include <span>
#include <utility>

#include "ui/scene/label_cloud_scene.h"

namespace scantrove {
namespace {

constexpr std::size_t kBricksAtATime = 64;

}  // namespace

void PendingSnapshots::add(std::shared_ptr<const ScanSnapshot> snapshot) {
  scene_.updateAllButBricks(*snapshot);
  if (!snapshot->changed_bricks.empty()) pending_.push_back({std::move(snapshot)});
}

bool PendingSnapshots::transfer(double max_ms) {
  const auto start = std::chrono::steady_clock::now();
  const auto isOver = [&] {
    return std::chrono::duration<double, std::milli>(std::chrono::steady_clock::now() - start).count() >
           max_ms;
  };
  while (!pending_.empty() && !isOver()) {
    auto& [snapshot, next] = pending_.front();
    const std::span<const CloudBrick> rest = std::span(snapshot->changed_bricks).subspan(next);
    const std::size_t count = std::min(kBricksAtATime, rest.size());
    scene_.updateBricks(rest.first(count));
    next += count;
    if (count == rest.size()) pending_.pop_front();
  }
  return pending_.empty();
}

}  // namespace scantrove
