#pragma once
#include <span>

namespace scantrove {

/// One picture of a known thing, compared with a catalogue that has other pictures of it, and once more
/// without them.
struct RecognitionTrial {
  bool is_right = false;       ///< the nearest object is this thing
  float distance = 2;          ///< of the nearest object
  float distance_without = 2;  ///< of the nearest object where the catalogue does not have this thing
};

/// Shares of the trials at one limit: an object is named if its distance is below.
struct RecognitionRates {
  double named = 0;          ///< rightly
  double wrong = 0;          ///< by the name of another thing
  double unknown_named = 0;  ///< although the catalogue does not have the thing
};

/// Share of the trials whose nearest object is the right one; 0 without trials.
[[nodiscard]] double nearestRight(std::span<const RecognitionTrial> trials);

/// All zero without trials.
[[nodiscard]] RecognitionRates ratesAt(std::span<const RecognitionTrial> trials, float limit);

/// The largest limit at which neither `wrong` nor `unknown_named` exceeds `most_false`; infinite if none does
/// at any limit.
[[nodiscard]] float limitFor(std::span<const RecognitionTrial> trials, double most_false);

}  // namespace scantrove
