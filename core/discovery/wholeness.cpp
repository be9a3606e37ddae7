#include "core/discovery/wholeness.h"

#include <algorithm>
#include <cmath>
#include <span>

#include "core/discovery/wholeness_trees.h"
#include "core/discovery/wholeness_trees_of_key_frames.h"

namespace scantrove {
namespace {

float oddsBy(float prior, std::span<const BoostedTree<5>> trees, std::span<const float> features) {
  for (const BoostedTree<5>& tree : trees) prior += tree.valueOf(features);
  return prior;
}

}  // namespace

std::array<float, WholenessEvidence::kFeatures> WholenessEvidence::features() const {
  constexpr float kLeastSize_m = 0.01F, kMostOdds = 4;
  const float longest_m = std::max(known_size_m[0], kLeastSize_m);
  return {std::log(std::max(pixels, 1.0F)),
          open,
          folded,
          hidden,
          bulge,
          known_bulge,
          std::log(longest_m),
          known_size_m[1] / longest_m,
          known_size_m[2] / longest_m,
          known_flatness,
          fill,
          is_torn ? 1.0F : 0.0F,
          largest_part,
          largest_part < 1 ? std::min(odds, kMostOdds) : kMostOdds,
          likeness ? likeness->neighbour : kUsualNeighbourLikeness,
          likeness ? likeness->touching : kUsualTouchingLikeness,
          cut,
          shown,
          ridged,
          std::min(outward_odds, kMostOdds),
          joined_part,
          convexity,
          likeness ? likeness->end_to_end : kUsualEndToEndLikeness,
          likeness ? likeness->side_to_side : kUsualSideToSideLikeness,
          relief_m,
          area_m2,
          bounds.mean,
          bounds.least_side,
          changes ? changes->along.contrast : kUsualContrastAlong,
          changes ? changes->across.contrast : kUsualContrastAcross,
          changes ? changes->along.likeness : kUsualLikenessAlong,
          changes ? changes->across.likeness : kUsualLikenessAcross};
}

float WholenessEvidence::logOdds() const {
  const std::array<float, kFeatures> x = features();
  return (oddsBy(kWholenessPrior, kWholenessTrees, x) +
          oddsBy(kWholenessOfKeyFramesPrior, kWholenessOfKeyFramesTrees, x)) /
         2;
}

}  // namespace scantrove
