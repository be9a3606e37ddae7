#include "core/discovery/color_changes.h"

#include <array>
#include <optional>

#include "core/base/check.h"
#include "core/discovery/color_contrast.h"
#include "core/discovery/color_histogram.h"

namespace scantrove {
namespace {

/// Colours and their changes by position along an axis through the regions.
class Way {
 public:
  /// `place`: -1 .. 1, from end to end.
  void add(float place, const Eigen::Vector3f& lab, float contrast) {
    Strip& strip = strips_[static_cast<std::size_t>(std::clamp(
        static_cast<int>((place + 1) / 2 * static_cast<float>(kStrips)), 0, static_cast<int>(kStrips) - 1))];
    strip.colors.add(lab);
    strip.contrast += contrast;
    ++strip.pixels;
    ++pixels_;
  }
  [[nodiscard]] ColorChange sharpest() const {
    constexpr int kEnds = 8;     // a line within an eighth of the pixels from an end cuts off only a rim
    constexpr int kMinPart = 3;  // of the usual pixels of a strip; means of fewer are noise
    ColorChange change;
    std::optional<std::size_t> at;
    int before = 0;
    for (std::size_t i = 0; i < kStrips; ++i) {
      const Strip& strip = strips_[i];
      const bool is_inner = before > pixels_ / kEnds && before + strip.pixels < pixels_ - pixels_ / kEnds;
      before += strip.pixels;
      if (!is_inner || strip.pixels * kMinPart * static_cast<int>(kStrips) < pixels_) continue;
      const float contrast = strip.contrast / static_cast<float>(strip.pixels);
      if (at && contrast <= change.contrast) continue;
      change.contrast = contrast;
      at = i;
    }
    if (!at) return change;
    ColorHistogram to_here, from_here;
    for (std::size_t i = 0; i < kStrips; ++i) {
      if (i < *at) to_here.add(strips_[i].colors);
      if (i > *at) from_here.add(strips_[i].colors);
    }
    change.likeness = to_here.intersection(from_here);
    return change;
  }

 private:
  static constexpr std::size_t kStrips = 24;  // fine enough to locate a change, coarse enough to fill
  struct Strip {
    ColorHistogram colors;
    float contrast = 0;  // sum
    int pixels = 0;
  };
  std::array<Strip, kStrips> strips_{};
  int pixels_ = 0;
};

}  // namespace

ColorChanges colorChangesOf(const SetPixels& pixels, const SetAxes& axes, const DiscoveryInput& input) {
  SCANTROVE_CHECK(!input.color_lab.empty());
  const Eigen::Vector2i reach_px =
      (axes.longer() * static_cast<float>(colorReach(input.view.K.width))).array().round().cast<int>();
  // Near the outline there are no inner pixels to compare.
  const auto contrastAt = [&](int u, int v, int du, int dv) {
    if (!pixels.contains(u + du, v + dv) || !pixels.contains(u - du, v - dv)) return 0.0F;
    return colorContrast(input.color_lab[pixels.at(u - du, v - dv)],
                         input.color_lab[pixels.at(u + du, v + dv)]);
  };
  Way along, across;
  pixels.forEach([&](int u, int v) {
    if ((u + v) % 2 != 0) return;  // every other pixel suffices
    const Eigen::Vector2f place = axes(u, v);
    const Eigen::Vector3f& lab = input.color_lab[pixels.at(u, v)];
    along.add(place.x(), lab, contrastAt(u, v, reach_px.x(), reach_px.y()));
    across.add(place.y(), lab, contrastAt(u, v, -reach_px.y(), reach_px.x()));
  });
  return {along.sharpest(), across.sharpest()};
}

}  // namespace scantrove
