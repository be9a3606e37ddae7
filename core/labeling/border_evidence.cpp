#include "core/labeling/border_evidence.h"

#include <algorithm>
#include <cmath>
#include <numeric>

namespace scantrove {
namespace {

constexpr float kFullLength_px = 16;  // borders this long count fully
constexpr float kLargeFrom = 9.5F;    // logarithm of the voxels of half a square metre
constexpr float kLeastBends = 0.3F;   // weighed looks at a bend from which it counts

/// A logistic model: intercept, then a coefficient for each feature.
struct Model {
  float intercept;
  std::array<float, BorderEvidence::kFeatures> coefficients;
};
/// By border_evidence_fit to demo:room:111, 121, 113:drab, 123:drab, 1:uneven and 2, and demo:tabletop:111,
/// 121, 113:drab, 123:drab and 1:uneven. The intercept is lower than fitted, by 1: small things suffer more
/// from a wrong join than from a missed one. In rooms and tables 111, 112, 121, 122 and 113, 114, 123, 124
/// drab 0.820 of the small things and 0.826 of the large ones are over half so; a half lower 0.832 and 0.798,
/// a half higher 0.802 and 0.851. Before specks were left out of the contacts it was 0.795 and 0.873.
constexpr Model kWithColor{
    5.28F, {-0.47F, -1.24F, 2.16F, 0.10F, 3.20F, 0.69F, -0.23F, 0.11F, -1.18F, -0.95F, -1.33F}};
/// Likewise to demo:room:1-6 and 1:uneven, demo:tabletop:1-4 and 1:uneven, specks and all; lower by 1.5.
constexpr Model kWithoutColor{0.41F,
                              {-0.73F, -1.81F, 1.14F, 0.46F, 3.82F, 0.88F, -0.10F, 0.18F, -1.42F, 0, 0}};
constexpr float kEnoughLooks = 2;  // weighed; before these what is apart stays so, and what is one
constexpr float kHolds = 0.01F;    // any other border outweighs it
/// A wrong join costs more than a missed one: what speaks for joining counts by half after so many looks.
constexpr float kHalfSureLooks = 8;
constexpr float kEnoughLength_m = 0.1F;  // shorter borders count in proportion
/// What it means that two came together or one to the other, once it was seen so often.
constexpr float kArrival = 20;
constexpr float kSureArrival = 5;
/// What it means that one is held by the other alone, likewise; one look that denies it undoes two.
constexpr float kAttachment = 20;
constexpr float kSureAttachment = 12;
constexpr float kDenied = 2;
/// So many looks mean nothing yet: once the two are one region, nothing can deny it any more.
constexpr float kFirstAttached = 3;
constexpr float kFarFrom_m = 2.5F;  // noise grows with z^2: beyond this a look counts for less than half

float weightOf(const FragmentContact& contact) {
  const float far = contact.depth_m / kFarFrom_m;
  return std::min(1.0F, static_cast<float>(contact.length_px) / kFullLength_px) / (1 + far * far);
}

/// How far a fragment of so many voxels may be a whole thing that a hand could hold: 0 .. 1. Wrongly joined,
/// such a one is lost; a smaller one is a speck, a larger one remains most of what it is.
float sizeOfThings(int voxels) {
  const auto part = [](float from, float to, float size) {
    return std::clamp(std::log(size / from) / std::log(to / from), 0.0F, 1.0F);
  };
  const float size = static_cast<float>(voxels) + 10;
  return part(110, 310, size) * part(9010, 4010, size);
}

/// One look more that says yes or no; of both together no more than kMostLooks are remembered.
void count(bool says_yes, float& yes, float& no) {
  (says_yes ? yes : no) += 1;
  const float fade = std::min(1.0F, BorderEvidence::kMostLooks / (yes + no));
  yes *= fade;
  no *= fade;
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
          std::max(0.0F, std::log(static_cast<float>(more) + 10) - kLargeFrom),
          sizeOfThings(fewer),
          std::log(color_shift.value_or(0) + 1)};
}

float BorderEvidence::logOdds(int voxels_a, int voxels_b) const {
  const Model& model = color_shift ? kWithColor : kWithoutColor;
  const std::array<float, kFeatures> x = features(voxels_a, voxels_b);
  return std::inner_product(x.begin(), x.end(), model.coefficients.begin(), model.intercept);
}

void BorderEvidence::addArrival(bool together) { count(together, came_together, came_apart); }

void BorderEvidence::addAttachment(bool is_attached) { count(is_attached, attached, unattached); }

float BorderEvidence::weight(int voxels_a, int voxels_b, float bias, bool joined) const {
  const float arrivals = came_together + came_apart;
  return weightOfLooks(voxels_a, voxels_b, bias, joined) +
         kArrival * (came_together - came_apart) / std::max(kSureArrival, arrivals) +
         kAttachment * std::max(0.0F, attached - kDenied * unattached - kFirstAttached) /
             std::max(kSureAttachment, attached + unattached);
}

float BorderEvidence::weightOfLooks(int voxels_a, int voxels_b, float bias, bool joined) const {
  const float odds = logOdds(voxels_a, voxels_b) + bias;
  if (joined && looks < kEnoughLooks) return kHolds;
  if (!joined && odds > 0 && looks < kEnoughLooks) return 0;
  const float sure = odds > 0 ? looks / (looks + kHalfSureLooks) : 1;
  return odds * sure * std::min(1.0F, length_m / kEnoughLength_m);
}

}  // namespace scantrove
