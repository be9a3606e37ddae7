#pragma once
#include <cstdint>
#include <span>
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
  /// Borders of a fragment, by the other's number.
  [[nodiscard]] std::span<const Link> linksOf(FragmentId fragment) const;
  [[nodiscard]] const BorderEvidence& border(std::uint32_t index) const { return borders_[index]; }

  /// All that is known of a fragment goes.
  void remove(FragmentId fragment);

  [[nodiscard]] std::size_t borderCount() const { return borders_.size() - free_.size(); }

  /// Says what two fragments are to each other, whatever is seen. Later ones are stronger than earlier ones.
  void constrain(FragmentId a, FragmentId b, BorderEvidence::Constraint constraint);

 private:
  std::vector<std::vector<Link>> links_;  // by fragment; each by the other's number
  std::vector<BorderEvidence> borders_;
  std::vector<std::uint32_t> free_;  // of borders_
  int constraints_ = 0;
};

}  // namespace scantrove
