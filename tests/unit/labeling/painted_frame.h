#pragma once
#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <vector>

#include "core/labeling/graph_merger.h"

namespace scantrove::test {

/// Pixel bounds, inclusive.
struct Rectangle {
  int left, top, right, bottom;
};

/// An analytic surface seen from the world's origin along z, with images to paint.
struct PaintedFrame {
  static constexpr int kWidth = 64, kHeight = 48;
  static constexpr Rectangle kAll{0, 0, kWidth - 1, kHeight - 1};
  static constexpr Rectangle kLeft{0, 0, kWidth / 2 - 1, kHeight - 1};
  static constexpr Rectangle kRight{kWidth / 2, 0, kWidth - 1, kHeight - 1};
  static constexpr auto kPixels = static_cast<std::size_t>(kWidth) * kHeight;

  RenderedView view{{60, 60, (kWidth - 1) / 2.0F, (kHeight - 1) / 2.0F, kWidth, kHeight},
                    Eigen::Isometry3d::Identity(),
                    std::vector<Eigen::Vector4f>(kPixels),
                    std::vector<Eigen::Vector4f>(kPixels),
                    std::vector<FragmentId>(kPixels),
                    {}};
  std::vector<Eigen::Vector3f> color_lab;  ///< empty without colour
  std::vector<int> voxels;                 ///< by fragment
  SegmentMap segments;                     ///< made by segmentsOf()
  std::vector<std::uint8_t> appeared;      ///< as in MergeInput; empty if no object appeared

  /// Two upright planes that meet in the middle column, 1 m ahead. `turn_rad`: angle between their normals,
  /// > 0 an inner corner, < 0 an outer one, 0 a wall.
  static PaintedFrame corner(float turn_rad) {
    return drawn([=](float x) { return planeAt(x, x < 0 ? turn_rad / 2 : -turn_rad / 2); });
  }
  /// Two walls, the right one `gap_m` behind the left one, which is 1 m ahead.
  static PaintedFrame step(float gap_m) {
    return drawn([=](float x) { return std::pair(x < 0 ? 1.0F : 1 + gap_m, Eigen::Vector3f(0, 0, -1)); });
  }

  static void fill(auto& image, const Rectangle& where, auto value) {
    for (int y = where.top; y <= where.bottom; ++y) {
      for (int x = where.left; x <= where.right; ++x) image[static_cast<std::size_t>(y * kWidth + x)] = value;
    }
  }

  /// The segment map S_t with the rectangles as segments 1, 2, ...; later ones cover earlier ones.
  [[nodiscard]] SegmentMap segmentsOf(const std::vector<Rectangle>& rectangles) const {
    SegmentMap map{
        kWidth, kHeight, std::vector<std::uint32_t>(kPixels, 0), {}, std::vector<float>(kPixels, 0)};
    std::uint32_t id = 0;
    for (const Rectangle& rectangle : rectangles) fill(map.ids, rectangle, ++id);
    map.areas.assign(id + 1, 0);
    for (std::size_t i = 0; i < kPixels; ++i) {
      ++map.areas[map.ids[i]];
      if (map.ids[i] != 0) map.depths_m[i] = view.vertices_world[i].z();
    }
    return map;
  }

  [[nodiscard]] MergeInput input() const { return {segments, view, color_lab, voxels, appeared}; }

 private:
  /// Depth and normal of the plane through (0, 0, 1) whose normal is turned by `yaw_rad` to the right.
  static std::pair<float, Eigen::Vector3f> planeAt(float x, float yaw_rad) {
    const Eigen::Vector3f normal(std::sin(yaw_rad), 0, -std::cos(yaw_rad));
    return {normal.z() / (normal.z() + normal.x() * x), normal};
  }
  /// `at` gives depth and normal at x = X / Z.
  static PaintedFrame drawn(auto&& at) {
    PaintedFrame frame;
    for (std::size_t i = 0; i < kPixels; ++i) {
      const auto u = static_cast<float>(i % kWidth), v = static_cast<float>(i / kWidth);
      const auto [z, normal] = at(frame.view.K.backProject(u, v, 1).x());
      frame.view.vertices_world[i] = frame.view.K.backProject(u, v, z).homogeneous();
      frame.view.normals_world[i] << normal, 1.0F;
    }
    return frame;
  }
};

/// Merges frames of one painted surface. Each pixel stands for `kVoxelsAPixel` voxels, whose fragments follow
/// the rule of update_labels.cl.
class PaintedScan {
 public:
  static constexpr int kVoxelsAPixel = 16;  // a pixel is 17 mm wide at 1 m: 3 x 3 voxels, nearly two layers

  explicit PaintedScan(PaintedFrame frame) : frame_(std::move(frame)) {}

  const RegionMerger::Outcome& observe(const std::vector<Rectangle>& segments, int times = 1) {
    for (int i = 0; i < times; ++i) observeOnce(segments);
    return outcome_;
  }
  /// Marks the rectangles as newly appeared objects from the next frame on.
  void appearAs(const std::vector<Rectangle>& objects) {
    frame_.appeared.assign(PaintedFrame::kPixels, 0);
    std::uint8_t object = 0;
    for (const Rectangle& rectangle : objects) PaintedFrame::fill(frame_.appeared, rectangle, ++object);
  }
  [[nodiscard]] RegionId regionAt(int x, int y) const { return table.regionOf(fragmentAt(x, y)); }
  [[nodiscard]] FragmentId fragmentAt(int x, int y) const {
    return frame_.view.fragments[static_cast<std::size_t>(y * PaintedFrame::kWidth + x)];
  }

  RegionTable table;
  GraphMerger merger;
  LabelingParams params;

 private:
  void observeOnce(const std::vector<Rectangle>& segments) {
    frame_.segments = frame_.segmentsOf(segments);
    outcome_ = merger.merge(frame_.input(), table, params);
    for (std::size_t i = 0; i < PaintedFrame::kPixels; ++i) {
      FragmentId& stored = frame_.view.fragments[i];
      int& confidence = confidence_[i];
      const FragmentId seen = outcome_.fragments[i];
      if (!seen) continue;
      const bool at_once = std::ranges::find(outcome_.split_off, seen) != outcome_.split_off.end();
      if (stored == seen) {
        confidence = std::min(confidence + 1, 10);
      } else if (!stored || at_once || confidence <= 1) {
        stored = seen;
        confidence = 1;
      } else {
        --confidence;
      }
    }
    countVoxels();
  }

  void countVoxels() {
    frame_.voxels.assign(table.regions().size(), 0);
    for (const FragmentId stored : frame_.view.fragments) {
      if (stored) frame_.voxels[stored.value] += kVoxelsAPixel;
    }
    for (std::uint32_t i = 1; i < frame_.voxels.size(); ++i) {
      if (!table.regions()[i] || frame_.voxels[i] > 0) continue;
      merger.forget(FragmentId{i});
      table.free(FragmentId{i});
    }
  }

  PaintedFrame frame_;
  RegionMerger::Outcome outcome_;
  std::vector<int> confidence_ = std::vector<int>(PaintedFrame::kPixels, 0);
};

}  // namespace scantrove::test
