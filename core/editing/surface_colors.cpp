#include "core/editing/surface_colors.h"

#include <algorithm>
#include <cmath>
#include <opencv2/imgproc.hpp>
#include <utility>

namespace scantrove {
namespace {

/// Weight of a difference that may be shadow.
constexpr float kShade = 0.25F;
/// L* + 16 scales with the light like a* and b*.
constexpr float kBlack = 16;
/// Variation below this is noise of the camera.
constexpr float kLeastVariation = 1;
/// Smoothing covers differences up to about this many times the variation.
constexpr float kSmoothed = 2;
constexpr int kSmoothings = 4;
/// Rounds over the neighbours of a voxel, to find the variation beside an edge and to average it.
constexpr int kQuartiles = 2, kAverages = 2;
/// How far colours reach into voxels without, in voxels.
constexpr int kFillings = 3;
/// Tints within this distance are one main colour.
constexpr float kOneColor_lab = 5;
/// Main colours have at least this share of the voxels; the rest are slips over an edge.
constexpr float kLeastShare = 0.08F;
/// Voxels that suffice to find main colours.
constexpr std::size_t kSampled = 4000;
/// A voxel differs if its tint does by this many times the variation, and by kDifferent_lab.
constexpr float kDifferent = 3;
constexpr float kDifferent_lab = 5;

bool isKnown(const Eigen::Vector3f& tint) { return tint.x() > 0; }

constexpr float kUnknown = -1;

float squaredDifference(const Eigen::Vector3f& one, const Eigen::Vector3f& other) {
  const Eigen::Vector3f step = other - one, both = one + other;
  const float square = step.squaredNorm(), along = step.dot(both);
  const float shade = along * along / std::max(both.squaredNorm(), 1.0F);
  return std::max(0.0F, square - shade) + kShade * kShade * shade;
}

/// Voxels without colour take the mean of their neighbours.
void fillUnknown(const SurfaceGraph& graph, std::vector<Eigen::Vector3f>& tints) {
  for (int i = 0; i < kFillings; ++i) {
    std::vector<std::pair<std::uint32_t, Eigen::Vector3f>> filled;
    for (std::uint32_t voxel = 0; voxel < tints.size(); ++voxel) {
      if (isKnown(tints[voxel])) continue;
      Eigen::Vector3f sum = Eigen::Vector3f::Zero();
      int known = 0;
      for (const SurfaceGraph::Neighbor& next : graph.neighborsOf(voxel)) {
        if (!isKnown(tints[next.voxel])) continue;
        sum += tints[next.voxel];
        ++known;
      }
      if (known > 0) filled.emplace_back(voxel, sum / static_cast<float>(known));
    }
    if (filled.empty()) return;
    for (const auto& [voxel, tint] : filled) tints[voxel] = tint;
  }
}

/// The value at `share` (0 .. 1) of the way from the least to the largest; reorders them.
float quantile(std::vector<float>& values, double share) {
  const auto at =
      values.begin() + static_cast<std::ptrdiff_t>(share * static_cast<double>(values.size() - 1));
  std::nth_element(values.begin(), at, values.end());
  return *at;
}

/// The median difference between each voxel and its neighbours.
std::vector<float> medianDifferences(const SurfaceGraph& graph, std::span<const Eigen::Vector3f> tints) {
  std::vector<float> of_edges;
  of_edges.reserve(graph.edges.size());
  for (const SurfaceGraph::Edge& edge : graph.edges) {
    const Eigen::Vector3f &a = tints[edge.a], &b = tints[edge.b];
    of_edges.push_back(isKnown(a) && isKnown(b) ? tintDifference(a, b) : kUnknown);
  }
  std::vector<float> medians(tints.size(), 0), differences;
  for (std::uint32_t voxel = 0; voxel < tints.size(); ++voxel) {
    differences.clear();
    for (const SurfaceGraph::Neighbor& next : graph.neighborsOf(voxel)) {
      if (of_edges[next.edge] != kUnknown) differences.push_back(of_edges[next.edge]);
    }
    if (!differences.empty()) medians[voxel] = quantile(differences, 0.5);
  }
  return medians;
}

/// The lower quartile nearby, which an edge of few voxels does not reach.
std::vector<float> lowerQuartilesNearby(const SurfaceGraph& graph, const std::vector<float>& values) {
  std::vector<float> quartiles(values.size()), nearby;
  for (std::uint32_t voxel = 0; voxel < values.size(); ++voxel) {
    nearby.assign(1, values[voxel]);
    for (const SurfaceGraph::Neighbor& next : graph.neighborsOf(voxel)) nearby.push_back(values[next.voxel]);
    quartiles[voxel] = quantile(nearby, 0.25);
  }
  return quartiles;
}

std::vector<float> averagedNearby(const SurfaceGraph& graph, const std::vector<float>& values) {
  std::vector<float> averages(values.size());
  for (std::uint32_t voxel = 0; voxel < values.size(); ++voxel) {
    float sum = values[voxel];
    const auto neighbors = graph.neighborsOf(voxel);
    for (const SurfaceGraph::Neighbor& next : neighbors) sum += values[next.voxel];
    averages[voxel] = sum / static_cast<float>(neighbors.size() + 1);
  }
  return averages;
}

/// One step of smoothing that keeps edges (Tomasi and Manduchi 1998, with a rational kernel).
std::vector<Eigen::Vector3f> smoothed(const SurfaceGraph& graph, const std::vector<Eigen::Vector3f>& tints) {
  std::vector<Eigen::Vector3f> sums = tints;
  std::vector<float> weights(tints.size(), 1);
  for (const SurfaceGraph::Edge& edge : graph.edges) {
    const Eigen::Vector3f &a = tints[edge.a], &b = tints[edge.b];
    if (!isKnown(a) || !isKnown(b)) continue;
    const float limit = kSmoothed * std::min(graph.color_variation[edge.a], graph.color_variation[edge.b]);
    const float fall = limit * limit / (limit * limit + squaredDifference(a, b));
    const float weight = fall * fall;
    sums[edge.a] += weight * b;
    sums[edge.b] += weight * a;
    weights[edge.a] += weight;
    weights[edge.b] += weight;
  }
  for (std::size_t voxel = 0; voxel < sums.size(); ++voxel) sums[voxel] /= weights[voxel];
  return sums;
}

}  // namespace

float tintDifference(const Eigen::Vector3f& one, const Eigen::Vector3f& other) {
  return std::sqrt(squaredDifference(one, other));
}

std::vector<Eigen::Vector3f> tintsOf(std::span<const SurfaceVoxel> voxels) {
  std::vector<cv::Vec3f> colors;
  for (const SurfaceVoxel& voxel : voxels) {
    if (!voxel.rgb) continue;
    const auto& [r, g, b] = *voxel.rgb;
    colors.emplace_back(static_cast<float>(r) / 255, static_cast<float>(g) / 255,
                        static_cast<float>(b) / 255);
  }
  std::vector<Eigen::Vector3f> tints(voxels.size(), Eigen::Vector3f::Zero());
  if (colors.empty()) return tints;
  cv::Mat_<cv::Vec3f> lab;
  cv::cvtColor(cv::Mat(1, static_cast<int>(colors.size()), CV_32FC3, colors.data()), lab, cv::COLOR_RGB2Lab);
  int place = 0;
  for (std::size_t i = 0; i < voxels.size(); ++i) {
    if (!voxels[i].rgb) continue;
    const cv::Vec3f& color = lab(0, place++);
    tints[i] = {color[0] + kBlack, color[1], color[2]};
  }
  return tints;
}

MainColors MainColors::of(const SurfaceGraph& graph, std::span<const std::uint32_t> voxels) {
  struct Group {
    Eigen::Vector3f sum;
    float count;
  };
  std::vector<Group> groups;
  std::vector<float> variations;
  if (graph.tints.empty()) return {};
  const std::size_t stride = 1 + voxels.size() / kSampled;
  for (std::size_t i = 0; i < voxels.size(); i += stride) {
    const std::uint32_t voxel = voxels[i];
    const Eigen::Vector3f& tint = graph.tints[voxel];
    if (!isKnown(tint)) continue;
    variations.push_back(graph.color_variation[voxel]);
    const auto near = std::ranges::find_if(groups, [&](const Group& group) {
      return tintDifference(group.sum / group.count, tint) < kOneColor_lab;
    });
    if (near == groups.end()) {
      groups.push_back({tint, 1});
    } else {
      near->sum += tint;
      ++near->count;
    }
  }
  MainColors colors;
  if (variations.empty()) return colors;
  for (const Group& group : groups) {
    if (group.count >= kLeastShare * static_cast<float>(variations.size()))
      colors.tints.push_back(group.sum / group.count);
  }
  colors.variation = quantile(variations, 0.5);
  return colors;
}

bool MainColors::differFrom(const SurfaceGraph& graph, std::uint32_t voxel) const {
  if (tints.empty() || !isKnown(graph.tints[voxel])) return false;
  const float limit =
      std::max(kDifferent_lab, kDifferent * std::max(variation, graph.color_variation[voxel]));
  return std::ranges::all_of(
      tints, [&](const Eigen::Vector3f& tint) { return tintDifference(tint, graph.tints[voxel]) > limit; });
}

void addColors(SurfaceGraph& graph) {
  if (std::ranges::none_of(graph.voxels, [](const SurfaceVoxel& voxel) { return voxel.rgb.has_value(); }))
    return;
  graph.tints = tintsOf(graph.voxels);
  std::vector<float> variation = medianDifferences(graph, graph.tints);
  for (int i = 0; i < kQuartiles; ++i) variation = lowerQuartilesNearby(graph, variation);
  for (int i = 0; i < kAverages; ++i) variation = averagedNearby(graph, variation);
  graph.color_variation = std::move(variation);
  for (float& of_voxel : graph.color_variation) of_voxel = std::max(of_voxel, kLeastVariation);
  fillUnknown(graph, graph.tints);
  for (int i = 0; i < kSmoothings; ++i) graph.tints = smoothed(graph, graph.tints);
  for (SurfaceGraph::Edge& edge : graph.edges) {
    const Eigen::Vector3f &a = graph.tints[edge.a], &b = graph.tints[edge.b];
    if (!isKnown(a) || !isKnown(b)) continue;
    edge.color_step =
        2 * tintDifference(a, b) / (graph.color_variation[edge.a] + graph.color_variation[edge.b]);
  }
}

}  // namespace scantrove
