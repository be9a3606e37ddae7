#include "core/labeling/border_evidence.h"

#include <algorithm>
#include <cmath>
#include <numeric>

namespace scantrove {
namespace {

constexpr float kCertain = 1e6F;
constexpr float kFullLength_px = 16;  // borders this long count fully
constexpr float kFarFrom_m = 2.5F;    // noise grows with z^2: beyond this a look counts for less than half

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
  if (contact.bends == 0) return;
  const float bend_weight =
      weight * static_cast<float>(contact.bends) / static_cast<float>(contact.length_px);
  bends = std::min(bends + bend_weight, kMostLooks);
  const float step = bends > 0 ? bend_weight / bends : 0;
  concavity_rad += step * (contact.concavity_rad - concavity_rad);
  turn_rad += step * (contact.turn_rad - turn_rad);
}

std::array<float, BorderEvidence::kFeatures> BorderEvidence::features() const {
  const auto oddsOf = [&](float part) { return std::log((part + 0.5F) / (looks - part + 0.5F)); };
  const float fold = std::max(0.0F, concavity_rad - 0.2F);
  const float ridge = std::max(0.0F, -concavity_rad - 0.2F);
  return {oddsOf(bridged), oddsOf(shared),           fold, ridge, std::log(length_m + 0.01F),
          turn_rad < 0.15F && bends > 0 ? 1.0F : 0.0F, std::log(looks + 0.1F)};
}

float BorderEvidence::logOdds() const {
  if (constraint != Constraint::none) {
    const float strength = kCertain * (1 + static_cast<float>(constraint_order));
    return constraint == Constraint::must_link ? strength : -strength;
  }
  constexpr std::array<float, kFeatures> kCoefficients{0.7F, 0.7F, -4.0F, 0.0F, 0.0F, 1.0F, 0.0F};
  constexpr float kIntercept = 0;
  const std::array<float, kFeatures> x = features();
  return std::inner_product(x.begin(), x.end(), kCoefficients.begin(), kIntercept);
}

}  // namespace scantrove
