#pragma once

namespace scantrove {

/// Recognition of candidates against the catalogue (thesis 5.2).
struct DetectionParams {
  /// Warped SSD of normalised thumbnails relative to their energy (0 = same, 2 = unrelated) plus the squared
  /// difference of mean Lab colours / 40: below = recognised. On crops of a real kitchen (36 objects, a view
  /// each 20 degrees in the catalogue) 0.5 names 46 % of single looks, 0.5 % wrongly; 0.6 names 54 %, 3 %
  /// wrongly. A wrong name costs more.
  float max_distance = 0.5F;
  int shortlist = 16;             ///< candidates left after pruning by principal components
  float size_tolerance = 0.35F;   ///< relative difference of the oriented box's diagonal that still may match
  float new_view_angle_deg = 10;  ///< a view is kept when its direction is so far from all kept ones
  int max_views = 24;             ///< of one object
};

}  // namespace scantrove
