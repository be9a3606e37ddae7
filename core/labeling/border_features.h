#pragma once
#include <algorithm>
#include <array>
#include <optional>

#include "core/base/boosted_trees.h"
#include "core/labeling/border_evidence.h"

namespace scantrove {

/// A border and the sizes of the fragments on both sides.
struct SizedBorder {
  const BorderEvidence& evidence;
  int voxels_a = 0, voxels_b = 0;  ///< in either order
};

namespace border {

inline float observations(const SizedBorder& b) {
  constexpr float kMin = 1e-3F;
  return std::max(b.evidence.observations, kMin);
}
inline float ofColors(const SizedBorder& b, float ColorComparison::*value) {
  return b.evidence.colors ? (*b.evidence.colors).*value : kUnknownFeature;
}
/// Part of the observations of the supports that outlined one of the two; 0 without any.
inline float outlinedPart(float outlined, float unoutlined) {
  return outlined > 0 ? outlined / (outlined + unoutlined) : 0;
}

}  // namespace border

/// Features that a border model may read, by name. A model keeps its meaning when others are added; what is
/// renamed or measured differently needs a newly trained one (tools/train).
inline constexpr auto kBorderFeatures = std::to_array<Feature<SizedBorder>>({
    {"observations", [](const SizedBorder& b) { return b.evidence.observations; }},
    {"same_segment_part", [](const SizedBorder& b) { return b.evidence.shared / border::observations(b); }},
    {"bridged_part", [](const SizedBorder& b) { return b.evidence.bridged / border::observations(b); }},
    {"concavity_rad", [](const SizedBorder& b) { return b.evidence.concavity_rad; }},
    {"folded", [](const SizedBorder& b) { return b.evidence.folded; }},
    {"ridged", [](const SizedBorder& b) { return b.evidence.ridged; }},
    {"color_shift", [](const SizedBorder& b) { return b.evidence.color_shift.value_or(kUnknownFeature); }},
    {"fewer_voxels",
     [](const SizedBorder& b) { return static_cast<float>(std::min(b.voxels_a, b.voxels_b)); }},
    {"more_voxels",
     [](const SizedBorder& b) { return static_cast<float>(std::max(b.voxels_a, b.voxels_b)); }},
    {"chroma_difference",
     [](const SizedBorder& b) { return border::ofColors(b, &ColorComparison::chroma_difference); }},
    {"color_difference",
     [](const SizedBorder& b) { return border::ofColors(b, &ColorComparison::difference); }},
    {"depth_step_m", [](const SizedBorder& b) { return b.evidence.step_m; }},
    {"shared_colors", [](const SizedBorder& b) { return border::ofColors(b, &ColorComparison::shared); }},
    {"shared_chroma",
     [](const SizedBorder& b) { return border::ofColors(b, &ColorComparison::shared_chroma); }},
    {"elsewhere", [](const SizedBorder& b) { return border::ofColors(b, &ColorComparison::elsewhere); }},
    {"variety", [](const SizedBorder& b) { return border::ofColors(b, &ColorComparison::variety); }},
    {"outlined", [](const SizedBorder& b) { return b.evidence.outlined; }},
    {"unoutlined", [](const SizedBorder& b) { return b.evidence.unoutlined; }},
    {"outlined_part",
     [](const SizedBorder& b) { return border::outlinedPart(b.evidence.outlined, b.evidence.unoutlined); }},
});

/// Those of the evidence of supports. outlineRule() (border_model.h) stands in for them.
inline constexpr auto kOutlineFeatures =
    std::to_array<std::string_view>({"outlined", "unoutlined", "outlined_part"});

}  // namespace scantrove
