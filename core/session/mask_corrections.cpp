#include "core/session/mask_corrections.h"

#include <algorithm>
#include <opencv2/core.hpp>
#include <span>
#include <string>

namespace scantrove {
namespace {

using LogEntry = OperationLog::Entry;

bool isDonePaint(const LogEntry& entry) {
  return entry.state == OperationLog::State::done && entry.operation.kind == OperationKind::paint &&
         entry.operation.correction.has_value() && !entry.operation.regions.empty();
}

/// The region for which an operation painted, as it was then.
RegionId paintedRegionThen(const LogEntry& entry) {
  const bool is_new = entry.operation.correction->makes_region && !entry.effect.created.empty();
  return is_new ? entry.effect.created.front() : entry.operation.regions.front();
}

/// The region for which an operation painted, as it is now; none: it no longer exists.
RegionId paintedRegionNow(const LogEntry& entry, const RegionTable& table) {
  const RegionId region = paintedRegionThen(entry);
  if (!table.fragmentsOf(region).empty()) return region;
  const FragmentId anchor = entry.effect.anchor;
  return anchor && anchor.value < table.regions().size() ? table.regionOf(anchor) : RegionId{};
}

bool isJoin(const Operation& operation) {
  return operation.kind == OperationKind::join || operation.kind == OperationKind::coarser;
}

bool isSplit(const Operation& operation) {
  return operation.kind == OperationKind::cut || operation.kind == OperationKind::finer;
}

/// The region that `anchor` was in before `operations`, after which it is in `now`.
RegionId regionBefore(FragmentId anchor, RegionId now, std::span<const LogEntry> operations) {
  for (auto one = operations.rbegin(); one != operations.rend(); ++one) {
    if (one->state != OperationLog::State::done) continue;
    for (const RegionMove& move : one->effect.moves) {
      if (move.fragment != anchor || move.after != now) continue;
      now = move.before;
      break;
    }
  }
  return now;
}

/// Whether a later operation takes away what an entry painted for a region. The regions of both have to be
/// one before the operations that follow: a later join does not take away what the joined region had.
bool isTakenAway(const LogEntry& entry, std::span<const LogEntry> later, RegionId now,
                 const RegionTable& table) {
  for (std::size_t i = 0; i < later.size(); ++i) {
    const LogEntry& one = later[i];
    const bool is_unpaint = one.state == OperationLog::State::done &&
                            one.operation.kind == OperationKind::unpaint && one.operation.correction &&
                            !one.operation.regions.empty() &&
                            one.operation.correction->key_frame == entry.operation.correction->key_frame;
    if (!is_unpaint || paintedRegionNow(one, table) != now) continue;
    const std::span<const LogEntry> after = later.subspan(i + 1);
    if (regionBefore(entry.effect.anchor, now, after) == regionBefore(one.effect.anchor, now, after))
      return true;
  }
  return false;
}

/// The painted mask of an entry, with what later operations did to its regions.
PaintedMask maskOf(const LogEntry& entry, std::span<const LogEntry> later, RegionId now) {
  const MaskCorrection& correction = *entry.operation.correction;
  std::set<RegionId> regions{paintedRegionThen(entry), now}, parts;
  bool is_joined = false;
  for (const LogEntry& one : later) {
    if (one.state != OperationLog::State::done) continue;
    for (const RegionMove& move : one.effect.moves) {
      if (isJoin(one.operation) && regions.contains(move.after)) is_joined = true;
      if (isSplit(one.operation) && regions.contains(move.before) && !regions.contains(move.after))
        parts.insert(move.after);
    }
    regions.insert(parts.begin(), parts.end());
  }
  PaintedMask mask{.region = now.value, .added = correction.added.mask(), .removed = {}};
  mask.removed = is_joined ? cv::Mat(cv::Mat::zeros(mask.added.size(), CV_8UC1)) : correction.removed.mask();
  for (const RegionId part : parts) mask.parts.push_back(part.value);
  return mask;
}

}  // namespace

std::vector<PaintedMask> paintedMasksOf(const OperationLog& log, const RegionTable& table, int key_frame) {
  std::vector<PaintedMask> masks;
  const std::span entries(log.entries());
  for (std::size_t i = 0; i < entries.size(); ++i) {
    if (!isDonePaint(entries[i]) || entries[i].operation.correction->key_frame != key_frame) continue;
    const RegionId now = paintedRegionNow(entries[i], table);
    const std::span later = entries.subspan(i + 1);
    if (now && !isTakenAway(entries[i], later, now, table)) masks.push_back(maskOf(entries[i], later, now));
  }
  return masks;
}

Result<void> checkUnpaint(const OperationLog& log, const RegionTable& table, const Operation& unpaint) {
  if (!unpaint.correction || unpaint.regions.size() != 1)
    return fail("An image and one region are missing.", "Say in which image, and for which region.");
  const RegionId region = unpaint.regions.front();
  const std::vector<PaintedMask> masks = paintedMasksOf(log, table, unpaint.correction->key_frame);
  if (std::ranges::find(masks, region.value, &PaintedMask::region) != masks.end()) return {};
  return fail("Nothing is painted for region " + std::to_string(region.value) + " in image " +
                  std::to_string(unpaint.correction->image) + ".",
              "'scantrove session history' lists what is painted.");
}

std::set<int> paintedKeyFrames(const OperationLog& log) {
  std::set<int> frames;
  for (const LogEntry& entry : log.entries()) {
    if (isDonePaint(entry)) frames.insert(entry.operation.correction->key_frame);
  }
  return frames;
}

}  // namespace scantrove
