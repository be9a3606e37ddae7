#pragma once
#include <optional>
#include <vector>

namespace scantrove {

/// What differs between a query and a stored view.
struct ViewDifference {
  float shape = 2;               ///< warped SSD of the thumbnails: 0 = same, 2 = unrelated
  float mean_color = 0;          ///< squared difference of the mean Lab colours / 40^2
  std::optional<float> colors;   ///< squared Hellinger distance of the histograms; none: a view has none
  float size = 0;                ///< |ln| of the ratio of the boxes' diagonals; 0: unknown
  std::optional<float> network;  ///< as AppearanceNetwork::distance(); none: a view has no such vector
};

/// One number for all evidence: 0 = the same view; unrelated objects of one size differ by 0.7 and more,
/// most by 1.
[[nodiscard]] float matchDistance(const ViewDifference& difference);

/// `distance` of the nearest object, judged by the runners-up: the same distance says less if five other
/// objects are almost as near. `others`: the distance of each other compared object, in any order;
/// `objects`: how many the catalogue has, the nearest one included. A catalogue of fewer than ten is
/// completed by objects at the usual distance, so that few runners-up neither help nor harm.
[[nodiscard]] float relativeDistance(float distance, std::vector<float> others, int objects);

inline constexpr int kObjectsToCompare = 10;  ///< see relativeDistance

}  // namespace scantrove
