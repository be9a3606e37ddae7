#pragma once
#include <string>

namespace scantrove {

/// Recognition of candidates against the catalogue (thesis 5.2).
struct DetectionParams {
  /// Maximum distance of an object, judged by the runners-up (matchDistance, relativeDistance): 0 = same
  /// picture; unrelated objects differ by 0.6 and more. Single photographs of 41 things, 3 views of other
  /// scenes each: 0.5 names 46 %, 2 % wrongly, and 4 % of the things that are unknown; 0.4 names 33 %, 1 %
  /// and 1 %. A wrong name costs more than none, and several frames must agree.
  float max_distance = 0.5F;
  int shortlist = 16;  ///< views left after pruning by principal components
  /// Maximum relative difference of the oriented boxes' diagonals. In scans the sizes of one object differ by
  /// less; what differs more is a part, or another object of the same look.
  float size_tolerance = 0.35F;
  float new_view_angle_deg =
      10;                  ///< a view is stored if its direction differs this much from all stored ones
  int max_views = 24;      ///< per object
  std::string model = {};  ///< an ONNX file, see AppearanceNetwork; empty: none. Fixed for a scan.
};

}  // namespace scantrove
