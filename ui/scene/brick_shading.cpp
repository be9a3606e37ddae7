#include "ui/scene/brick_shading.h"

#include <Eigen/Eigenvalues>
#include <algorithm>
#include <array>
#include <cmath>

namespace scantrove {
namespace {

constexpr float kBrickVoxels = 8;
constexpr float kAmbient = 0.56F;
constexpr std::size_t kMinPoints = 5;

struct Moments {
  float weight = 0;
  Eigen::Vector3f sum = Eigen::Vector3f::Zero();
  Eigen::Matrix3f squares = Eigen::Matrix3f::Zero();

  void add(const Eigen::Vector3f& p, float w) {
    weight += w;
    sum += w * p;
    squares += w * p * p.transpose();
  }

  [[nodiscard]] Eigen::Vector3f normal() const {
    if (!(weight > 0)) return Eigen::Vector3f::Zero();
    const Eigen::Vector3f mean = sum / weight;
    const Eigen::Matrix3f covariance = squares / weight - mean * mean.transpose();
    Eigen::SelfAdjointEigenSolver<Eigen::Matrix3f> solver;
    solver.computeDirect(covariance);
    return solver.eigenvectors().col(0);
  }
};

/// Brightness 0..1 of a surface seen from either side: a key light and a weaker one from across.
float brightness(const Eigen::Vector3f& normal) {
  static const Eigen::Vector3f key = Eigen::Vector3f(0.45F, -0.80F, -0.40F).normalized();
  static const Eigen::Vector3f fill = Eigen::Vector3f(-0.70F, -0.10F, -0.70F).normalized();
  const float lit = 0.72F * std::abs(normal.dot(key)) + 0.28F * std::abs(normal.dot(fill));
  return kAmbient + (1 - kAmbient) * std::min(1.0F, 1.25F * lit);
}

}  // namespace

BrickShading shadeBrick(const CloudBrick& brick, float voxel_size_m) {
  const std::vector<CloudBrick::Point>& points = brick.points;
  BrickShading result;
  result.shade.assign(points.size(), static_cast<std::uint8_t>(200));
  if (points.size() < kMinPoints) return result;

  // In bricks, from the brick's corner: 0..1, which also keeps the sums well conditioned.
  std::vector<Eigen::Vector3f> local(points.size());
  const float brick_m = kBrickVoxels * voxel_size_m;
  for (std::size_t i = 0; i < points.size(); ++i) {
    local[i] =
        Eigen::Vector3f(points[i].x, points[i].y, points[i].z) / brick_m - brick.position.cast<float>();
  }

  Moments whole;
  std::array<Moments, 8> cells;
  for (const Eigen::Vector3f& p : local) {
    whole.add(p, 1);
    for (std::size_t cell = 0; cell < cells.size(); ++cell) {
      const Eigen::Vector3f centre((cell & 1U) != 0 ? 0.75F : 0.25F, (cell & 2U) != 0 ? 0.75F : 0.25F,
                                   (cell & 4U) != 0 ? 0.75F : 0.25F);
      cells[cell].add(p, std::exp(-(p - centre).squaredNorm() / 0.09F));
    }
  }
  result.normal = whole.normal() * static_cast<float>(points.size());

  std::array<float, 8> light{};
  for (std::size_t cell = 0; cell < cells.size(); ++cell) {
    light[cell] = brightness(cells[cell].weight > 2 ? cells[cell].normal() : whole.normal());
  }
  for (std::size_t i = 0; i < local.size(); ++i) {
    // Trilinear between the cell centres, so that no cell edges show.
    const Eigen::Vector3f t = (2 * local[i].array() - 0.5F).cwiseMax(0.0F).cwiseMin(1.0F);
    float value = 0;
    for (std::size_t cell = 0; cell < cells.size(); ++cell) {
      value += light[cell] * ((cell & 1U) != 0 ? t.x() : 1 - t.x()) * ((cell & 2U) != 0 ? t.y() : 1 - t.y()) *
               ((cell & 4U) != 0 ? t.z() : 1 - t.z());
    }
    result.shade[i] = static_cast<std::uint8_t>(std::clamp(255 * value, 0.0F, 255.0F));
  }
  return result;
}

}  // namespace scantrove
