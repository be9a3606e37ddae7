#include "core/labeling/border_evidence.h"

#include <algorithm>
#include <cmath>

#include "core/labeling/border_model.h"

namespace scantrove {
namespace {

constexpr float kFullLength_px = 16;  // borders this long count fully
/// Subtracted from the log-odds. On scenes outside the training set, 0.884 of the small objects and 0.865 of
/// the large ones are then over half correct; with 1 it is 0.883 and 0.871, with 1.5 it is 0.887 and 0.856.
constexpr float kCaution = 1.25F;
constexpr float kMinObservations = 2;  // weighted; with fewer the partition stays as it is
constexpr float kHolds = 0.01F;        // any other border outweighs it
/// Observations after which evidence for joining counts half. A wrong join costs more than a missed one.
constexpr float kHalfSureObservations = 8;
constexpr float kEnoughLength_m = 0.1F;  // shorter borders count in proportion
/// Weight of appearing together or apart, reached after kSureAppearance observations.
constexpr float kAppearanceWeight = 20;
constexpr float kSureAppearance = 5;
constexpr float kFirstAppearance = 1;  // this many observations do not count: one frame may be wrong
/// Weight of an attachment, reached after kSureAttachment observations.
constexpr float kAttachment = 20;
constexpr float kSureAttachment = 12;  // observations until it is certain
constexpr float kDenied = 2;           // observations that one denial cancels
/// This many observations do not count, because nothing can deny the attachment once the two are one region.
constexpr float kFirstAttached = 3;
constexpr float kFarFrom_m = 2.5F;  // noise grows with z^2: beyond this an observation counts less than half

float weightOf(const FragmentContact& contact) {
  const float far = contact.depth_m / kFarFrom_m;
  return std::min(1.0F, static_cast<float>(contact.length_px) / kFullLength_px) / (1 + far * far);
}

/// Adds one observation for yes or no. Their sum is limited to kMaxObservations.
void count(bool says_yes, float& yes, float& no) {
  (says_yes ? yes : no) += 1;
  const float fade = std::min(1.0F, BorderEvidence::kMaxObservations / (yes + no));
  yes *= fade;
  no *= fade;
}

}  // namespace

void BorderEvidence::add(const FragmentContact& contact, float shared_part) {
  const float weight = weightOf(contact);
  const float bridged_part = static_cast<float>(contact.bridged_px) / static_cast<float>(contact.length_px);
  observations += weight;
  bridged += weight * bridged_part;
  shared += weight * shared_part;
  if (observations > kMaxObservations) {
    const float fade = kMaxObservations / observations;
    observations *= fade;
    bridged *= fade;
    shared *= fade;
  }
  length_m = std::max(length_m, contact.length_m);
  const float part = weight / observations;
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
  bends = std::min(bends + bend_weight, kMaxObservations);
  const float step = bends > 0 ? bend_weight / bends : 0;
  concavity_rad += step * (contact.concavity_rad - concavity_rad);
  folded += step * (contact.folded - folded);
  ridged += step * (contact.ridged - ridged);
}

float BorderEvidence::logOdds(int voxels_a, int voxels_b) const {
  return logOdds(voxels_a, voxels_b, BorderModel::embedded());
}

float BorderEvidence::logOdds(int voxels_a, int voxels_b, const BorderModel& model) const {
  return model.logOdds({*this, voxels_a, voxels_b}) - kCaution;
}

void BorderEvidence::addAppearance(bool together) { count(together, appeared_together, appeared_apart); }

void BorderEvidence::addOutline(bool is_outlined) { count(is_outlined, outlined, unoutlined); }

void BorderEvidence::addAttachment(bool is_attached) { count(is_attached, attached, unattached); }

float BorderEvidence::weight(int voxels_a, int voxels_b, float bias, bool joined) const {
  return weight(voxels_a, voxels_b, bias, joined, BorderModel::embedded());
}

float BorderEvidence::weight(int voxels_a, int voxels_b, float bias, bool joined,
                             const BorderModel& model) const {
  const float of_outline = model.readsOutlines() ? 0 : outlineRule(outlined, unoutlined);
  return weightOfObservations(logOdds(voxels_a, voxels_b, model) + bias, joined) + weightOfAppearance() +
         of_outline +
         kAttachment * std::max(0.0F, attached - kDenied * unattached - kFirstAttached) /
             std::max(kSureAttachment, attached + unattached);
}

float BorderEvidence::weightOfAppearance() const {
  const float more = appeared_together - appeared_apart;
  const float means = std::copysign(std::max(0.0F, std::abs(more) - kFirstAppearance), more);
  return kAppearanceWeight * means /
         std::max(kSureAppearance, appeared_together + appeared_apart - kFirstAppearance);
}

float BorderEvidence::weightOfObservations(float odds, bool joined) const {
  if (joined && observations < kMinObservations) return kHolds;
  if (!joined && odds > 0 && observations < kMinObservations) return 0;
  const float sure = odds > 0 ? observations / (observations + kHalfSureObservations) : 1;
  return odds * sure * std::min(1.0F, length_m / kEnoughLength_m);
}

}  // namespace scantrove
