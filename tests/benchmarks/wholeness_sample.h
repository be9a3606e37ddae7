#pragma once
#include <filesystem>
#include <string>
#include <vector>

#include "core/base/result.h"
#include "core/discovery/region_set.h"
#include "core/discovery/wholeness.h"

namespace scantrove::benchmarks {

using Features = std::array<float, WholenessEvidence::kFeatures>;

/// What RegionJudge says of a region, a part of one, or a set of these, in one frame of a scan of a scene,
/// and what is true there.
struct WholenessSample {
  std::size_t scene = 0;
  RegionSet regions;  ///< of FinerRegions
  int frame = 0;
  int thing = 0;      ///< that it has most in common with, 0: none
  float overlap = 0;  ///< intersection of both in the image by their union
  Features x{};

  [[nodiscard]] bool isWhole() const { return overlap > 0.6F; }  // as `scantrove evaluate catalogue` counts
};

/// A line of text each.
[[nodiscard]] Result<void> writeSamples(const std::filesystem::path& file,
                                        const std::vector<WholenessSample>& samples);
[[nodiscard]] Result<std::vector<WholenessSample>> readSamples(const std::filesystem::path& file);

/// A sample to fit to. What matters is whether something would do as an object of the catalogue: it is one
/// whole thing in most of its looks. And not how often it was looked at: looks at one thing are alike.
struct WeighedSample {
  const WholenessSample* sample = nullptr;
  bool is_whole = false;
  float weight = 1;  ///< 1 on the average
};
[[nodiscard]] std::vector<WeighedSample> weigh(const std::vector<WholenessSample>& samples);

}  // namespace scantrove::benchmarks
