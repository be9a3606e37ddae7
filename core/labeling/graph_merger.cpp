#include "core/labeling/graph_merger.h"

#include <algorithm>
#include <map>
#include <optional>
#include <unordered_map>

#include "core/labeling/attachments.h"
#include "core/labeling/fragment_contacts.h"
#include "core/labeling/label_smoothing.h"
#include "core/labeling/region_partition.h"
#include "core/labeling/small_fragment_pieces.h"
#include "core/labeling/thesis_merger.h"

namespace scantrove {

std::unique_ptr<RegionMerger> makeRegionMerger(LabelingParams::Rule rule) {
  if (rule == LabelingParams::Rule::thesis) return std::make_unique<ThesisMerger>();
  return std::make_unique<GraphMerger>();
}

namespace {

using Overlaps = OverlapGraph<FragmentId>;

constexpr int kSmallPiecesInImage = 3000;  // smaller components are ignored: 25 pixels of 320 x 240

/// The shares of each fragment's visible part in the segments.
class SegmentShares {
 public:
  explicit SegmentShares(const Overlaps& overlaps) {
    for (std::size_t patch = 0; patch < overlaps.patches.size(); ++patch) {
      index_[overlaps.patches[patch]] = patch;
    }
    shares_.resize(overlaps.patches.size());
    for (const Overlaps::Edge& edge : overlaps.edges) {
      shares_[edge.patch].push_back(
          {edge.segment,
           static_cast<float>(edge.overlap_px) / static_cast<float>(overlaps.patch_areas_px[edge.patch])});
    }
  }

  /// The segment that holds most of a fragment's visible part; 0: none holds over half.
  [[nodiscard]] std::uint32_t mainSegment(FragmentId fragment) const {
    constexpr float kMain = 0.5F;
    for (const Share& share : shares_[index_.at(fragment)])
      if (share.part > kMain) return share.segment;
    return 0;
  }

  /// The part of both fragments that lies in the same segments: sum over segments of the smaller share.
  [[nodiscard]] float shared(FragmentId a, FragmentId b) const {
    const auto& of_a = shares_[index_.at(a)];
    const auto& of_b = shares_[index_.at(b)];
    float sum = 0;
    for (auto i = of_a.begin(), j = of_b.begin(); i != of_a.end() && j != of_b.end();) {
      if (i->segment == j->segment) {
        sum += std::min((i++)->part, (j++)->part);
      } else if (i->segment < j->segment) {
        ++i;
      } else {
        ++j;
      }
    }
    return sum;
  }

 private:
  struct Share {
    std::uint32_t segment;
    float part;
  };
  std::unordered_map<FragmentId, std::size_t> index_;
  std::vector<std::vector<Share>> shares_;  // of each fragment, by segment
};

/// True if one of the two is a support, or a cloth on one, and carries the other; false if both lie in one
/// segment that is, or lies on, a support; none if the frame's supports say nothing.
std::optional<bool> areOutlined(const SegmentMap& segments, const SegmentShares& shares,
                                const FragmentContact& contact) {
  using Kind = SegmentRole::Kind;
  const std::uint32_t segment_a = shares.mainSegment(contact.a), segment_b = shares.mainSegment(contact.b);
  const SegmentRole a = segments.roleOf(segment_a), b = segments.roleOf(segment_b);
  if (a.kind == Kind::free || b.kind == Kind::free) return std::nullopt;
  if (segment_a == segment_b) return false;
  if (a.support == b.support && a.kind != b.kind) return true;
  return std::nullopt;
}

/// The fragments in this frame's view that belong to appeared objects.
class AppearedFragments {
 public:
  explicit AppearedFragments(const MergeInput& input) {
    if (input.appeared.empty()) return;
    for (std::size_t pixel = 0; pixel < input.view.fragments.size(); ++pixel) {
      if (!input.view.fragments[pixel]) continue;
      Pixels& pixels = of_fragment_[input.view.fragments[pixel]];
      ++pixels.all;
      if (input.appeared[pixel] != 0) ++pixels.of_object[input.appeared[pixel]];
    }
  }

  /// True if both appeared as one object, false if one appeared beside the other, none if unclear.
  [[nodiscard]] std::optional<bool> areOne(FragmentId a, FragmentId b) const {
    const int thing_a = thingOf(a), thing_b = thingOf(b);
    if (thing_a > 0 && thing_a == thing_b) return true;
    if ((thing_a > 0 && thing_b == kWasThere) || (thing_b > 0 && thing_a == kWasThere)) return false;
    return std::nullopt;
  }

 private:
  static constexpr int kWasThere = 0, kUnclear = -1;
  /// Limits for the appeared part of a fragment's pixels: at least kAppeared, it has appeared; at most
  /// kStayed, it was there before.
  static constexpr double kAppeared = 0.6, kStayed = 0.2;
  struct Pixels {
    int all = 0;
    std::map<int, int> of_object;
  };

