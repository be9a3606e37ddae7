#pragma once

namespace scantrove {

/// Recognition of candidates against the catalogue (thesis 5.2).
struct DetectionParams {
  /// Maximum distance of two thumbnails. The distance is the warped SSD of the normalised thumbnails relative
  /// to their energy (0 = same, 2 = unrelated), plus the squared difference of mean Lab colours / 40.
  /// Measured on crops of a real kitchen (36 objects, a view every 20 degrees): 0.5 recognises 46 % of single
  /// views, 0.5 % wrongly. 0.6 recognises 54 %, 3 % wrongly. A wrong name costs more than none.
  float max_distance = 0.5F;
  int shortlist = 16;            ///< candidates left after pruning by principal components
  float size_tolerance = 0.35F;  ///< maximum relative difference of the oriented boxes' diagonals
  float new_view_angle_deg =
      10;              ///< a view is stored if its direction differs this much from all stored ones
  int max_views = 24;  ///< per object
};

}  // namespace scantrove
