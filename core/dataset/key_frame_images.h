#pragma once
#include <cstdint>
#include <functional>
#include <opencv2/core/mat.hpp>
#include <string>
#include <unordered_set>
#include <vector>

#include "core/dataset/export_job.h"

namespace scantrove {

/// A key frame with its labels, at the resolution of its colour image (without colour: of its depth image).
struct LabeledImage {
  KeyFrameInfo frame;
  Intrinsics K;
  Eigen::Isometry3d T_world_camera = Eigen::Isometry3d::Identity();
  cv::Mat regions;          ///< CV_32SC1; regions that count and are visible, else 0
  cv::Mat depth_m;          ///< CV_32FC1, measured, as this camera sees it; 0 = no reading
  std::string stem;         ///< "000120", of its files
  std::string image_bytes;  ///< the colour image: the recorded bytes where these are JPEG or PNG of 8-bit
                            ///< RGB, without an orientation; else a PNG of that kind; empty without colour
  std::string image_name;   ///< stem with the extension that fits; empty without colour

  /// CV_8UC1, 255 = the region.
  [[nodiscard]] cv::Mat maskOf(std::uint32_t region) const { return regions == static_cast<int>(region); }
};

/// A key frame whose labels need not be known yet.
struct KeyFrameImage {
  LabeledImage image;
  cv::Mat color;  ///< CV_8UC3; empty without colour
};
/// Without labels. Error: the frame is unusable; the others need not be.
[[nodiscard]] Result<KeyFrameImage> readKeyFrameImage(LabeledScan& scan, const KeyFrameInfo& frame);
/// Finds its labels in the map, those of `kept` only. Error: the map.
[[nodiscard]] Result<void> labelImage(LabeledScan& scan, KeyFrameImage& read,
                                      const std::unordered_set<int>& kept);
[[nodiscard]] std::unordered_set<int> idsOf(const std::vector<LabeledRegion>& regions);

/// What a format makes of one frame.
using UseLabeledImage = std::function<Result<void>(const LabeledImage&)>;

/// Gives every key frame with its labels in turn, and counts them; says how far it is. Frames that cannot be
/// read are named in the summary and left out, as are those without colour if `needs_color`. Error: no frame
/// could be used (with what was the matter with the first); what `use` returns; the map; cancelled.
[[nodiscard]] Result<void> forEachLabeledImage(ExportJob& job, bool needs_color, const UseLabeledImage& use);

/// Regions of `image` that are visible, by id.
[[nodiscard]] std::vector<std::uint32_t> visibleRegions(const cv::Mat& regions);

}  // namespace scantrove
