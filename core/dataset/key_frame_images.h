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
  cv::Mat regions;          ///< CV_32SC1; exported and visible regions, else 0
  cv::Mat ignored;          ///< CV_8UC1, nonzero: unlabelled objects to ignore; empty: none in this data set
  cv::Mat depth_m;          ///< CV_32FC1, measured depth registered to this camera; 0 = no reading
  std::string stem;         ///< base of its file names: "000120", in a project "kitchen_000120"
  std::string image_bytes;  ///< the colour image: the recorded bytes if they are JPEG or PNG with 8-bit RGB
                            ///< and without orientation; else converted to PNG; empty without colour
  std::string image_name;   ///< stem with the matching extension; empty without colour

  /// CV_8UC1, 255 = the region.
  [[nodiscard]] cv::Mat maskOf(std::uint32_t region) const { return regions == static_cast<int>(region); }
};

/// The colour image (not empty) for formats with one type of file: its bytes if they have that type, else
/// converted; to JPEG with quality 95. Error: it cannot be decoded.
[[nodiscard]] Result<std::string> asJpeg(const LabeledImage& image);
[[nodiscard]] Result<std::string> asPng(const LabeledImage& image);

/// A key frame without labels.
struct KeyFrameImage {
  LabeledImage image;
  cv::Mat color;  ///< CV_8UC3; empty without colour
};
/// Reads it without labels. Error: the frame is unusable; others may be usable.
[[nodiscard]] Result<KeyFrameImage> readKeyFrameImage(LabeledScan& scan, const KeyFrameInfo& frame);
/// Renders its labels from the map, with what a person painted; only those of `kept`. Its pose becomes that
/// at which the map fits its depth. Error: the map.
[[nodiscard]] Result<void> labelImage(LabeledScan& scan, KeyFrameImage& read,
                                      const std::unordered_set<int>& kept);
[[nodiscard]] std::unordered_set<int> idsOf(const std::vector<LabeledRegion>& regions);

/// The key frames of the export, chosen at the first call: those with colour if `needs_color`, and unless the
/// options include them, without frames that are unfit (FrameFitness). The others are named in the summary.
/// Error: the scan has no key frames (in a project there are none, then); cancelled.
[[nodiscard]] Result<std::vector<KeyFrameInfo>> framesToExport(ExportJob& job, bool needs_color);

/// Processes one frame for a format.
using UseLabeledImage = std::function<Result<void>(const LabeledImage&)>;

/// Passes every frame of framesToExport() with its labels to `use`, counts them, and reports the progress.
/// Unreadable frames are skipped and named in the summary; in a project, a scan without usable frames is
/// named in the notes. Error: no frame was usable (with the first reason); an error of `use`; the map;
/// cancelled.
[[nodiscard]] Result<void> forEachLabeledImage(ExportJob& job, bool needs_color, const UseLabeledImage& use);

/// Visible regions of `image`, by id.
[[nodiscard]] std::vector<std::uint32_t> visibleRegions(const cv::Mat& regions);

}  // namespace scantrove
