#include "core/fusion/brick_window.h"

namespace scantrove {

void BrickWindow::set(ComputeContext& compute, const BrickPages& all, std::span<const int> pages) {
  Eigen::Vector3i first = Eigen::Vector3i::Zero();
  Eigen::Vector3i last = Eigen::Vector3i::Zero();
  if (!pages.empty()) first = last = all.page(pages.front()).position;
  for (const int page : pages) {
    first = first.cwiseMin(all.page(page).position);
    last = last.cwiseMax(all.page(page).position);
  }
  const Eigen::Vector3i size = last - first + Eigen::Vector3i::Ones();
  const Eigen::Matrix<std::size_t, 3, 1> sides = size.cast<std::size_t>();
  const std::size_t cells = sides.prod();
  host_cells_.assign(cells, PAGE_EMPTY);
  for (const int page : pages) {
    const Eigen::Matrix<std::size_t, 3, 1> p = (all.page(page).position - first).cast<std::size_t>();
    host_cells_[p.x() + sides.x() * (p.y() + sides.y() * p.z())] = all.page(page).block;
  }
  if (cells_.size() < cells) cells_ = Buffer<cl_int>(compute.context(), 2 * cells);
  cells_.write(compute.queue(), host_cells_);
  size_ = {{size.x(), size.y(), size.z(), static_cast<cl_int>(cells)}};
  first_brick_ = PAGE_SIDE * first;
}

Eigen::Matrix4d BrickWindow::fromCamera(const Eigen::Isometry3d& T_world_camera, double brick_size_m,
                                        double unit_m) const {
  Eigen::Matrix4d T = T_world_camera.matrix();
  T.topRightCorner<3, 1>() -= first_brick_.cast<double>() * brick_size_m;
  T.topRows<3>() /= unit_m;
  return T;
}

}  // namespace scantrove
