#pragma once
#include <map>
#include <nlohmann/json_fwd.hpp>
#include <optional>
#include <string>
#include <vector>

#include "core/scan/scan_report.h"
#include "core/scan/scan_snapshot.h"

namespace scantrove {

/// The cost of one frame and the size of the map at it.
struct BenchSample {
  int frames_done = 0;
  int bricks = 0;
  double frame_ms = 0;  ///< sum over the stages
  double map_ms = 0;    ///< sum of integration and raycast
  std::map<std::string, double> stages_ms;
};

/// One quarter of a run.
struct BenchQuarter {
  int last_frame = 0;
  int bricks = 0;  ///< at its end
  double frame_median_ms = 0;
  double map_median_ms = 0;
  std::map<std::string, double> stage_medians_ms;
};

/// Map time per frame early in a run and at its end: medians of up to 41 frames each.
struct MapGrowth {
  static constexpr int kEarlyFrame = 50;
  static constexpr int kHalfWindow = 20;
  double early_ms = 0;  ///< around frame 50
  double late_ms = 0;   ///< of the last frames

  [[nodiscard]] double ratio() const { return early_ms > 0 ? late_ms / early_ms : 0; }
};

[[nodiscard]] BenchSample sampleOf(const ScanSnapshot& snapshot);

/// Up to four quarters with equal numbers of frames; quarters without a sample are omitted.
[[nodiscard]] std::vector<BenchQuarter> quartersOf(const std::vector<BenchSample>& samples);

/// None when the run is so short that the two windows overlap.
[[nodiscard]] std::optional<MapGrowth> mapGrowthOf(const std::vector<BenchSample>& samples);

[[nodiscard]] std::string benchTable(const ScanReport& report, const std::vector<BenchSample>& samples);
[[nodiscard]] nlohmann::ordered_json benchJson(const ScanReport& report,
                                               const std::vector<BenchSample>& samples);

}  // namespace scantrove
