#pragma once
#include <array>
#include <cstdint>
#include <map>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "core/base/result.h"

namespace scantrove {

enum class DatasetSplit : std::uint8_t { train, val, test };

inline constexpr std::array kAllSplits{DatasetSplit::train, DatasetSplit::val, DatasetSplit::test};

/// "train", "val", "test".
[[nodiscard]] std::string splitName(DatasetSplit split);

/// Shares of the scans, together 1; by DatasetSplit.
using SplitShares = std::array<double, kAllSplits.size()>;

/// Reads "train=0.8,val=0.1,test=0.1" (in any order, what is missing is 0) or "0.8,0.1,0.1". Error: neither,
/// a share outside of 0 to 1, or a sum other than 1.
[[nodiscard]] Result<SplitShares> parseSplitShares(std::string_view text);

/// The split of a project. Frames of one scan are never divided: neighbours in time are similar.
struct ScanSplit {
  std::optional<SplitShares> shares = {};            ///< drawn
  std::uint64_t seed = 0;                            ///< of the draw
  std::map<std::string, DatasetSplit> by_scan = {};  ///< given; empty: drawn, or no split

  [[nodiscard]] bool isAny() const { return shares || !by_scan.empty(); }
};

/// Draws a split for each of the scans. It depends on their names and the seed, not on their order. A
/// share above 0 has at least one scan if there are enough, `train` before `val` before `test`.
[[nodiscard]] std::map<std::string, DatasetSplit> drawSplit(const std::vector<std::string>& scans,
                                                            const SplitShares& shares, std::uint64_t seed);

}  // namespace scantrove
