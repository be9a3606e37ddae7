#include "core/dataset/scan_split.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <utility>

#include "core/base/text.h"

namespace scantrove {
namespace {

constexpr double kMaxDeviation = 1e-3;  // of a sum of shares from 1

tl::unexpected<Error> badShares(std::string_view text) {
  return fail("'" + std::string(text) + "' is no split.",
              "Write shares that add up to 1, for example train=0.8,val=0.1,test=0.1.");
}

std::optional<double> shareFrom(std::string_view text) {
  const auto numbers = parseNumbers(std::string(text));
  if (!numbers || numbers->size() != 1) return std::nullopt;
  const double share = numbers->front();
  return share >= 0 && share <= 1 ? std::optional(share) : std::nullopt;
}

/// A random number of a scan, the same on any machine: FNV-1a, then the finalizer of splitmix64.
std::uint64_t drawnNumber(std::string_view scan, std::uint64_t seed) {
  std::uint64_t hash = 0xcbf29ce484222325U ^ seed * 0x9e3779b97f4a7c15U;
  for (const char letter : scan) hash = (hash ^ static_cast<unsigned char>(letter)) * 0x100000001b3U;
  hash = (hash ^ hash >> 30U) * 0xbf58476d1ce4e5b9U;
  hash = (hash ^ hash >> 27U) * 0x94d049bb133111ebU;
  return hash ^ hash >> 31U;
}

/// Whole numbers of scans: the largest remainders are rounded up, then no share above 0 stays without a scan
/// that another one has to spare.
std::array<std::size_t, kAllSplits.size()> sizesOf(std::size_t scans, const SplitShares& shares) {
  std::array<std::size_t, kAllSplits.size()> sizes{};
  SplitShares rests{};
  std::size_t left = scans;
  for (std::size_t i = 0; i < sizes.size(); ++i) {
    const double exact = shares[i] * static_cast<double>(scans);
    sizes[i] = std::min(left, static_cast<std::size_t>(exact + 1e-9));
    rests[i] = exact - static_cast<double>(sizes[i]);
    left -= sizes[i];
  }
  for (; left > 0; --left) {
    const auto most = static_cast<std::size_t>(std::ranges::max_element(rests) - rests.begin());
    ++sizes[most];
    rests[most] -= 1;
  }
  for (std::size_t i = 0; i < sizes.size(); ++i) {
    if (sizes[i] > 0 || shares[i] <= 0) continue;
    const auto largest = std::ranges::max_element(sizes);
    const auto place = static_cast<std::size_t>(largest - sizes.begin());
    // With too few scans for all, the earlier split has one.
    if (*largest < 2 && place < i) continue;
    --*largest;
    ++sizes[i];
  }
  return sizes;
}

}  // namespace

std::string splitName(DatasetSplit split) {
  switch (split) {
    case DatasetSplit::train:
      return "train";
    case DatasetSplit::val:
      return "val";
    case DatasetSplit::test:
      return "test";
  }
  return {};
}

Result<SplitShares> parseSplitShares(std::string_view text) {
  SplitShares shares{};
  std::array<bool, kAllSplits.size()> is_given{};
  std::size_t count = 0;
  for (std::string_view rest = text; !rest.empty() || count == 0; ++count) {
    const std::size_t comma = std::min(rest.find(','), rest.size());
    const std::string_view item = rest.substr(0, comma);
    rest = rest.substr(std::min(comma + 1, rest.size()));
    const std::size_t equals = item.find('=');
    std::size_t place = count;
    if (equals != std::string_view::npos) {
      const auto found = std::ranges::find(kAllSplits, item.substr(0, equals), splitName);
      place = static_cast<std::size_t>(found - kAllSplits.begin());
    }
    const auto share = shareFrom(equals == std::string_view::npos ? item : item.substr(equals + 1));
    if (place >= shares.size() || is_given[place] || !share) return badShares(text);
    shares[place] = *share;
    is_given[place] = true;
  }
  if (std::abs(shares[0] + shares[1] + shares[2] - 1) > kMaxDeviation) return badShares(text);
  return shares;
}

std::map<std::string, DatasetSplit> drawSplit(const std::vector<std::string>& scans,
                                              const SplitShares& shares, std::uint64_t seed) {
  std::vector<std::pair<std::uint64_t, std::string>> drawn;
  for (const std::string& scan : scans) drawn.emplace_back(drawnNumber(scan, seed), scan);
  std::ranges::sort(drawn);
  const auto sizes = sizesOf(drawn.size(), shares);
  std::map<std::string, DatasetSplit> splits;
  std::size_t next = 0;
  for (const DatasetSplit split : kAllSplits) {
    for (std::size_t i = 0; i < sizes.at(static_cast<std::size_t>(split)); ++i)
      splits[drawn[next++].second] = split;
  }
  return splits;
}

}  // namespace scantrove
