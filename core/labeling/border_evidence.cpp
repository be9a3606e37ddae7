#include "core/labeling/border_evidence.h"

#include <algorithm>
#include <cmath>
#include <numeric>

namespace scantrove {
namespace {

constexpr float kFullLength_px = 16;  // borders this long count fully
constexpr float kLeastBends = 0.3F;   // weighed looks at a bend from which it counts

/// A logistic model: intercept, then a coefficient for each feature.
struct Model {
  float intercept;
  std::array<float, BorderEvidence::kFeatures> coefficients;
};
/// With colour: a logistic fit to borders of demo:room:1-4 and 5:uneven, demo:tabletop:1-4 and 5:uneven, made
/// before outlines healed within a region. A later fit by border_evidence_fit ({9.20, -0.33, -0.24, 2.29,
/// -0.09, 2.78, 0.66, -0.16, -0.38, -1.82}) joined the chair with the floor in the room of the tests; it is
/// not used. Without colour: by border_evidence_fit to rooms 1-6 and 1:uneven, tables 1-3 and 1:uneven. The
/// intercepts are lower than fitted, by 1 and 1.5, since small things suffer more from a wrong join than from
/// a missed one; the 1.5 is not measured.
constexpr Model kWithColor{7.70F, {-0.05F, -0.63F, 2.05F, -0.18F, 3.72F, 0.57F, -0.05F, -0.42F, -1.86F}};
constexpr Model kWithoutColor{4.22F, {-0.75F, -1.15F, 0.99F, 0.56F, 2.58F, 0.81F, -0.08F, -0.33F, 0}};
constexpr float kEnoughLooks = 2;        // before these nothing speaks for joining
constexpr float kEnoughLength_m = 0.1F;  // shorter borders count in proportion
constexpr float kFarFrom_m = 2.5F;       // noise grows with z^2: beyond this a look counts for less than half

float weightOf(const FragmentContact& contact) {
  const float far = contact.depth_m / kFarFrom_m;
  return std::min(1.0F, static_cast<float>(contact.length_px) / kFullLength_px) / (1 + far * far);
}

}  // namespace

void BorderEvidence::add(const FragmentContact& contact, float shared_part) {
  const float weight = weightOf(contact);
  const float bridged_part = static_cast<float>(contact.bridged_px) / static_cast<float>(contact.length_px);
  looks += weight;
  bridged += weight * bridged_part;
  shared += weight * shared_part;
  if (looks > kMostLooks) {
    const float fade = kMostLooks / looks;
    looks *= fade;
    bridged *= fade;
    shared *= fade;
  }
  length_m = std::max(length_m, contact.length_m);
  if (contact.color_shift) {
    const float before = color_shift.value_or(*contact.color_shift);
    color_shift = before + weight / looks * (*contact.color_shift - before);
  }
  if (contact.bends == 0) return;
  const float bend_weight =
      weight * static_cast<float>(contact.bends) / static_cast<float>(contact.length_px);
  bends = std::min(bends + bend_weight, kMostLooks);
  const float step = bends > 0 ? bend_weight / bends : 0;
  concavity_rad += step * (contact.concavity_rad - concavity_rad);
  turn_rad += step * (contact.turn_rad - turn_rad);
  folded += step * (contact.folded - folded);
  ridged += step * (contact.ridged - ridged);
}

std::array<float, BorderEvidence::kFeatures> BorderEvidence::features(int voxels_a, int voxels_b) const {
  const float bent = bends > kLeastBends ? 1.0F : 0.0F;
  const auto [fewer, more] = std::minmax(voxels_a, voxels_b);
  return {bent * std::max(0.0F, 1 - folded - ridged),
          bent * folded,
          bent * ridged,
          std::log((bridged + 0.5F) / (looks - bridged + 0.5F)),
          looks > 0 ? shared / looks : 0.0F,
          std::log(length_m + 0.01F),
          std::log(static_cast<float>(fewer) + 10),
          std::log(static_cast<float>(more) + 10),
          std::log(color_shift.value_or(0) + 1)};
}

float BorderEvidence::logOdds(int voxels_a, int voxels_b) const {
  const Model& model = color_shift ? kWithColor : kWithoutColor;
  const std::array<float, kFeatures> x = features(voxels_a, voxels_b);
  return std::inner_product(x.begin(), x.end(), model.coefficients.begin(), model.intercept);
}

float BorderEvidence::weight(int voxels_a, int voxels_b, float bias) const {
  const float odds = logOdds(voxels_a, voxels_b) + bias;
  if (odds > 0 && looks < kEnoughLooks) return 0;
  return odds * std::min(1.0F, length_m / kEnoughLength_m);
}

}  // namespace scantrove
