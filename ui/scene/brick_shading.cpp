#include "ui/scene/brick_shading.h"

#include <Eigen/Eigenvalues>
#include <algorithm>
#include <cmath>
#include <cstdint>
#include <span>
#include <vector>

#include "core/fusion/kernels/brick_layout.h"

namespace scantrove {
namespace {

constexpr float kBrickVoxels = 8;
constexpr float kAmbient = 0.58F;
constexpr std::size_t kMinPoints = 5;
constexpr float kMinWeight = 2;
constexpr float kReach = 0.14F;        ///< squared width of the Gaussian, in bricks
constexpr float kSameSurface = 0.82F;  ///< cosine of the angle up to which normals are averaged
constexpr float kSameSide = 0.6F;      ///< the same for normals of neighbouring voxels
/// Heights as in CloudBrick::Point. Voxels farther from the surface appear and vanish with noise; there is
/// always a nearer one.
constexpr int kFringeHeight = 51;
constexpr int kSimilarHeight = 12;
constexpr int kSimilarColor = 10;                ///< of 255
constexpr std::size_t kPointsPerDifference = 8;  ///< number of points per different one

Eigen::Vector3f cellCenter(std::size_t cell) {
  return {(cell & 1U) != 0 ? 0.75F : 0.25F, (cell & 2U) != 0 ? 0.75F : 0.25F,
          (cell & 4U) != 0 ? 0.75F : 0.25F};
}

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
    const Eigen::Vector3f mean = sum / weight;
    const Eigen::Matrix3f covariance = squares / weight - mean * mean.transpose();
    Eigen::SelfAdjointEigenSolver<Eigen::Matrix3f> solver;
    solver.computeDirect(covariance);
    return solver.eigenvectors().col(0);
  }
};

/// Normal of the cell (x, y, z), counted in cells from the middle brick's corner, -2 <= x < 4.
Eigen::Vector3f normalAt(const Neighborhood& bricks, int x, int y, int z) {
  const auto brick_of = [](int cell) { return static_cast<std::size_t>((cell + 2) / 2); };
  const CellNormals* cells = bricks[brick_of(x) + 3 * brick_of(y) + 9 * brick_of(z)];
  if (cells == nullptr) return Eigen::Vector3f::Zero();
  const auto in_brick = [](int cell) { return static_cast<std::size_t>((cell + 2) % 2); };
  return (*cells)[in_brick(x) + 2 * in_brick(y) + 4 * in_brick(z)];
}

/// The voxel of a point in its brick: x + 8 y + 64 z. Valid for points at voxel centres and corners.
int voxelOf(const CloudBrick::Point& point, float voxel_size_m) {
  const Eigen::Vector3i voxel = (point.center().array() / voxel_size_m + 0.25F).floor().cast<int>();
  return (voxel.x() & 7) + 8 * ((voxel.y() & 7) + 8 * (voxel.z() & 7));
}

bool isOnFringe(const CloudBrick::Point& point) { return std::abs(point.height) > kFringeHeight; }

bool isSimilar(const CloudBrick::Point& a, const CloudBrick::Point& b) {
  if (std::abs(a.height - b.height) > kSimilarHeight) return false;
  if (!b.color.known()) return true;  // its colour is taken from its neighbours
  for (std::size_t c = 0; c < 3; ++c) {
    if (std::abs(a.color.rgb[c] - b.color.rgb[c]) > kSimilarColor) return false;
  }
  return true;
}

/// False when most points have no normal.
bool meanNormals(const CloudBrick& brick, float brick_m, CellNormals& normals) {
  std::size_t known = 0;
  for (const CloudBrick::Point& point : brick.points) {
    if (!point.normal.known()) continue;
    ++known;
    const Eigen::Vector3f p = point.center() / brick_m - brick.position.cast<float>();
    const Eigen::Vector3f normal = point.normal.unpacked();
    for (std::size_t cell = 0; cell < normals.size(); ++cell) {
      const float weight = 1 - (p - cellCenter(cell)).squaredNorm() / (4 * kReach);
      if (weight <= 0) continue;
      // The back of a thin object counts as its front.
      normals[cell] += normals[cell].dot(normal) >= 0 ? Eigen::Vector3f(weight * normal)
                                                      : Eigen::Vector3f(-weight * normal);
    }
  }
  return 2 * known >= brick.points.size();
}

}  // namespace

