#include "core/refinement/refinement_memory.h"

#include <algorithm>
#include <string>
#include <utility>

#include "core/base/byte_stream.h"
#include "core/session/packed_text.h"
#include "core/session/refinement_state.h"

namespace scantrove {
namespace {

constexpr std::uint32_t kRefinementVersion = 1;
constexpr const char* kMemoryKey = "refinement memory";

/// Number of operations, and how many of them are done.
std::pair<int, int> countsOf(std::span<const OperationLog::Entry> operations) {
  const auto done = std::ranges::count(operations, OperationLog::State::done, &OperationLog::Entry::state);
  return {static_cast<int>(operations.size()), static_cast<int>(done)};
}

}  // namespace

SessionMetadata refinementMetadata(bool is_done) {
  return {{kRefinementKey, is_done ? kRefinementDone : kRefinementPending}, {kMemoryKey, ""}};
}

SessionMetadata refinementMetadata(const RefinementMemory& memory,
                                   std::span<const OperationLog::Entry> operations) {
  ByteWriter to;
  to.put(kRefinementVersion);
  to.put(memory.position);
  const auto [all, done] = countsOf(operations);
  to.put(all);
  to.put(done);
  to.putList(std::span<const std::uint32_t>(memory.collector));
  to.putList(std::span<const RegionId>(memory.known));
  return {{kRefinementKey, kRefinementPending}, {kMemoryKey, packedText(to.take())}};
}

std::optional<RefinementMemory> refinementMemoryFrom(const SessionMetadata& metadata,
                                                     std::span<const OperationLog::Entry> operations) {
  const auto text = metadata.find(kMemoryKey);
  const auto words = wordsFromText(text == metadata.end() ? std::string() : text->second);
  if (!words) return std::nullopt;
  ByteReader from(*words);
  if (from.get<std::uint32_t>() != kRefinementVersion) return std::nullopt;
  RefinementMemory memory;
  memory.position = from.get<RefinementPosition>();
  const std::pair counts{from.get<int>(), from.get<int>()};
  memory.collector = from.getList<std::uint32_t>();
  memory.known = from.getList<RegionId>();
  const auto pass = static_cast<int>(memory.position.pass);
  const bool is_pass = pass >= 0 && pass < static_cast<int>(RefinementPosition::Pass::done);
  if (!from.isAtEnd() || !is_pass || memory.position.frames < 0) return std::nullopt;
  if (counts != countsOf(operations) && memory.position.pass > RefinementPosition::Pass::rate)
    memory.position = {RefinementPosition::Pass::rate, 0};
  return memory;
}

}  // namespace scantrove
