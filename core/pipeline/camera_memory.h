#pragma once
#include <Eigen/Core>
#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include "core/fusion/appeared_objects.h"
#include "core/fusion/color_integrator.h"
#include "core/fusion/free_space.h"
#include "core/fusion/rendered_view.h"
#include "core/tracking/pose_tracker.h"

namespace scantrove {

/// The camera state between two frames, beside the map. A scan continued with it finds exactly the poses of
/// an uninterrupted scan. (Frames with uncertain poses are not reconsidered.)
struct CameraMemory {
  std::optional<PoseTracker::Memory> tracker;  ///< none: poses are given
  FreeSpace::Memory free_space;
  AppearedObjects::Memory appeared_objects;
  ColorIntegrator::Turns color_turns;
  RenderedView view;  ///< of the last usable frame, without labels
  /// The surface that the camera is tracked against; empty: poses are given.
  std::vector<Eigen::Vector4f> reference_normals_world;
};

/// Serializes for disk.
[[nodiscard]] std::vector<std::uint32_t> toWords(const CameraMemory& memory);
/// None: `words` are not from this version's toWords().
[[nodiscard]] std::optional<CameraMemory> cameraMemoryFrom(std::span<const std::uint32_t> words);

}  // namespace scantrove
