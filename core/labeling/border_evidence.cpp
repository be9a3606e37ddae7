#include "core/labeling/border_evidence.h"

#include <algorithm>
#include <cmath>

#include "core/labeling/border_features.h"
#include "embedded/border_model.h"

namespace scantrove {
namespace {

constexpr float kFullLength_px = 16;  // borders this long count fully
/// Taken off the logarithm of the odds. On scenes that the model was not trained on, 0.884 of the small
/// objects and 0.865 of the large ones are over half so; with 1 it is 0.883 and 0.871, with 1.5 it is 0.887
/// and 0.856.
constexpr float kCaution = 1.25F;
constexpr float kEnoughLooks = 2;  // weighed; before these what is apart stays so, and what is one
constexpr float kHolds = 0.01F;    // any other border outweighs it
/// A wrong join costs more than a missed one: what speaks for joining counts by half after so many looks.
constexpr float kHalfSureLooks = 8;
constexpr float kEnoughLength_m = 0.1F;  // shorter borders count in proportion
/// What it means that two came together or one to the other, once it was seen so often.
constexpr float kArrival = 20;
constexpr float kSureArrival = 5;
constexpr float kFirstArrival = 1;  // so many looks mean nothing yet: one frame may be wrong
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
  const float part = weight / looks;
  if (contact.color_shift) {
    const float before = color_shift.value_or(*contact.color_shift);
    color_shift = before + part * (*contact.color_shift - before);
  }
  step_m += part * (contact.step_m - step_m);
  if (contact.colors) {
    if (colors) {
      colors->moveTowards(*contact.colors, part);
    } else {
      colors = contact.colors;
    }
  }
  if (contact.bends == 0) return;
  const float bend_weight =
      weight * static_cast<float>(contact.bends) / static_cast<float>(contact.length_px);
  bends = std::min(bends + bend_weight, kMostLooks);
  const float step = bends > 0 ? bend_weight / bends : 0;
  concavity_rad += step * (contact.concavity_rad - concavity_rad);
  folded += step * (contact.folded - folded);
  ridged += step * (contact.ridged - ridged);
}

float BorderEvidence::logOdds(int voxels_a, int voxels_b) const {
  static const BoostedTrees model = BoostedTrees::embedded(models::border, namesOf(kBorderFeatures));
  std::array values = valuesOf(kBorderFeatures, {*this, voxels_a, voxels_b});
  return model.logOdds(values) - kCaution;
}

void BorderEvidence::addArrival(bool together) { count(together, came_together, came_apart); }

void BorderEvidence::addAttachment(bool is_attached) { count(is_attached, attached, unattached); }

float BorderEvidence::weight(int voxels_a, int voxels_b, float bias, bool joined) const {
  return weightOfLooks(voxels_a, voxels_b, bias, joined) + weightOfArrivals() +
         kAttachment * std::max(0.0F, attached - kDenied * unattached - kFirstAttached) /
             std::max(kSureAttachment, attached + unattached);
}

float BorderEvidence::weightOfArrivals() const {
  const float more = came_together - came_apart;
  const float means = std::copysign(std::max(0.0F, std::abs(more) - kFirstArrival), more);
  return kArrival * means / std::max(kSureArrival, came_together + came_apart - kFirstArrival);
}

float BorderEvidence::weightOfLooks(int voxels_a, int voxels_b, float bias, bool joined) const {
  const float odds = logOdds(voxels_a, voxels_b) + bias;
  if (joined && looks < kEnoughLooks) return kHolds;
  if (!joined && odds > 0 && looks < kEnoughLooks) return 0;
  const float sure = odds > 0 ? looks / (looks + kHalfSureLooks) : 1;
  return odds * sure * std::min(1.0F, length_m / kEnoughLength_m);
}

}  // namespace scantrove
