#pragma once

namespace scantrove {

/// Recognition of candidates against the catalogue (thesis 5.2).
struct DetectionParams {
  float max_distance = 0.5F;      ///< warped SSD per element of normalised thumbnails, below = recognised (2 = unrelated)
  int shortlist = 16;             ///< candidates left after pruning by principal components
  float size_tolerance = 0.5F;    ///< relative difference of the oriented box's diagonal that still may match
  float new_view_angle_deg = 20;  ///< a view is kept when its direction is so far from all kept ones
  int max_views = 24;             ///< of one object
};

}  // namespace scantrove
