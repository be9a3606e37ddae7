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

/// What a scan knows of its camera between two frames, beside the map: one that goes on with it finds the
/// poses, to the last bit, that a scan finds which never stopped. (Frames whose poses are uncertain are not
/// looked at again.)
struct CameraMemory {
  std::optional<PoseTracker::Memory> tracker;  ///< none: poses are given
  FreeSpace::Memory free_space;
  AppearedObjects::Memory appeared_objects;
  ColorIntegrator::Turns color_turns;
  RenderedView view;  ///< of the last usable frame, without labels
  /// Of what the camera is followed by; empty: poses are given.
  std::vector<Eigen::Vector4f> followed_normals_world;
};

/// As it goes to disk.
[[nodiscard]] std::vector<std::uint32_t> toWords(const CameraMemory& memory);
/// None: `words` are not of this version's toWords().
[[nodiscard]] std::optional<CameraMemory> cameraMemoryFrom(std::span<const std::uint32_t> words);

}  // namespace scantrove
