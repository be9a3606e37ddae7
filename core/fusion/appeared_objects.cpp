#include "core/fusion/appeared_objects.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <iterator>
#include <limits>

namespace scantrove {
namespace {

/// A few voxels: larger than the noise of an object at rest, smaller than gaps between objects on a table.
constexpr float kCell_m = 0.02F;
/// Frames in a cell from which an object is at rest; a passing object stays for fewer.
constexpr int kFramesAtRest = 8;
/// A cell without motion for this long is dropped.
constexpr int kForgetsAfterFrames = 150;
/// Readings of one object came to rest within kAtOnceFrames and are nearer to each other than kSameThing_m.
constexpr int kAtOnceFrames = 20;
constexpr float kSameThing_m = 0.03F;
constexpr float kSameThingSlope = 0.02F;  // of the depth: pixels lie farther apart there
/// Fewer readings are noise.
constexpr std::size_t kSmallestThing_px = 12;
constexpr int kMaxThings = 255;  // numbers of one byte, 0 is none

/// The cell of each reading of a view.
class CellsOfView {
 public:
  explicit CellsOfView(const DepthView& view) : view_(view), T_(view.T_world_camera.cast<float>()) {}
  [[nodiscard]] float z(int u, int v) const { return view_.z_m.at<float>(v, u); }
  [[nodiscard]] std::array<int, 3> at(int u, int v) const {
    const Eigen::Vector3f p =
        T_ * view_.K.backProject(static_cast<float>(u), static_cast<float>(v), z(u, v)) / kCell_m;
    return {static_cast<int>(std::floor(p.x())), static_cast<int>(std::floor(p.y())),
            static_cast<int>(std::floor(p.z()))};
  }

 private:
  const DepthView& view_;
  Eigen::Isometry3f T_;
};

}  // namespace

void AppearedObjects::add(const DepthView& view, const cv::Mat& moving, const cv::Mat& intruding) {
  const int now = ++seen_.frame;
  std::erase_if(seen_.cells, [now](const Cell& cell) { return now - cell.last > kForgetsAfterFrames; });
  if (moving.empty()) return;
  const CellsOfView cells(view);
  std::vector<Cell> moved;
  for (int v = 0; v < moving.rows; ++v) {
    for (int u = 0; u < moving.cols; ++u) {
      // Other pixels of the mask show the object's support.
      if (moving.at<std::uint8_t>(v, u) == 0 || intruding.at<std::uint8_t>(v, u) == 0 || !(cells.z(u, v) > 0))
        continue;
      moved.push_back({cells.at(u, v), now, now, 1});
    }
  }
  std::ranges::sort(moved, {}, &Cell::at);
  const auto isSamePlace = [](const Cell& a, const Cell& b) { return a.at == b.at; };
  moved.erase(std::unique(moved.begin(), moved.end(), isSamePlace), moved.end());
  // Both are sorted; among equal cells the earlier one comes first.
  std::vector<Cell> all;
  all.reserve(seen_.cells.size() + moved.size());
  std::ranges::merge(seen_.cells, moved, std::back_inserter(all), {}, &Cell::at, &Cell::at);
  seen_.cells.clear();
  for (const Cell& cell : all) {
    if (seen_.cells.empty() || seen_.cells.back().at != cell.at) {
      seen_.cells.push_back(cell);
      continue;
    }
    // An earlier object was here.
    Cell& before = seen_.cells.back();
    if (cell.last - before.last > kFramesAtRest) before = {cell.at, cell.since, cell.last, 0};
    before.last = cell.last;
    ++before.frames;
  }
}

const AppearedObjects::Cell* AppearedObjects::restingAt(const std::array<int, 3>& at) const {
  const auto found = std::ranges::lower_bound(seen_.cells, at, {}, &Cell::at);
  return found != seen_.cells.end() && found->at == at && found->frames >= kFramesAtRest ? &*found : nullptr;
}

cv::Mat AppearedObjects::atRest(const DepthView& view, const cv::Mat& moving) const {
  const auto hasRested = [](const Cell& cell) { return cell.frames >= kFramesAtRest; };
  if (std::ranges::none_of(seen_.cells, hasRested)) return {};
  const CellsOfView cells(view);
  constexpr int kNever = std::numeric_limits<int>::min();
  cv::Mat since(view.z_m.size(), CV_32SC1, cv::Scalar(kNever));
  for (int v = 0; v < since.rows; ++v) {
    for (int u = 0; u < since.cols; ++u) {
      if (!(cells.z(u, v) > 0) || (!moving.empty() && moving.at<std::uint8_t>(v, u) != 0)) continue;
      if (const Cell* cell = restingAt(cells.at(u, v))) since.at<int>(v, u) = cell->since;
    }
  }
  cv::Mat things = cv::Mat::zeros(since.size(), CV_8UC1);
  int count = 0;
  const cv::Rect image({}, since.size());
  std::vector<cv::Point> patch;
  for (int v = 0; v < since.rows; ++v) {
    for (int u = 0; u < since.cols && count < kMaxThings; ++u) {
      if (since.at<int>(v, u) == kNever) continue;
      patch.assign(1, {u, v});
      std::vector<int> sinces(1, since.at<int>(v, u));
      since.at<int>(v, u) = kNever;
      for (std::size_t next = 0; next < patch.size(); ++next) {
        const cv::Point p = patch[next];
        const float z = cells.z(p.x, p.y);
        for (const cv::Point& step : {cv::Point(1, 0), cv::Point(-1, 0), cv::Point(0, 1), cv::Point(0, -1)}) {
          const cv::Point q = p + step;
          if (!image.contains(q) || since.at<int>(q) == kNever) continue;
          if (std::abs(since.at<int>(q) - sinces[next]) > kAtOnceFrames) continue;
          if (!(std::abs(cells.z(q.x, q.y) - z) < kSameThing_m + kSameThingSlope * z)) continue;
          patch.push_back(q);
          sinces.push_back(since.at<int>(q));
          since.at<int>(q) = kNever;
        }
      }
      if (patch.size() < kSmallestThing_px) continue;
      ++count;
      for (const cv::Point& p : patch) things.at<std::uint8_t>(p) = static_cast<std::uint8_t>(count);
    }
  }
  return count > 0 ? things : cv::Mat();
}

}  // namespace scantrove
