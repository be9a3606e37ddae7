#pragma once
#include <Eigen/Geometry>
#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <set>
#include <vector>

#include "core/capture/intrinsics.h"

namespace scantrove::reference {

/// Smallest and largest of several depth readings. Smallest is 0 if any pixel has no reading, largest if none
/// has one.
struct DepthExtent {
  double smallest = std::numeric_limits<double>::infinity();
  double largest = 0;
  void add(double z) {
    smallest = std::min(smallest, z);
    largest = std::max(largest, z);
  }
};

/// A depth image divided into square tiles, and the readings that bricks may project to.
class TiledDepth {
 public:
  /// Values in (0, max_depth_m] are readings.
  TiledDepth(const Intrinsics& K, std::vector<float> depth_m, double max_depth_m, int tile_px)
      : K_(K), depth_m_(std::move(depth_m)), max_depth_m_(max_depth_m), tile_px_(tile_px) {}

  [[nodiscard]] double reading(int u, int v) const {
    const double z = depth_m_[static_cast<std::size_t>(v * K_.width + u)];
    return z > 0 && z <= max_depth_m_ ? z : 0;
  }

  [[nodiscard]] DepthExtent tile(int tx, int ty) const {
    DepthExtent extent;
    for (int v = ty * tile_px_; v < std::min((ty + 1) * tile_px_, K_.height); ++v) {
      for (int u = tx * tile_px_; u < std::min((tx + 1) * tile_px_, K_.width); ++u) extent.add(reading(u, v));
    }
    return extent;
  }

  /// The readings at the projections of all voxel centres of a brick; none outside the image.
  /// `T_camera_window`: voxels to metres.
  [[nodiscard]] DepthExtent touchedBy(const Eigen::Vector3i& brick,
                                      const Eigen::Affine3d& T_camera_window) const {
    DepthExtent extent;
    for (int i = 0; i < 512; ++i) {
      const Eigen::Vector3i voxel = 8 * brick + Eigen::Vector3i(i % 8, i / 8 % 8, i / 64);
      const Eigen::Vector3d p = T_camera_window * (voxel.cast<double>().array() + 0.5).matrix();
      const Eigen::Vector2d pixel = pixelOf(p).array().floor();
      const bool inside =
          p.z() > 0 && pixel.x() >= 0 && pixel.y() >= 0 && pixel.x() < K_.width && pixel.y() < K_.height;
      extent.add(inside ? reading(static_cast<int>(pixel.x()), static_cast<int>(pixel.y())) : 0);
    }
    return extent;
  }

  struct Bounds {
    DepthExtent extent;
    bool decided = true;  ///< false if rounding decides which tiles count
  };

  /// Bounds of touchedBy() from the tiles that the projected corners span.
  [[nodiscard]] Bounds boundsOf(const Eigen::Vector3i& brick, const Eigen::Affine3d& T_camera_window) const {
    constexpr double kNear_m = 0.01;
    Eigen::AlignedBox2d box;
    for (int corner = 0; corner < 8; ++corner) {
      const Eigen::Vector3i offset(corner & 1, (corner >> 1) & 1, corner >> 2);
      const Eigen::Vector3d p = T_camera_window * (8 * (brick + offset)).cast<double>();
      if (p.z() <= kNear_m) return {{0, max_depth_m_}, std::abs(p.z() - kNear_m) > 1e-4};
      box.extend(pixelOf(p));
    }
    Bounds bounds;
    for (const double edge : {box.min().x(), box.min().y(), box.max().x(), box.max().y()}) {
      if (std::abs(edge / tile_px_ - std::round(edge / tile_px_)) < 1e-3) bounds.decided = false;
    }
    const Eigen::Vector2d size(K_.width, K_.height);
    for (int axis = 0; axis < 2; ++axis) {
      if (std::abs(box.max()[axis] - size[axis]) < 1e-2) bounds.decided = false;
    }
    const bool in_view = (box.max().array() >= 0).all() && (box.min().array() < size.array()).all();
    if (!in_view) return {{0, 0}, bounds.decided};
    const Eigen::Vector2i first = (box.min().cwiseMax(0.0) / tile_px_).array().floor().cast<int>();
    const Eigen::Vector2i last =
        (box.max().cwiseMin((size.array() - 1).matrix()) / tile_px_).array().floor().cast<int>();
    for (int ty = first.y(); ty <= last.y(); ++ty) {
      for (int tx = first.x(); tx <= last.x(); ++tx) {
        const DepthExtent extent = tile(tx, ty);
        bounds.extent.add(extent.smallest);
        bounds.extent.add(extent.largest);
      }
    }
    const bool is_inside = (box.min().array() >= 0).all() && (box.max().array() < size.array()).all();
    if (!is_inside) bounds.extent.smallest = 0;
    return bounds;
  }

 private:
  [[nodiscard]] Eigen::Vector2d pixelOf(const Eigen::Vector3d& p) const {
    return {K_.fx * p.x() / p.z() + K_.cx + 0.5, K_.fy * p.y() / p.z() + K_.cy + 0.5};
  }

  Intrinsics K_;
  std::vector<float> depth_m_;
  double max_depth_m_;
  int tile_px_;
};

/// The bricks that segments touch; `possible` are those that depend on rounding.
struct TouchedBricks {
  using Brick = std::array<int, 3>;
  std::set<Brick> certain, possible;

  /// Adds those of the segment from `a` to `b`, in bricks.
  void add(const Eigen::Vector3d& a, const Eigen::Vector3d& b) {
    constexpr double kCorner = 1e-3;  // in bricks
    std::vector<double> cuts{0, 1};
    for (int axis = 0; axis < 3; ++axis) {
      const double low = std::min(a[axis], b[axis]), high = std::max(a[axis], b[axis]);
      for (double face = std::ceil(low); face <= high; ++face) {
        if (high > low) cuts.push_back((face - a[axis]) / (b[axis] - a[axis]));
      }
    }
    std::sort(cuts.begin(), cuts.end());
    for (std::size_t i = 0; i + 1 < cuts.size(); ++i) {
      const Eigen::Vector3d middle = a + 0.5 * (cuts[i] + cuts[i + 1]) * (b - a);
      const Eigen::Vector3i brick = middle.array().floor().cast<int>();
      const bool is_corner = (cuts[i + 1] - cuts[i]) * (b - a).norm() < kCorner;
      (is_corner ? possible : certain).insert({brick.x(), brick.y(), brick.z()});
      if (!is_corner) continue;
      // Near a corner, the rounded segment may also touch the neighbours.
      for (int axis = 0; axis < 3; ++axis) {
        for (const double side : {-kCorner, kCorner}) {
          const Eigen::Vector3i beside =
              (middle + side * Eigen::Vector3d::Unit(axis)).array().floor().cast<int>();
          possible.insert({beside.x(), beside.y(), beside.z()});
        }
      }
    }
  }
};

}  // namespace scantrove::reference
