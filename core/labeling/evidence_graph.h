#pragma once
#include <cstdint>
#include <set>
#include <span>
#include <utility>
#include <vector>

#include "core/base/ids.h"
#include "core/labeling/border_evidence.h"

namespace scantrove {

/// Fragments and what is known of the borders between them. One thread.
class EvidenceGraph {
 public:
  struct Link {
    FragmentId other;
    std::uint32_t border;  ///< for border()
  };

  /// The border between two fragments; made when it is first asked for. Valid until the next call that
  /// changes the graph.
  [[nodiscard]] BorderEvidence& between(FragmentId a, FragmentId b);
  /// What is known of that border; null: nothing.
  [[nodiscard]] const BorderEvidence* find(FragmentId a, FragmentId b) const;
  /// Borders of a fragment, by the other's number.
  [[nodiscard]] std::span<const Link> linksOf(FragmentId fragment) const;
  [[nodiscard]] const BorderEvidence& border(std::uint32_t index) const { return borders_[index]; }

  /// All that is known of a fragment goes.
  void remove(FragmentId fragment);

  using Pair = std::pair<FragmentId, FragmentId>;
  /// Borders, smaller number first and in rising order, that changed, came or went since the last call: for
  /// one who keeps a copy.
  [[nodiscard]] std::vector<Pair> takeChanged();
  /// As it was when it was kept.
  void restore(FragmentId a, FragmentId b, const BorderEvidence& evidence);

  [[nodiscard]] std::size_t borderCount() const { return borders_.size() - free_.size(); }

  /// Says what two fragments are to each other, whatever is seen. Later ones are stronger than earlier ones,
  /// a person's stronger than the program's, which never replaces one. `none` takes back what was said.
  void constrain(FragmentId a, FragmentId b, LinkConstraint constraint, bool by_person = true);
  [[nodiscard]] LinkConstraint constraintBetween(FragmentId a, FragmentId b) const;

 private:
  std::vector<std::vector<Link>> links_;  // by fragment; each by the other's number
  std::vector<BorderEvidence> borders_;
  std::vector<std::uint32_t> free_;  // of borders_
  int constraints_ = 0;
  std::set<Pair> changed_;
};

}  // namespace scantrove