float lightOn(const Eigen::Vector3f& normal) {
  // A key light and a weaker fill light.
  static const Eigen::Vector3f key = Eigen::Vector3f(0.45F, -0.80F, -0.40F).normalized();
  static const Eigen::Vector3f fill = Eigen::Vector3f(-0.70F, -0.10F, -0.70F).normalized();
  const float lit = 0.72F * std::abs(normal.dot(key)) + 0.28F * std::abs(normal.dot(fill));
  return kAmbient + (1 - kAmbient) * std::min(1.0F, 1.25F * lit);
}

void spreadColors(std::vector<CloudBrick::Point>& points, float voxel_size_m) {
  constexpr int kReach_vox = 3;
  const auto seen = [](const CloudBrick::Point& point) { return point.color.known(); };
  if (std::all_of(points.begin(), points.end(), seen) || std::none_of(points.begin(), points.end(), seen)) {
    return;
  }
  const float near_m = 1.8F * voxel_size_m;  // includes neighbours across a voxel edge
  for (int step = 0; step < kReach_vox; ++step) {
    const std::vector<CloudBrick::Point> before = points;
    for (CloudBrick::Point& point : points) {
      if (point.color.known()) continue;
      Eigen::Vector3f sum = Eigen::Vector3f::Zero();
      float count = 0;
      for (const CloudBrick::Point& other : before) {
        if (!other.color.known() || (other.center() - point.center()).squaredNorm() > near_m * near_m)
          continue;
        sum += Eigen::Vector3f(other.color.rgb[0], other.color.rgb[1], other.color.rgb[2]);
        ++count;
      }
      if (count == 0) continue;
      const auto mean = [&](int c) { return static_cast<std::uint8_t>(std::lround(sum[c] / count)); };
      point.color = PackedColor::of(mean(0), mean(1), mean(2));
    }
  }
}

std::vector<PackedNormal> smoothNormals(const std::vector<CloudBrick::Point>& points, std::size_t count,
                                        float voxel_size_m) {
  constexpr int kSide = 8;
  constexpr int kPadded = kSide + 2;  // padded, so that neighbours need no range check
  std::array<Eigen::Vector3f, kPadded * kPadded * kPadded> voxels;
  voxels.fill(Eigen::Vector3f::Zero());
  const auto indexOf = [voxel_size_m](const CloudBrick::Point& point) {
    const int voxel = voxelOf(point, voxel_size_m);
    return 1 + voxel % kSide + kPadded * (1 + voxel / kSide % kSide + kPadded * (1 + voxel / kSide / kSide));
  };
  for (const CloudBrick::Point& point : points)
    voxels[static_cast<std::size_t>(indexOf(point))] = point.normal.unpacked();
  std::vector<PackedNormal> smooth;
  smooth.reserve(count);
  for (const CloudBrick::Point& point : std::span(points).first(count)) {
    const int middle = indexOf(point);
    const Eigen::Vector3f own = voxels[static_cast<std::size_t>(middle)];
    Eigen::Vector3f sum = own;
    for (int dz = -1; dz <= 1; ++dz) {
      for (int dy = -1; dy <= 1; ++dy) {
        for (int dx = -1; dx <= 1; ++dx) {
          const int beside = middle + dx + kPadded * (dy + kPadded * dz);
          const Eigen::Vector3f& other = voxels[static_cast<std::size_t>(beside)];
          if (other.dot(own) > kSameSide) sum += other;
        }
      }
    }
    smooth.push_back(PackedNormal::of(sum));
  }
  return smooth;
}

