#include "core/collection/view_choice.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <functional>

#include "core/geometry/view_sphere.h"

namespace scantrove {
namespace {

/// Limits for a view.
constexpr float kMostHidden = 0.4F, kLeastOutline = 0.6F;
constexpr float kLeastSharpness = 0.3F;  ///< of the object's sharpest view
/// Value of an unknown sharpness relative to the sharpest view, and of an outline that was clear.
constexpr float kUnknownSharpness = 0.5F, kClearOutline = 0.9F;

/// A maximal set of views at half an angle is no smaller than any set at the whole angle: each of its members
/// is near to at most one of theirs.
constexpr std::array<float, 3> kAngles_deg{kViewAngle_deg, kViewAngle_deg / 2, kViewAngle_deg / 4};

class ViewScores {
 public:
  explicit ViewScores(std::span<const OfferedView> views) {
    for (const OfferedView& view : views) {
      largest_ = std::max(largest_, view.quality.pixels);
      sharpest_ = std::max(sharpest_, view.quality.sharpness);
    }
  }
  /// 0 .. 1.
  [[nodiscard]] float of(const ViewQuality& quality) const {
    const float size = largest_ > 0 ? std::sqrt(quality.pixels / largest_) : 1;
    return size * sharpness(quality) * outlineOf(quality) * (1 - quality.hidden);
  }
  [[nodiscard]] bool isGood(const ViewQuality& quality) const {
    return quality.hidden <= kMostHidden && outlineOf(quality) >= kLeastOutline &&
           sharpness(quality) >= kLeastSharpness;
  }

 private:
  [[nodiscard]] float sharpness(const ViewQuality& quality) const {
    if (sharpest_ == 0) return 1;
    return quality.sharpness > 0 ? quality.sharpness / sharpest_ : kUnknownSharpness;
  }
  static float outlineOf(const ViewQuality& quality) {
    return quality.outline > 0 ? quality.outline : kClearOutline;
  }

  float largest_ = 0, sharpest_ = 0;
};

}  // namespace

std::vector<std::size_t> chooseViews(std::span<const OfferedView> views, std::size_t kept, std::size_t most) {
  const ViewScores scores(views);
  const auto scoreOf = [&](std::size_t i) { return scores.of(views[i].quality); };
  std::vector<std::size_t> chosen, ranked;
  ViewSphere directions;
  const auto choose = [&](std::size_t i) {
    chosen.push_back(i);
    directions.keep(views[i].direction);
  };
  for (std::size_t i = 0; i < kept; ++i) choose(i);
  for (std::size_t i = kept; i < views.size(); ++i) ranked.push_back(i);
  std::ranges::stable_sort(ranked, std::greater<>(), scoreOf);
  const auto isGood = [&](std::size_t i) { return scores.isGood(views[i].quality); };
  if (kept == 0 && !ranked.empty() && std::ranges::none_of(ranked, isGood)) {
    ranked.resize(1);
  } else {
    std::erase_if(ranked, std::not_fn(isGood));
  }
  for (const float angle_deg : kAngles_deg) {
    const std::size_t limit = angle_deg == kViewAngle_deg ? most : std::min(most, kEnoughViews);
    for (const std::size_t i : ranked) {
      if (chosen.size() < limit && directions.isNew(views[i].direction, angle_deg)) choose(i);
    }
  }
  return chosen;
}

}  // namespace scantrove
