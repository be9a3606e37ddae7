#pragma once
#include <opencv2/core/mat.hpp>

namespace scantrove {

/// Images of one camera, all h x w.
struct OutlineImages {
  cv::Mat color;       ///< CV_8UC3
  cv::Mat z_m;         ///< CV_32FC1, depth of the surface, measured or from the map; 0 = unknown
  cv::Mat unmeasured;  ///< CV_8UC1, nonzero: no depth reading
  float focal_px = 0;  ///< pixels per metre at one metre distance
};

/// Moves the outlines of regions to the edges of the colour image. `regions`: CV_32SC1, h x w; the result has
/// the same ids. 0 = none counts as a region, so regions neither overlap nor leave gaps.
///
/// Only pixels near an outline are undecided: within the map's resolution, and without a depth reading within
/// twice that. For each region a guided filter (He, Sun, Tang 2010: a linear function of colour in each small
/// window, averaged) predicts its share of a pixel, and the largest share wins. An outline stays where colour
/// explains less than a quarter of it, because both sides have one colour. Uses several threads; the result
/// does not depend on their number.
[[nodiscard]] cv::Mat followColorEdges(const cv::Mat& regions, const OutlineImages& images);

}  // namespace scantrove
