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
  changed_.insert(std::minmax(a, b));
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
    changed_.insert(std::minmax(fragment, link.other));
    free_.push_back(link.border);
  }
  links_[fragment.value].clear();
}

void EvidenceGraph::constrain(FragmentId a, FragmentId b, LinkConstraint constraint, bool by_person) {
  BorderEvidence& border = between(a, b);
  if (border.by_person && !by_person) return;
  border.constraint = constraint;
  border.by_person = by_person && constraint != LinkConstraint::none;
  border.constraint_order = ++constraints_;
}

const BorderEvidence* EvidenceGraph::find(FragmentId a, FragmentId b) const {
  const auto links = linksOf(a);
  const auto found = std::ranges::lower_bound(links, b, {}, &Link::other);
  return found == links.end() || found->other != b ? nullptr : &borders_[found->border];
}

LinkConstraint EvidenceGraph::constraintBetween(FragmentId a, FragmentId b) const {
  const BorderEvidence* border = find(a, b);
  return border == nullptr ? LinkConstraint::none : border->constraint;
}

std::vector<EvidenceGraph::Pair> EvidenceGraph::takeChanged() {
  std::vector<Pair> changed(changed_.begin(), changed_.end());
  changed_.clear();
  return changed;
}

void EvidenceGraph::restore(FragmentId a, FragmentId b, const BorderEvidence& evidence) {
  between(a, b) = evidence;
  changed_.erase(std::minmax(a, b));
  constraints_ = std::max(constraints_, evidence.constraint_order);
}

}  // namespace scantrove
