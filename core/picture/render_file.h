#pragma once
#include <filesystem>
#include <functional>
#include <stop_token>
#include <string>

#include "core/base/result.h"
#include "core/picture/picture_scene.h"

namespace scantrove {

/// What is drawn, and how.
struct RenderOptions {
  std::filesystem::path file;  ///< a new file: .png is one picture, .webm a video that goes around once
  PictureColors colors = PictureColors::rgb;
  std::string object = {};  ///< only regions of this name; empty: everything
  int width = 1280, height = 720;
  double seconds = 8;  ///< of a video
  int frames_per_second = 30;
  double azimuth_deg = 0, elevation_deg = 30;  ///< of the picture, and where a video begins
};

/// Largest values of RenderOptions; at least 16 pixels and one frame.
inline constexpr int kLeastPictureSide_px = 16, kLargestPictureSide_px = 8192;
inline constexpr int kMostVideoFrames = 36'000;

/// Frames drawn, and how many there are.
using RenderProgress = std::function<void(int done, int total)>;

/// Frames of the file: 1 for a picture. Error: another extension, or a value out of range.
[[nodiscard]] Result<int> renderFrameCount(const RenderOptions& options);

/// Draws the scan into the file, which is there complete or not at all. Error: as renderFrameCount and
/// makePictureScene; something of that name exists; it cannot be written; `cancel` was requested.
[[nodiscard]] Result<void> renderScan(LabeledScan& scan, const RenderOptions& options,
                                      const RenderProgress& progress, const std::stop_token& cancel);

}  // namespace scantrove
