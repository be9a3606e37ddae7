#pragma once
#include <Eigen/Geometry>
#include <span>
#include <vector>

#include "core/compute/buffer.h"
#include "core/compute/compute_context.h"
#include "core/fusion/brick_pages.h"

namespace scantrove {

/// The box of pages around one view, on the device, in which kernels look up bricks (brick_page.h). The
/// context's thread.
class BrickWindow {
 public:
  /// Sets the window to exactly `pages` (indices into `all`).
  void set(ComputeContext& compute, const BrickPages& all, std::span<const int> pages);

  [[nodiscard]] const Buffer<cl_int>& cells() const { return cells_; }

  /// Pages along x, y, z and the number of cells.
  [[nodiscard]] cl_int4 size() const { return size_; }

  /// First brick of the window.
  [[nodiscard]] const Eigen::Vector3i& firstBrick() const { return first_brick_; }

  /// The same as a kernel argument.
  [[nodiscard]] cl_int4 first() const { return {{first_brick_.x(), first_brick_.y(), first_brick_.z(), 0}}; }

  /// Maps camera points in metres to units of `unit_m` relative to the window's first brick, of side
  /// `brick_size_m`.
  [[nodiscard]] Eigen::Matrix4d fromCamera(const Eigen::Isometry3d& T_world_camera, double brick_size_m,
                                           double unit_m) const;

 private:
  Buffer<cl_int> cells_;
  std::vector<cl_int> host_cells_;
  cl_int4 size_{{1, 1, 1, 1}};
  Eigen::Vector3i first_brick_ = Eigen::Vector3i::Zero();
};

}  // namespace scantrove
