#include "core/editing/stroke_surroundings.h"

#include <algorithm>
#include <cmath>

#include "core/editing/surface_colors.h"
#include "core/editing/surface_paths.h"

namespace scantrove {
namespace {

/// Sum of the differences from voxel to voxel along a path that crosses an edge. Those of slow changes, below
/// kSlow_lab, do not count.
constexpr float kCrossed_lab = 5;
constexpr float kSlow_lab = 0.3F;
/// Smaller components are noise.
constexpr std::size_t kLeastPiece = 30;

/// 1 for voxels that differ in colour from the stroke and lie across an edge.
std::vector<std::uint8_t> differentFrom(const SurfaceGraph& graph, std::span<const std::uint32_t> stroke,
                                        const MainColors& colors) {
  std::vector<float> costs;
  costs.reserve(graph.edges.size());
  for (const SurfaceGraph::Edge& edge : graph.edges)
    costs.push_back(std::max(0.0F, tintDifference(graph.tints[edge.a], graph.tints[edge.b]) - kSlow_lab));
  const std::vector<float> crossed = pathLengths(graph, stroke, costs);
  std::vector<std::uint8_t> differs(graph.voxels.size(), 0);
  for (std::uint32_t voxel = 0; voxel < differs.size(); ++voxel) {
    const bool is_across = std::isfinite(crossed[voxel]) && crossed[voxel] >= kCrossed_lab;
    differs[voxel] = is_across && colors.differFrom(graph, voxel) ? 1 : 0;
  }
  return differs;
}

}  // namespace

std::vector<std::uint32_t> surroundingsOf(const SurfaceGraph& graph, std::span<const std::uint32_t> stroke) {
  const MainColors colors = MainColors::of(graph, stroke);
  if (colors.tints.empty()) return {};
  const std::vector<std::uint8_t> differs = differentFrom(graph, stroke, colors);
  const SurfacePieces pieces = piecesOf(graph, differs);
  if (pieces.sizes.empty()) return {};
  std::vector<std::uint8_t> alike(differs.size());
  for (std::size_t voxel = 0; voxel < alike.size(); ++voxel) alike[voxel] = differs[voxel] == 0 ? 1 : 0;
  const SurfacePieces others = piecesOf(graph, alike);
  std::size_t around_stroke = 0;
  for (const std::uint32_t voxel : stroke) {
    if (others.piece[voxel] != SurfacePieces::kNone)
      around_stroke = std::max(around_stroke, others.sizes[others.piece[voxel]]);
  }
  const std::size_t largest = std::ranges::max(pieces.sizes);
  // Things on the surface that the stroke covers, or else what lies around the thing that it covers.
  const std::size_t least = largest < around_stroke ? kLeastPiece : std::min(largest, around_stroke);
  std::vector<std::uint32_t> surroundings;
  for (std::uint32_t voxel = 0; voxel < differs.size(); ++voxel) {
    if (differs[voxel] != 0 && pieces.sizes[pieces.piece[voxel]] >= std::max(least, kLeastPiece))
      surroundings.push_back(voxel);
  }
  return surroundings;
}

}  // namespace scantrove
