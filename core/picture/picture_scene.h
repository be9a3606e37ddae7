#pragma once
#include <optional>
#include <string>

#include "core/base/result.h"
#include "core/dataset/labeled_scan.h"
#include "core/picture/picture_surface.h"
#include "core/picture/turntable_camera.h"

namespace scantrove {

/// What the colors of a picture show.
enum class PictureColors {
  rgb,      ///< the scene's own
  regions,  ///< each region in its color
  objects,  ///< each object in its color, all else in grey
};

/// "rgb", "regions", "objects"; none: another word.
[[nodiscard]] std::optional<PictureColors> parsePictureColors(const std::string& word);

/// A surface to be drawn, and the directions that place the camera; unit vectors.
struct PictureScene {
  PictureSurface surface;
  Eigen::Vector3f up_world = Eigen::Vector3f::UnitZ();
  Eigen::Vector3f front_world = Eigen::Vector3f::UnitX();  ///< from the content to where the scan saw it from
};

/// The scene of a scan. `object`: only regions of that name; empty: everything. Error: the scan's; there is
/// no surface; no region has that name.
[[nodiscard]] Result<PictureScene> makePictureScene(LabeledScan& scan, PictureColors colors,
                                                    const std::string& object);

}  // namespace scantrove
