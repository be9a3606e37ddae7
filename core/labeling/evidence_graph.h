#pragma once
#include <cstdint>
#include <set>
#include <span>
#include <utility>
#include <vector>

#include "core/base/ids.h"
#include "core/labeling/border_evidence.h"

namespace scantrove {

/// The graph of fragments, with the evidence of each border. One thread.
class EvidenceGraph {
 public:
  struct Link {
    FragmentId other;
    std::uint32_t border;  ///< for border()
  };

  /// The border between two fragments, created if missing. Valid until the next call that changes the graph.
  [[nodiscard]] BorderEvidence& between(FragmentId a, FragmentId b);
  /// Null if the border has no evidence.
  [[nodiscard]] const BorderEvidence* find(FragmentId a, FragmentId b) const;
  /// Borders of a fragment, ordered by the other fragment's number.
  [[nodiscard]] std::span<const Link> linksOf(FragmentId fragment) const;
  [[nodiscard]] const BorderEvidence& border(std::uint32_t index) const { return borders_[index]; }

  /// Removes the fragment with all its borders.
  void remove(FragmentId fragment);

  using Pair = std::pair<FragmentId, FragmentId>;
  /// Borders that were added, changed or removed since the last call. Smaller number first, in rising order.
  [[nodiscard]] std::vector<Pair> takeChanged();
  /// Sets a border to its stored state.
  void restore(FragmentId a, FragmentId b, const BorderEvidence& evidence);

  [[nodiscard]] std::size_t borderCount() const { return borders_.size() - free_.size(); }

  /// Sets a constraint, which overrides evidence. Later constraints override earlier ones. The program's
  /// never replace a person's. `none` removes the constraint.
  void constrain(FragmentId a, FragmentId b, LinkConstraint constraint, bool by_person = true);
  [[nodiscard]] LinkConstraint constraintBetween(FragmentId a, FragmentId b) const;

 private:
  std::vector<std::vector<Link>> links_;  // by fragment; each ordered by the other's number
  std::vector<BorderEvidence> borders_;
  std::vector<std::uint32_t> free_;  // of borders_
  int constraints_ = 0;
  std::set<Pair> changed_;
};

}  // namespace scantrove
