#pragma once
#include <algorithm>
#include <array>
#include <cmath>

#include "core/base/boosted_trees.h"
#include "core/discovery/objectness/objectness_evidence.h"

namespace scantrove {

namespace objectness {

/// Upper limit of a contact's log-odds as a feature.
inline constexpr float kCertain = 4;

inline float longestSide_m(const ObjectnessEvidence& e) {
  constexpr float kShortest_m = 0.01F;  // a divisor: no object is shorter
  return std::max(e.known_size_m[0], kShortest_m);
}

}  // namespace objectness

/// Features that an objectness model may read, by name. A model keeps its meaning when others are added; what
/// is renamed or measured differently needs a newly trained one (tools/train).
inline constexpr auto kObjectnessFeatures = std::to_array<Feature<ObjectnessEvidence>>({
    {"log_pixels", [](const ObjectnessEvidence& e) { return std::log(std::max(e.pixels, 1.0F)); }},
    {"open", [](const ObjectnessEvidence& e) { return e.open; }},
    {"folded", [](const ObjectnessEvidence& e) { return e.folded; }},
    {"hidden", [](const ObjectnessEvidence& e) { return e.hidden; }},
    {"bulge", [](const ObjectnessEvidence& e) { return e.bulge; }},
    {"known_bulge", [](const ObjectnessEvidence& e) { return e.known_bulge; }},
    {"log_longest_side", [](const ObjectnessEvidence& e) { return std::log(objectness::longestSide_m(e)); }},
    {"middle_by_longest_side",
     [](const ObjectnessEvidence& e) { return e.known_size_m[1] / objectness::longestSide_m(e); }},
    {"shortest_by_longest_side",
     [](const ObjectnessEvidence& e) { return e.known_size_m[2] / objectness::longestSide_m(e); }},
    {"known_flatness", [](const ObjectnessEvidence& e) { return e.known_flatness; }},
    {"fill", [](const ObjectnessEvidence& e) { return e.fill; }},
    {"outline_inconsistent", [](const ObjectnessEvidence& e) { return e.is_inconsistent ? 1.0F : 0.0F; }},
    {"largest_region_part", [](const ObjectnessEvidence& e) { return e.largest_part; }},
    {"joining_log_odds",
     [](const ObjectnessEvidence& e) {
       return e.largest_part < 1 ? std::min(e.odds, objectness::kCertain) : objectness::kCertain;
     }},
    {"neighbor_likeness",
     [](const ObjectnessEvidence& e) { return e.likeness ? e.likeness->neighbor : kUnknownFeature; }},
    {"touching_likeness",
     [](const ObjectnessEvidence& e) { return e.likeness ? e.likeness->touching : kUnknownFeature; }},
    {"cut_off", [](const ObjectnessEvidence& e) { return e.cut; }},
    {"shown", [](const ObjectnessEvidence& e) { return e.shown; }},
    {"ridged", [](const ObjectnessEvidence& e) { return e.ridged; }},
    {"outward_log_odds",
     [](const ObjectnessEvidence& e) { return std::min(e.outward_odds, objectness::kCertain); }},
    {"joined_part", [](const ObjectnessEvidence& e) { return e.joined_part; }},
    {"convexity", [](const ObjectnessEvidence& e) { return e.convexity; }},
    {"end_to_end_likeness",
     [](const ObjectnessEvidence& e) { return e.likeness ? e.likeness->end_to_end : kUnknownFeature; }},
    {"side_to_side_likeness",
     [](const ObjectnessEvidence& e) { return e.likeness ? e.likeness->side_to_side : kUnknownFeature; }},
    {"relief_m", [](const ObjectnessEvidence& e) { return e.relief_m; }},
    {"visible_area_m2", [](const ObjectnessEvidence& e) { return e.area_m2; }},
    {"bounds_mean", [](const ObjectnessEvidence& e) { return e.bounds.mean; }},
    {"bounds_weakest_side", [](const ObjectnessEvidence& e) { return e.bounds.least_side; }},
    {"contrast_along",
     [](const ObjectnessEvidence& e) { return e.changes ? e.changes->along.contrast : kUnknownFeature; }},
    {"contrast_across",
     [](const ObjectnessEvidence& e) { return e.changes ? e.changes->across.contrast : kUnknownFeature; }},
    {"likeness_along",
     [](const ObjectnessEvidence& e) { return e.changes ? e.changes->along.likeness : kUnknownFeature; }},
    {"likeness_across",
     [](const ObjectnessEvidence& e) { return e.changes ? e.changes->across.likeness : kUnknownFeature; }},
    {"support", [](const ObjectnessEvidence& e) { return e.support; }},
    {"carried", [](const ObjectnessEvidence& e) { return e.carried; }},
});

/// Those of the evidence of supports. supportRule() (objectness_model.h) stands in for them.
inline constexpr auto kSupportFeatures = std::to_array<std::string_view>({"support", "carried"});

}  // namespace scantrove
