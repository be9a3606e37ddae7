#include "core/texturing/seam_leveling.h"

#include <Eigen/IterativeLinearSolvers>
#include <Eigen/SparseCholesky>
#include <algorithm>
#include <cmath>
#include <limits>
#include <opencv2/imgproc.hpp>

namespace scantrove {
namespace {

/// Colours at seams are read from images of this width: finer texture does not fit by a pixel or two.
constexpr int kSampledWidth_px = 640;
/// Weights of differences between neighbouring vertices and of offsets themselves; a seam has 1.
constexpr double kSmoothness = 5, kSmallness = 1e-3;
/// The offsets of charts are a good start, so few steps are enough.
constexpr int kMaxSteps = 80;
constexpr double kTolerance = 1e-4;
/// The rest at a seam fades out over these rings of vertices; more than this is texture, not exposure.
constexpr int kFadingRings = 4;
constexpr double kMostRest = 24;
constexpr std::uint32_t kNoNode = std::numeric_limits<std::uint32_t>::max();

/// Interpolated; within the image.
Eigen::RowVector3d bilinearColor(const cv::Mat& image, const Eigen::Vector2f& pixel) {
  const float u = std::clamp(pixel.x(), 0.0F, static_cast<float>(image.cols - 1));
  const float v = std::clamp(pixel.y(), 0.0F, static_cast<float>(image.rows - 1));
  const int x = static_cast<int>(u), y = static_cast<int>(v);
  const int right = std::min(x + 1, image.cols - 1), below = std::min(y + 1, image.rows - 1);
  const auto du = static_cast<double>(u - static_cast<float>(x));
  const auto dv = static_cast<double>(v - static_cast<float>(y));
  const auto at = [&](int column, int row) {
    const auto& bgr = image.at<cv::Vec3b>(row, column);
    return Eigen::RowVector3d(bgr[0], bgr[1], bgr[2]);
  };
  return (1 - dv) * ((1 - du) * at(x, y) + du * at(right, y)) +
         dv * ((1 - du) * at(x, below) + du * at(right, below));
}

}  // namespace

SeamLeveling::SeamLeveling(const ViewedSurface& viewed, std::span<const TextureChart> charts)
    : viewed_(viewed), charts_(charts) {
  findNodes();
  const auto count = static_cast<Eigen::Index>(nodes_.size());
  colors_ = Channels::Zero(count, 3);
  offsets_ = Channels::Zero(count, 3);
}

void SeamLeveling::findNodes() {
  struct Corner {
    std::uint64_t key;  // vertex, chart
    std::uint32_t number;
  };
  std::vector<Corner> corners;
  for (std::uint32_t chart = 0; chart < charts_.size(); ++chart) {
    for (const std::uint32_t face : charts_[chart].faces) {
      for (std::uint32_t i = 0; i < 3; ++i) {
        const std::uint64_t vertex = viewed_.surface.faces[face][i];
        corners.push_back({vertex << 32U | chart, 3 * face + i});
      }
    }
  }
  std::ranges::sort(corners, {}, &Corner::key);
  node_of_corner_.assign(3 * viewed_.surface.faces.size(), kNoNode);
  for (std::size_t i = 0; i < corners.size(); ++i) {
    if (i == 0 || corners[i].key != corners[i - 1].key) {
      nodes_.push_back({static_cast<std::uint32_t>(corners[i].key >> 32U),
                        static_cast<std::uint32_t>(corners[i].key & 0xFFFFFFFFU)});
    }
    node_of_corner_[corners[i].number] = static_cast<std::uint32_t>(nodes_.size() - 1);
  }
  for (std::uint32_t node = 0; node < nodes_.size(); ++node) {
    const bool is_shared = (node > 0 && nodes_[node - 1].vertex == nodes_[node].vertex) ||
                           (node + 1 < nodes_.size() && nodes_[node + 1].vertex == nodes_[node].vertex);
    if (is_shared) seam_nodes_.push_back(node);
  }
}

template <class Use>
void SeamLeveling::forEachSeamPair(const Use& use) const {
  for (std::size_t i = 0; i < seam_nodes_.size(); ++i) {
    for (std::size_t j = i + 1; j < seam_nodes_.size(); ++j) {
      if (nodes_[seam_nodes_[i]].vertex != nodes_[seam_nodes_[j]].vertex) break;
      use(static_cast<Eigen::Index>(seam_nodes_[i]), static_cast<Eigen::Index>(seam_nodes_[j]));
    }
  }
}

void SeamLeveling::sample(ViewNumber view, const cv::Mat& image) {
  const TextureView& camera = viewed_.views[view];
  const ViewProjection projection(camera, std::min(1.0, double{kSampledWidth_px} / camera.K.width));
  cv::Mat reduced;
  for (const std::uint32_t node : seam_nodes_) {
    if (charts_[nodes_[node].chart].view != view) continue;
    if (reduced.empty())
      cv::resize(image, reduced, {projection.intrinsics().width, projection.intrinsics().height}, 0, 0,
                 cv::INTER_AREA);
    const Eigen::Vector3f& position = viewed_.surface.positions_m[nodes_[node].vertex];
    colors_.row(node) = bilinearColor(reduced, projection.pixelOf(position));
  }
}

SeamLeveling::Channels SeamLeveling::offsetsOfCharts() const {
  const auto count = static_cast<Eigen::Index>(charts_.size());
  Channels sums = Channels::Zero(count, 3);
  std::vector<Eigen::Triplet<double>> entries;
  for (const Node& node : nodes_)
    entries.emplace_back(static_cast<int>(node.chart), static_cast<int>(node.chart), kSmallness);
  forEachSeamPair([&](Eigen::Index a, Eigen::Index b) {
    const auto chart_a = static_cast<int>(nodes_[static_cast<std::size_t>(a)].chart);
    const auto chart_b = static_cast<int>(nodes_[static_cast<std::size_t>(b)].chart);
    const Eigen::RowVector3d difference = colors_.row(a) - colors_.row(b);
    sums.row(chart_a) -= difference;
    sums.row(chart_b) += difference;
    entries.emplace_back(chart_a, chart_a, 1);
    entries.emplace_back(chart_b, chart_b, 1);
    entries.emplace_back(chart_a, chart_b, -1);
    entries.emplace_back(chart_b, chart_a, -1);
  });
  Eigen::SparseMatrix<double> matrix(count, count);
  matrix.setFromTriplets(entries.begin(), entries.end());
  const Eigen::SimplicialLDLT<Eigen::SparseMatrix<double>> solver(matrix);
  if (solver.info() != Eigen::Success) return Channels::Zero(count, 3);
  return solver.solve(sums);
}

SeamLeveling::Matrix SeamLeveling::equations() const {
  const auto count = static_cast<Eigen::Index>(nodes_.size());
  std::vector<Eigen::Triplet<double>> entries;
  entries.reserve(2 * node_of_corner_.size() + 2 * seam_nodes_.size());
  std::vector<double> diagonal(nodes_.size(), kSmallness);
  const auto join = [&](std::size_t a, std::size_t b, double weight) {
    diagonal[a] += weight;
    diagonal[b] += weight;
    entries.emplace_back(static_cast<int>(a), static_cast<int>(b), -weight);
    entries.emplace_back(static_cast<int>(b), static_cast<int>(a), -weight);
  };
  // An edge within a chart comes once from each of its faces.
  for (std::size_t corner = 0; corner < node_of_corner_.size(); ++corner) {
    if (node_of_corner_[corner] == kNoNode) continue;
    const std::size_t next = corner - corner % 3 + (corner + 1) % 3;
    join(node_of_corner_[corner], node_of_corner_[next], kSmoothness / 2);
  }
  forEachSeamPair([&](Eigen::Index a, Eigen::Index b) {
    join(static_cast<std::size_t>(a), static_cast<std::size_t>(b), 1);
  });
  for (std::size_t i = 0; i < diagonal.size(); ++i)
    entries.emplace_back(static_cast<int>(i), static_cast<int>(i), diagonal[i]);
  Matrix matrix(count, count);
  matrix.setFromTriplets(entries.begin(), entries.end());
  return matrix;
}

void SeamLeveling::solve() {
  if (seam_nodes_.empty()) return;
  const Channels of_charts = offsetsOfCharts();
  for (std::size_t node = 0; node < nodes_.size(); ++node)
    offsets_.row(static_cast<Eigen::Index>(node)) = of_charts.row(nodes_[node].chart);
  Channels sums = Channels::Zero(offsets_.rows(), 3);
  forEachSeamPair([&](Eigen::Index a, Eigen::Index b) {
    const Eigen::RowVector3d difference = colors_.row(a) - colors_.row(b);
    sums.row(a) -= difference;
    sums.row(b) += difference;
  });
  const Matrix matrix = equations();
  Eigen::ConjugateGradient<Matrix, Eigen::Lower | Eigen::Upper> solver;
  solver.setMaxIterations(kMaxSteps);
  solver.setTolerance(kTolerance);
  solver.compute(matrix);
  for (Eigen::Index channel = 0; channel < 3; ++channel) {
    const Eigen::VectorXd refined = solver.solveWithGuess(sums.col(channel), offsets_.col(channel));
    if (refined.allFinite()) offsets_.col(channel) = refined;
  }
  fadeRest(matrix);
}

void SeamLeveling::fadeRest(const Matrix& equations) {
  Channels rest = Channels::Zero(offsets_.rows(), 3);
  std::vector<int> ring_of(nodes_.size(), 0);  // 1: at a seam, 0: not reached
  for (std::size_t begin = 0; begin < seam_nodes_.size();) {
    std::size_t end = begin;
    Eigen::RowVector3d mean = Eigen::RowVector3d::Zero();
    for (; end < seam_nodes_.size() && nodes_[seam_nodes_[end]].vertex == nodes_[seam_nodes_[begin]].vertex;
         ++end)
      mean += colors_.row(seam_nodes_[end]) + offsets_.row(seam_nodes_[end]);
    mean /= static_cast<double>(end - begin);
    for (; begin < end; ++begin) {
      const std::uint32_t node = seam_nodes_[begin];
      rest.row(node) = mean - colors_.row(node) - offsets_.row(node);
      rest.row(node) = rest.row(node).cwiseMax(-kMostRest).cwiseMin(kMostRest).eval();
      ring_of[node] = 1;
    }
  }
  std::vector<std::uint32_t> front = seam_nodes_;
  for (int ring = 2; ring <= kFadingRings + 1; ++ring) {
    std::vector<std::uint32_t> next;
    const double factor = static_cast<double>(kFadingRings + 2 - ring) / (kFadingRings + 3 - ring);
    for (const std::uint32_t node : front) {
      for (Matrix::InnerIterator entry(equations, node); entry; ++entry) {
        const auto other = static_cast<std::uint32_t>(entry.col());
        if (ring_of[other] != 0 || nodes_[other].chart != nodes_[node].chart) continue;
        ring_of[other] = ring;
        next.push_back(other);
      }
    }
    for (const std::uint32_t node : next) {
      double count = 0;
      for (Matrix::InnerIterator entry(equations, node); entry; ++entry) {
        const auto other = static_cast<std::uint32_t>(entry.col());
        if (ring_of[other] != ring - 1 || nodes_[other].chart != nodes_[node].chart) continue;
        rest.row(node) += factor * rest.row(other);
        ++count;
      }
      rest.row(node) /= count;
    }
    front = std::move(next);
  }
  offsets_ += rest;
}

Eigen::Matrix3f SeamLeveling::offsetsOf(std::uint32_t face) const {
  Eigen::Matrix3f offsets = Eigen::Matrix3f::Zero();
  for (Eigen::Index i = 0; i < 3; ++i) {
    const std::uint32_t node = node_of_corner_[3 * face + static_cast<std::uint32_t>(i)];
    if (node != kNoNode) offsets.col(i) = offsets_.row(node).transpose().cast<float>();
  }
  return offsets;
}

}  // namespace scantrove
