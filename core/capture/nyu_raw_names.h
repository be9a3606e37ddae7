#pragma once
#include <cstddef>
#include <filesystem>
#include <map>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "core/base/result.h"

namespace scantrove {

/// What a file of a raw NYUv2 folder holds.
enum class NyuFileKind { depth, color, acceleration };

/// The parts of `d-1294886360.208451-2996770081.pgm`: kind, time in seconds, counter of the device.
struct NyuFileName {
  NyuFileKind kind = NyuFileKind::depth;
  double time_s = 0;
};

/// Empty if `name` is not d-TIME-TICKS.pgm, r-TIME-TICKS.ppm or a-TIME-TICKS.dump.
[[nodiscard]] std::optional<NyuFileName> nyuFileName(std::string_view name);

/// A depth image and the colour image nearest in time.
struct NyuRawPair {
  double time_s = 0;  ///< of the depth image
  std::string depth;  ///< file name
  std::string color;  ///< empty: no colour image within 0.1 s
};

/// All depth images among the names of a folder, in order of time. As in the data set's toolbox, a colour
/// image may serve several depth images. Other names are ignored.
[[nodiscard]] std::vector<NyuRawPair> nyuRawPairs(const std::vector<std::string>& names);

/// The folders of raw scenes (bedroom_0001, ...) by name: `root` itself and the folders one or two levels
/// below it, as the data set's archives contain them. Of equal names, the first in alphabetical order of the
/// parents counts. Error: `root` cannot be read.
[[nodiscard]] Result<std::map<std::string, std::filesystem::path>> nyuSceneFolders(
    const std::filesystem::path& root);

}  // namespace scantrove
