#pragma once
#include <Eigen/Core>
#include <Eigen/Geometry>
#include <opencv2/core/mat.hpp>
#include <optional>

#include "core/discovery/region_set.h"

namespace scantrove {

/// bulgeOf() from which on a thing bulges as no patch of a table or a wall does.
inline constexpr float kClearBulge = 0.15F;

/// Regions that may be an object, as seen in one frame.
struct Candidate {
  RegionSet regions;
  cv::Rect box_px;  ///< in the image that it was seen in
  cv::Mat mask;     ///< box_px.height x box_px.width, CV_8UC1, 255 = belongs to the regions
  Eigen::Vector3f centroid_world = Eigen::Vector3f::Zero();
  Eigen::Vector3f centroid_camera = Eigen::Vector3f::Zero();
  Eigen::Vector3f size_m = Eigen::Vector3f::Zero();  ///< sides of the oriented box, longest first
  int pixels = 0;                                    ///< of that image
  float outline = 0;  ///< part of what is seen of its outline that is its own (OutlineSteps::own)
  float hidden = 0;   ///< part of its outline that lies behind something nearer
  float bulge = 0;    ///< bulgeOf()
  float odds = 0;     ///< of several regions: log-odds of the weakest contact that holds them together
  /// How much of a thing may lie behind others so that it is still clear what it is: more of one whose
  /// outline is its own wherever it shows, and which clearly bulges.
  [[nodiscard]] float mostHidden(float of_any) const {
    constexpr float kClearOutline = 0.93F;  // all but a few steps, which noise may turn
    constexpr float kMore = 0.22F;          // so that half of a clear object may be hidden
    return of_any + (outline >= kClearOutline && bulge >= kClearBulge ? kMore : 0);
  }

  bool has_appeared = false;  ///< into the scene, while it was watched
  bool is_complete = false;   ///< has shown itself to be whole, over several looks: may become an object
  /// Log-odds that this look shows one whole thing, by all that is known (RegionJudge). None: more may come.
  std::optional<float> objectness;
  bool is_cut_off =
      false;  ///< by the image, as far as RegionJudge says; `size_m` is of all that is known then
};

}  // namespace scantrove
