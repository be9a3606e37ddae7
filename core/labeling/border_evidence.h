#pragma once
#include <optional>

#include "core/labeling/fragment_contacts.h"
#include "core/labeling/link_constraint.h"

namespace scantrove {

/// What all looks together say of the border between two fragments.
struct BorderEvidence {
  using Constraint = LinkConstraint;

  float observations = 0;            ///< weighed, at most kMaxObservations
  float bridged = 0;                 ///< of the looks: one segment on both sides of the border
  float shared = 0;                  ///< of the looks: both fragments' visible parts lie in the same segments
  float bends = 0;                   ///< weighed looks at the bend, at most kMaxObservations
  float concavity_rad = 0;           ///< mean, > 0 a fold, < 0 a ridge
  float folded = 0, ridged = 0;      ///< parts of the border that clearly are, mean
  std::optional<float> color_shift;  ///< as in FragmentContact, mean
  float step_m = 0;                  ///< likewise
  std::optional<ColorComparison> colors;  ///< likewise, of the fragments on the whole
  float length_m = 0;                     ///< of the border, longest look
  float appeared_together = 0;            ///< looks at both as of a thing that came, at most kMaxObservations
  float appeared_apart = 0;               ///< looks at one as of a thing that came to the other, likewise
  float attached = 0;    ///< looks at the one as a part of the other (Attachment), at most kMaxObservations
  float unattached = 0;  ///< looks that deny it, likewise
  Constraint constraint = Constraint::none;
  bool by_person = false;    ///< the constraint: stronger than any that the program found
  int constraint_order = 0;  ///< higher: said later

  /// Older looks fade as newer come: what was seen wrongly is overruled by so many that see it right.
  static constexpr float kMaxObservations = 20;

  /// Adds one look. `shared` in 0 .. 1: how far both lie in the same segments (SegmentShares).
  void add(const FragmentContact& contact, float shared);

  /// Adds that both came into the scene as one, or that one came and the other was there.
  void addAppearance(bool together);

  /// Adds that the one was seen as a part of the other by the way it is held, or not.
  void addAttachment(bool is_attached);

  /// Logarithm of the odds that both belong to one object (resources/models; border_features.h says what it
  /// weighs), and a little lower: small objects suffer more from a wrong join than from a missed one.
  [[nodiscard]] float logOdds(int voxels_a, int voxels_b) const;

  /// What looks add to the balance between two regions: logOdds() + bias; what speaks for joining less as
  /// long as there are few looks, all less for a border of a few centimetres. While too little was seen to
  /// say, what is apart stays so (0) and what is `joined` holds together (a little above 0). What came by
  /// itself is one thing, and another one than what it came to: seen more than once, that outweighs looks.
  [[nodiscard]] float weight(int voxels_a, int voxels_b, float bias, bool joined = false) const;

 private:
  [[nodiscard]] float weightOfObservations(int voxels_a, int voxels_b, float bias, bool joined) const;
  [[nodiscard]] float weightOfAppearance() const;
};

}  // namespace scantrove
