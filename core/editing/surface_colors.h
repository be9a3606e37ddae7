#pragma once
#include <Eigen/Core>
#include <cstdint>
#include <span>
#include <vector>

#include "core/editing/surface_graph.h"

namespace scantrove {

/// The difference of two tints in Lab units. A tint is (L* + 16, a*, b*). Less light scales all three by one
/// factor, so the part of the difference along the tints themselves may be shadow and counts a quarter.
[[nodiscard]] float tintDifference(const Eigen::Vector3f& one, const Eigen::Vector3f& other);

/// The tint of each voxel; zero where it was never seen in colour.
[[nodiscard]] std::vector<Eigen::Vector3f> tintsOf(std::span<const SurfaceVoxel> voxels);

/// The main colours of some voxels of a graph.
struct MainColors {
  std::vector<Eigen::Vector3f> tints;  ///< each of a share of the voxels; empty: no colour
  float variation = 0;                 ///< median over the voxels

  [[nodiscard]] static MainColors of(const SurfaceGraph& graph, std::span<const std::uint32_t> voxels);
  /// True if a voxel with a known colour differs clearly from all of them.
  [[nodiscard]] bool differFrom(const SurfaceGraph& graph, std::uint32_t voxel) const;
};

/// Fills `tints`, `color_variation` and the colour steps of a graph with edges and neighbours. The variation
/// is the median difference between a voxel and its neighbours, averaged nearby: high on grain and print,
/// low on plain surface, and little affected by a single edge. The tints are then smoothed over what differs
/// no more than that; voxels without colour take that of their neighbours. Any thread.
void addColors(SurfaceGraph& graph);

}  // namespace scantrove
