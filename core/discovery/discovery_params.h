#pragma once

namespace scantrove {

/// Conditions for a region to be a candidate (thesis 5.1).
struct DiscoveryParams {
  float central_fraction =
      0.95F;  ///< the centroid lies in the middle part of the view, this fraction of width and height
  float min_size_m = 0.02F;  ///< longest side of the oriented box
  float max_size_m = 0.7F;
  int min_points = 400;               ///< pixels at 640x480 equivalent
  int persistent_frames = 6;          ///< consecutive observations with a stable size
  float size_tolerance = 0.25F;       ///< relative change of area * z^2 that still counts as stable
  float min_thickness_ratio = 0.02F;  ///< sqrt of smallest / largest eigenvalue of the points: below = flat
  float max_flat_size_m =
      0.4F;  ///< flat regions up to this longest side may still be objects: books, boxes seen face on
  float min_bulge = -0.03F;  ///< bulgeOf(): below = concave, the inside of an object
  /// Second side of the box / longest side. A region below this that does not bulge is a strip of a larger
  /// object: the edge of a board, a leg, a handle.
  float min_strip_ratio = 0.3F;
  float max_eccentricity = 0.98F;    ///< of the image region's ellipse
  float max_hidden_fraction = 0.5F;  ///< occluded part of the outline: above = background seen through a gap
  /// Strips at the image's edges up to this wide may lack readings: the projector's light or, after
  /// registration, the colour image ends there (a Kinect loses 8 to 24 of 640 columns).
  float max_strip_fraction = 0.04F;
  // A candidate is complete, and may become an object, if
  int complete_observations = 10;  ///< it passed all rules this often,
  float complete_outline = 0.8F;   ///< this part of its outline was its own on average (OutlineSteps::own),
  float complete_hidden = 0.35F;   ///< no more of its outline was occluded,
  float complete_angle_deg = 5;    ///< and its directions were this far apart,
  int still_frames = 15;           ///< or, with a still camera, it was seen for this many frames
  int border_px = 2;               ///< a region this close to the image border is no candidate
};

}  // namespace scantrove
