#pragma once
#include <opencv2/core/mat.hpp>

#include "core/dataset/labeled_scan.h"

namespace scantrove {

/// What a camera measured and photographed, to correct the map's view by. All h x w.
struct MeasuredView {
  cv::Mat depth_m;  ///< CV_32FC1, 0 = no reading
  cv::Mat color;    ///< CV_8UC3; empty: outlines follow depth alone
};

/// The map's regions with outlines where the camera saw them: CV_32SC1, h x w, 0 = none.
///
/// The map knows an outline to about a voxel and a pose to about a centimetre; the image to a pixel. A pixel
/// whose measured depth is not the map's there, by more than both are noisy, takes the region of the nearest
/// pixel around it at which the map has that depth, or none (something that is not in the map hides it); a
/// mixture of two depths at an edge counts as no reading. Then, in a band along the outlines as wide as the
/// map is coarse, a pixel takes the region of those around it that are as deep and of its colour. A pixel
/// without a reading has colour alone to go by. At last, specks become what is around them. `focal_px`:
/// pixels that one metre at the distance of one metre takes.
[[nodiscard]] cv::Mat refineRegions(const ViewOfMap& map, const MeasuredView& measured, float focal_px);

}  // namespace scantrove
