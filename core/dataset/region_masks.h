#pragma once
#include <opencv2/core/mat.hpp>

#include "core/dataset/labeled_scan.h"

namespace scantrove {

/// A camera's depth and colour, to correct the rendered view of the map. All h x w.
struct MeasuredView {
  cv::Mat depth_m;  ///< CV_32FC1, 0 = no reading
  cv::Mat color;    ///< CV_8UC3; empty: outlines follow depth alone
};

/// The map's regions with the outlines of the camera's images: CV_32SC1, h x w, 0 = none.
///
/// The map has an outline to about a voxel and a pose to about a centimetre; the image to a pixel. First,
/// each pixel's measured depth is compared with the map's, after the median difference of its region. If they
/// differ by more than their noise, the pixel takes the region of the nearest pixel where the map has that
/// depth. It takes none if there is no such pixel: something outside the map hides the region. A mixture of
/// two depths at an edge counts as no reading. Second, outlines move to edges of the colour image
/// (followColorEdges). Third, small components take the region around them. `focal_px`: pixels per metre at
/// one metre distance.
[[nodiscard]] cv::Mat refineRegions(const ViewOfMap& map, const MeasuredView& measured, float focal_px);

}  // namespace scantrove
