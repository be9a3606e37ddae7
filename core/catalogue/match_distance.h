#pragma once
#include <Eigen/Core>
#include <optional>
#include <vector>

namespace scantrove {

/// What differs between a query and a stored view.
struct ViewDifference {
  float shape = 2;               ///< warped SSD of the thumbnails: 0 = same, 2 = unrelated
  float mean_color = 0;          ///< squared difference of the mean Lab colours / 40^2
  std::optional<float> colors;   ///< squared Hellinger distance of the histograms; none: a view has none
  float size = 0;                ///< sizeDifference()
  std::optional<float> network;  ///< as AppearanceNetwork::distance(); none: a view has no such vector
};

/// Mean |ln| of the ratios of two oriented boxes (sides in metres, longest first): half their diagonals,
/// half their sides. 0: a size is unknown.
[[nodiscard]] float sizeDifference(const Eigen::Vector3f& a_m, const Eigen::Vector3f& b_m);

/// The thumbnails and their mean colours alone: 0 = the same view; unrelated objects of one size differ by
/// 0.8 and more, most by 1. The limits of moved and expected objects were measured on it.
[[nodiscard]] float thumbnailDistance(const ViewDifference& difference);

/// One number for all evidence: 0 = the same view; unrelated objects of one size differ by 0.6 and more,
/// most by 1. Objects of the same colours differ by only half the SSD of their thumbnails.
[[nodiscard]] float matchDistance(const ViewDifference& difference);

/// The weights in matchDistance(), for a search that computes it of many views at once:
/// shape * ViewDifference::shape + colors * ViewDifference::colors + size * ViewDifference::size, and
/// other_size for each unit of size beyond size_of_noise.
struct MatchWeights {
  float shape, colors, size, other_size, size_of_noise;
};
/// Without colours the shape counts more, and the mean colours are not among these.
[[nodiscard]] MatchWeights matchWeights(bool has_colors);

/// The distance of an object from those of its compared views: mostly of the nearest, a little of the next
/// two, because a view that is near by chance has no near neighbours. `views`: at least one.
[[nodiscard]] float objectDistance(std::vector<float> views);

/// `distance` of the nearest object, judged by the runners-up: the same distance says less if five other
/// objects are almost as near. `others`: the distance of each other compared object, in any order;
/// `objects`: how many the catalogue has, the nearest one included. A catalogue of fewer than ten is
/// completed by objects at the usual distance, so that few runners-up neither help nor harm. Others count as
/// at most unrelated (2): objects of quite another size do not make the nearest one surer.
[[nodiscard]] float relativeDistance(float distance, std::vector<float> others, int objects);

inline constexpr int kObjectsToCompare = 10;  ///< see relativeDistance

}  // namespace scantrove
