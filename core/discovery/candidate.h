#pragma once
#include <Eigen/Core>
#include <Eigen/Geometry>
#include <opencv2/core/mat.hpp>
#include <optional>

#include "core/discovery/region_set.h"

namespace scantrove {

/// Objects bulge at least this much (bulgeOf()); patches of tables and walls bulge less.
inline constexpr float kClearBulge = 0.15F;

/// Regions that may be an object, as seen in one frame.
struct Candidate {
  RegionSet regions;
  cv::Rect box_px;  ///< in the frame's image
  cv::Mat mask;     ///< box_px.height x box_px.width, CV_8UC1, 255 = belongs to the regions
  Eigen::Vector3f centroid_world = Eigen::Vector3f::Zero();
  Eigen::Vector3f centroid_camera = Eigen::Vector3f::Zero();
  Eigen::Vector3f size_m = Eigen::Vector3f::Zero();  ///< sides of the oriented box, longest first
  int pixels = 0;                                    ///< of the frame's image
  float outline = 0;  ///< part of its visible outline that is its own (OutlineSteps::own)
  float hidden = 0;   ///< part of its outline that is occluded
  float bulge = 0;    ///< bulgeOf()
  float odds = 0;     ///< of several regions: log-odds of the weakest contact that joins them
  /// The largest accepted hidden part, from the general limit `of_any`. Regions that clearly bulge, and whose
  /// visible outline is all their own, may be hidden more.
  [[nodiscard]] float mostHidden(float of_any) const {
    constexpr float kClearOutline = 0.93F;  // noise may flip a few steps
    constexpr float kMore = 0.22F;          // so that half of a clear object may be hidden
    return of_any + (outline >= kClearOutline && bulge >= kClearBulge ? kMore : 0);
  }

  bool has_appeared = false;  ///< entered the scene during the scan
  bool is_complete = false;   ///< found complete over several observations: may become an object
  /// Log-odds that this observation shows one complete object (RegionJudge). None while the scan runs.
  std::optional<float> objectness;
  bool is_cut_off = false;  ///< by the image (RegionJudge); `size_m` is then that of all known points
};

}  // namespace scantrove
