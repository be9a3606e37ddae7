#pragma once
#include <optional>

#include "core/labeling/fragment_contacts.h"
#include "core/labeling/link_constraint.h"

namespace scantrove {

class BorderModel;

/// The accumulated observations of the border between two fragments.
struct BorderEvidence {
  using Constraint = LinkConstraint;

  float observations = 0;            ///< weighted, at most kMaxObservations
  float bridged = 0;                 ///< of the observations: one segment on both sides of the border
  float shared = 0;                  ///< of the observations: both visible parts lie in the same segments
  float bends = 0;                   ///< weighted observations of the bend, at most kMaxObservations
  float concavity_rad = 0;           ///< mean, > 0 a fold, < 0 a ridge
  float folded = 0, ridged = 0;      ///< mean parts of the border with a clear fold or ridge
  std::optional<float> color_shift;  ///< mean of FragmentContact::color_shift
  float step_m = 0;                  ///< mean of FragmentContact::step_m
  std::optional<ColorComparison> colors;  ///< mean, of the whole fragments
  float length_m = 0;                     ///< of the border, longest observation
  float appeared_together = 0;            ///< observations as one appeared object, at most kMaxObservations
  float appeared_apart = 0;  ///< observations with only one in an appeared object, at most kMaxObservations
  float attached = 0;        ///< observations with a positive Attachment, at most kMaxObservations
  float unattached = 0;      ///< observations with a negative Attachment, at most kMaxObservations
  float outlined =
      0;  ///< observations with one side on a support that is the other, at most kMaxObservations
  float unoutlined = 0;  ///< observations with both in one segment of a support or on one; likewise
  Constraint constraint = Constraint::none;
  bool by_person = false;    ///< a person set the constraint: it overrides those of the program
  int constraint_order = 0;  ///< higher: set later

  /// Older observations fade as newer ones come, so that this many correct ones overrule wrong ones.
  static constexpr float kMaxObservations = 20;

  /// Adds one observation. `shared` in 0 .. 1: how far both lie in the same segments (SegmentShares).
  void add(const FragmentContact& contact, float shared);

  /// Adds that both appeared as one object (`together`), or that one appeared beside the other.
  void addAppearance(bool together);

  /// Adds one Attachment observation.
  void addAttachment(bool is_attached);

  /// Adds one observation of the frame's supports: one side is a support and the other lies on it, or not.
  void addOutline(bool is_outlined);

  /// Log-odds that both belong to one object, from the border model (resources/models, border_features.h). A
  /// constant is subtracted, because small objects suffer more from a wrong join than from a missed one.
  [[nodiscard]] float logOdds(int voxels_a, int voxels_b) const;
  [[nodiscard]] float logOdds(int voxels_a, int voxels_b, const BorderModel& model) const;

  /// Edge weight between two regions: logOdds() + bias. Positive weights count less while observations are
  /// few, and all weights count less on borders of a few centimetres. With too few observations the weight is
  /// 0 for separate regions and slightly above 0 for `joined` ones. Evidence from appeared objects outweighs
  /// observations once it was seen more than once. If the model does not read the outlines on supports,
  /// outlineRule() is added.
  [[nodiscard]] float weight(int voxels_a, int voxels_b, float bias, bool joined = false) const;
  [[nodiscard]] float weight(int voxels_a, int voxels_b, float bias, bool joined,
                             const BorderModel& model) const;

 private:
  [[nodiscard]] float weightOfObservations(float odds, bool joined) const;
  [[nodiscard]] float weightOfAppearance() const;
};

}  // namespace scantrove
