#include "core/labeling/evidence_graph.h"

#include <algorithm>

#include "core/base/check.h"

namespace scantrove {
namespace {

auto placeOf(std::vector<EvidenceGraph::Link>& links, FragmentId other) {
  return std::ranges::lower_bound(links, other, {}, &EvidenceGraph::Link::other);
}

}  // namespace

BorderEvidence& EvidenceGraph::between(FragmentId a, FragmentId b) {
  SCANTROVE_CHECK(a && b && a != b);
  const std::size_t needed = std::max(a.value, b.value) + std::size_t{1};
  if (links_.size() < needed) links_.resize(needed);
  std::vector<Link>& from_a = links_[a.value];
  const auto found = placeOf(from_a, b);
  if (found != from_a.end() && found->other == b) return borders_[found->border];
  std::uint32_t border = static_cast<std::uint32_t>(borders_.size());
  if (free_.empty()) {
    borders_.emplace_back();
  } else {
    border = free_.back();
    free_.pop_back();
    borders_[border] = {};
  }
  from_a.insert(found, {b, border});
  std::vector<Link>& from_b = links_[b.value];
  from_b.insert(placeOf(from_b, a), {a, border});
  return borders_[border];
}

std::span<const EvidenceGraph::Link> EvidenceGraph::linksOf(FragmentId fragment) const {
  if (fragment.value >= links_.size()) return {};
  return links_[fragment.value];
}

void EvidenceGraph::remove(FragmentId fragment) {
  if (fragment.value >= links_.size()) return;
  for (const Link& link : links_[fragment.value]) {
    std::vector<Link>& back = links_[link.other.value];
    back.erase(placeOf(back, fragment));
    free_.push_back(link.border);
  }
  links_[fragment.value].clear();
}

void EvidenceGraph::constrain(FragmentId a, FragmentId b, BorderEvidence::Constraint constraint) {
  BorderEvidence& border = between(a, b);
  border.constraint = constraint;
  border.constraint_order = ++constraints_;
}

}  // namespace scantrove