  [[nodiscard]] int thingOf(FragmentId fragment) const {
    const auto found = of_fragment_.find(fragment);
    if (found == of_fragment_.end()) return kUnclear;
    const auto& [all, of_object] = found->second;
    int appeared = 0;
    for (const auto& [object, count] : of_object) {
      if (count >= kAppeared * all) return object;
      appeared += count;
    }
    return appeared <= kStayed * all ? kWasThere : kUnclear;
  }

  std::unordered_map<FragmentId, Pixels> of_fragment_;
};

/// The fragment of each segment, and the fragments that it covers and leaves unchanged.
struct SegmentOwners {
  std::vector<FragmentId> owner;                 ///< by segment
  std::vector<std::vector<FragmentId>> covered;  ///< by segment

  [[nodiscard]] bool covers(std::uint32_t segment, FragmentId fragment) const {
    return std::ranges::find(covered[segment], fragment) != covered[segment].end();
  }
};

SegmentOwners findOwners(const Overlaps& overlaps, float threshold) {
  SegmentOwners owners;
  owners.owner.resize(overlaps.segment_areas_px.size());
  owners.covered.resize(overlaps.segment_areas_px.size());
  std::vector<int> largest_px(overlaps.segment_areas_px.size(), 0);
  for (const Overlaps::Edge& edge : overlaps.edges) {
    if (overlaps.covers(edge, threshold))
      owners.covered[edge.segment].push_back(overlaps.patches[edge.patch]);
    if (edge.overlap_px <= largest_px[edge.segment] || !overlaps.qualifies(edge, threshold)) continue;
    largest_px[edge.segment] = edge.overlap_px;
    owners.owner[edge.segment] = overlaps.patches[edge.patch];
  }
  return owners;
}

}  // namespace

void GraphMerger::addEvidence(const MergeInput& input, const Overlaps& overlaps) {
  const SegmentShares shares(overlaps);
  const AppearedFragments arrived(input);
  std::vector<FragmentId> parts = withoutSmallPieces(input.view.fragments, input.view.K.width,
                                                     input.view.K.pixels() / kSmallPiecesInImage);
  // Estimated surface has no shape that could tell about a border.
  for (std::size_t pixel = 0; pixel < input.view.is_estimated.size(); ++pixel)
    if (input.view.is_estimated[pixel] != 0) parts[pixel] = {};
  for (const FragmentContact& contact : findContacts(input, parts)) {
    BorderEvidence& border = graph_.between(contact.a, contact.b);
    border.add(contact, shares.shared(contact.a, contact.b));
    if (const auto are_one = arrived.areOne(contact.a, contact.b)) border.addAppearance(*are_one);
    if (const auto is_outlined = areOutlined(input.segments, shares, contact))
      border.addOutline(*is_outlined);
    touched_.push_back(contact.a);
    touched_.push_back(contact.b);
  }
}

RegionMerger::Outcome GraphMerger::merge(const MergeInput& input, RegionTable& table,
                                         const LabelingParams& params) {
  Outcome outcome;
  const SegmentMap& segments = input.segments;
  const Overlaps overlaps = buildOverlapGraph<FragmentId>(segments, input.view.fragments);
  addEvidence(input, overlaps);
  updatePartition(touched_, graph_, input.voxels, params, table, outcome.events);
  touched_.clear();

  SegmentOwners owners = findOwners(overlaps, params.overlap_threshold);
  const auto least_px = static_cast<int>(params.min_fragment_px * input.view.K.pixelScale());
  for (std::size_t segment = 1; segment < owners.owner.size(); ++segment) {
    if (!owners.owner[segment] && segments.areas[segment] >= least_px) {
      owners.owner[segment] = table.newFragment();
    }
  }
  splitFragment(input, overlaps, owners.owner, table, outcome);

  const std::vector<FragmentId>& projected_in = input.view.fragments;
  outcome.fragments.resize(projected_in.size());
  outcome.regions.resize(projected_in.size());
  for (std::size_t first = 0, pixel = 0; first < projected_in.size(); first = pixel) {
    const FragmentId projected = projected_in[first];
    const std::uint32_t segment = segments.ids[first];
    FragmentId fragment = projected;
    const FragmentId owner = owners.owner[segment];
    if (owner && !owners.covers(segment, fragment)) fragment = owner;
    if (split_from_[segment] && split_from_[segment] == fragment) fragment = split_off_[segment];
    for (; pixel < projected_in.size() && projected_in[pixel] == projected && segments.ids[pixel] == segment;
         ++pixel)
      outcome.fragments[pixel] = fragment;
  }
  removeIsolatedLabels(input.view, outcome.fragments);
  for (std::size_t first = 0, pixel = 0; first < outcome.fragments.size(); first = pixel) {
    const RegionId region = table.regionOf(outcome.fragments[first]);
    for (; pixel < outcome.fragments.size() && outcome.fragments[pixel] == outcome.fragments[first]; ++pixel)
      outcome.regions[pixel] = region;
  }
  attachParts(input, outcome, table);
  return outcome;
}

void GraphMerger::attachParts(const MergeInput& input, const Outcome& outcome, const RegionTable& table) {
  for (const Attachment& attachment : findAttachments(input, outcome, table)) {
    for (const auto& [a, b] : attachment.borders) {
      // Without positive evidence a denial has no effect.
      const BorderEvidence* known = graph_.find(a, b);
      if (known == nullptr || (!attachment.is_attached && known->attached == 0)) continue;
      graph_.between(a, b).addAttachment(attachment.is_attached);
      touched_.push_back(a);
      touched_.push_back(b);
    }
  }
}

void GraphMerger::splitFragment(const MergeInput& input, const Overlaps& overlaps,
                                std::span<const FragmentId> owner, RegionTable& table, Outcome& outcome) {
  split_from_.assign(owner.size(), {});
  split_off_.assign(owner.size(), {});
  for (const FragmentSplitter::Split& cut : cutter_.find(input, overlaps, owner)) {
    // The next partition decides whether it becomes a region of its own.
    const FragmentId split_off = table.newFragmentBeside(cut.fragment);
    split_from_[cut.segment] = cut.fragment;
    split_off_[cut.segment] = split_off;
    outcome.split_off.push_back(split_off);
    outcome.split_from.push_back(cut.fragment);
    for (int observation = 0; observation < FragmentSplitter::kObservations; ++observation) {
      graph_.between(cut.fragment, split_off).add(cut.contact, 0);
    }
    touched_.push_back(split_off);
    touched_.push_back(cut.fragment);
  }
}

void GraphMerger::forget(FragmentId fragment) {
  graph_.remove(fragment);
  cutter_.forget(fragment);
  std::erase(touched_, fragment);
}

std::optional<float> GraphMerger::joiningOdds(RegionId a, RegionId b, const RegionTable& table,
                                              std::span<const int> voxels,
                                              const LabelingParams& params) const {
  const auto voxelsOf = [&](FragmentId fragment) {
    return fragment.value < voxels.size() ? voxels[fragment.value] : 0;
  };
  std::optional<float> odds;
  for (const FragmentId fragment : table.fragmentsOf(a)) {
    for (const EvidenceGraph::Link& link : graph_.linksOf(fragment)) {
      if (table.regionOf(link.other) != b) continue;
      const BorderEvidence& border = graph_.border(link.border);
      if (border.constraint == LinkConstraint::cannot_link) return std::nullopt;
      odds = odds.value_or(0) + border.weight(voxelsOf(fragment), voxelsOf(link.other), params.joining_bias);
    }
  }
  return odds;
}

void GraphMerger::mustBeOne(RegionId a, RegionId b, const RegionTable& table) {
  const auto of_a = table.fragmentsOf(a), of_b = table.fragmentsOf(b);
  if (of_a.empty() || of_b.empty() || a == b) return;
  // At a known contact, if there is one.
  for (const FragmentId fragment : of_a) {
    for (const EvidenceGraph::Link& link : graph_.linksOf(fragment)) {
      if (table.regionOf(link.other) == b)
        return constrain(fragment, link.other, LinkConstraint::must_link, false);
    }
  }
  constrain(of_a.front(), of_b.front(), LinkConstraint::must_link, false);
}

void GraphMerger::constrain(FragmentId a, FragmentId b, LinkConstraint constraint) {
  constrain(a, b, constraint, true);
}

void GraphMerger::constrain(FragmentId a, FragmentId b, LinkConstraint constraint, bool by_person) {
  graph_.constrain(a, b, constraint, by_person);
  touched_.push_back(a);
  touched_.push_back(b);
}

std::vector<FragmentId> GraphMerger::neighborsOf(FragmentId fragment) const {
  std::vector<FragmentId> neighbors;
  for (const EvidenceGraph::Link& link : graph_.linksOf(fragment)) neighbors.push_back(link.other);
  return neighbors;
}

std::vector<std::vector<FragmentId>> GraphMerger::partsOf(RegionId region, float less,
                                                          const RegionTable& table,
                                                          std::span<const int> voxels,
                                                          const LabelingParams& params) const {
  LabelingParams stricter = params;
  stricter.joining_bias -= less;
  return partsOfRegion(region, graph_, voxels, stricter, table);
}

}  // namespace scantrove