CellNormals cellNormals(const CloudBrick& brick, float voxel_size_m) {
  CellNormals normals;
  normals.fill(Eigen::Vector3f::Zero());
  if (brick.points.size() < kMinPoints) return normals;
  if (meanNormals(brick, kBrickVoxels * voxel_size_m, normals)) return normals;
  normals.fill(Eigen::Vector3f::Zero());
  // Positions 0..1 in the brick keep the sums well conditioned.
  const float brick_m = kBrickVoxels * voxel_size_m;
  std::array<Moments, 8> cells;
  for (const CloudBrick::Point& point : brick.points) {
    const Eigen::Vector3f p =
        Eigen::Vector3f(point.x, point.y, point.z) / brick_m - brick.position.cast<float>();
    for (std::size_t cell = 0; cell < cells.size(); ++cell) {
      cells[cell].add(p, std::exp(-(p - cellCenter(cell)).squaredNorm() / kReach));
    }
  }
  for (std::size_t cell = 0; cell < cells.size(); ++cell) {
    if (cells[cell].weight > kMinWeight) normals[cell] = cells[cell].weight * cells[cell].normal();
  }
  return normals;
}

CellLight cellLight(const Neighborhood& bricks) {
  CellLight light{};
  for (int cell = 0; cell < 8; ++cell) {
    const int cx = cell & 1;
    const int cy = (cell >> 1) & 1;
    const int cz = cell >> 2;
    const Eigen::Vector3f own = normalAt(bricks, cx, cy, cz);
    const float own_length = own.norm();
    Eigen::Vector3f sum = 2 * own;
    for (int dz = -1; own_length > 0 && dz <= 1; ++dz) {
      for (int dy = -1; dy <= 1; ++dy) {
        for (int dx = -1; dx <= 1; ++dx) {
          const Eigen::Vector3f other = normalAt(bricks, cx + dx, cy + dy, cz + dz);
          const float along = other.dot(own);
          if (std::abs(along) < kSameSurface * own_length * other.norm()) continue;
          sum += along >= 0 ? other : Eigen::Vector3f(-other);
        }
      }
    }
    light[static_cast<std::size_t>(cell)] = own_length > 0 ? lightOn(sum.normalized()) : 0.8F;
  }
  return light;
}

float lightAt(const CellLight& light, const Eigen::Vector3f& in_brick) {
  const Eigen::Vector3f t = (2 * in_brick.array() - 0.5F).cwiseMax(0.0F).cwiseMin(1.0F);
  float value = 0;
  for (std::size_t cell = 0; cell < light.size(); ++cell) {
    value += light[cell] * ((cell & 1U) != 0 ? t.x() : 1 - t.x()) * ((cell & 2U) != 0 ? t.y() : 1 - t.y()) *
             ((cell & 4U) != 0 ? t.z() : 1 - t.z());
  }
  return value;
}

bool hasSameAppearance(const std::vector<CloudBrick::Point>& shown, const std::vector<CloudBrick::Point>& now,
                       float voxel_size_m) {
  std::array<const CloudBrick::Point*, BRICK_VOXELS> before{};
  const auto at = [&](const CloudBrick::Point& point) -> const CloudBrick::Point*& {
    const int voxel = voxelOf(point, voxel_size_m);
    return before[static_cast<std::size_t>(voxel)];
  };
  for (const CloudBrick::Point& point : shown) at(point) = &point;
  std::size_t different = 0;
  for (const CloudBrick::Point& point : now) {
    const CloudBrick::Point*& drawn_point = at(point);
    if (drawn_point == nullptr && isOnFringe(point)) continue;
    if (drawn_point == nullptr || drawn_point->fragment != point.fragment) return false;
    if (!isSimilar(*drawn_point, point)) ++different;
    drawn_point = nullptr;
  }
  const auto is_gone = [](const CloudBrick::Point* point) { return point != nullptr && !isOnFringe(*point); };
  return kPointsPerDifference * different <= now.size() && std::ranges::none_of(before, is_gone);
}

Eigen::Vector3f mainNormal(const CellNormals& cells) {
  Eigen::Vector3f sum = Eigen::Vector3f::Zero();
  for (const Eigen::Vector3f& normal : cells) sum += normal.dot(sum) >= 0 ? normal : Eigen::Vector3f(-normal);
  return sum;
}

}  // namespace scantrove
