#pragma once
#include <functional>
#include <span>

#include "tools/train/samples.h"

namespace scantrove::train {

// A folder of samples, one file a scene. Several processes may fill one folder.

/// The file of a scene ("room:501:hard" is in room-501-hard.txt).
[[nodiscard]] std::filesystem::path sampleFileOf(const std::filesystem::path& folder,
                                                 const std::string& scene);

/// What collectSamples() found or did.
enum class Collected {
  scanned,
  present,  ///< the samples were there
  busy,     ///< another process scans the scene
};

/// Scans a scene whose samples are not in `folder` yet, and writes them. `scan` gives samples; their origin
/// is set here. Error: that of `scan`; or a file is there that is damaged or comes from another number of
/// frames, which is named and left as it is.
[[nodiscard]] Result<Collected> collectSamples(
    const std::filesystem::path& folder, const SampleOrigin& origin,
    const std::function<Result<SceneSamples>(const std::string& scene)>& scan);

/// Samples of these scenes, or of all files if none are given, by the names of their files. Error: there are
/// none, one is missing or damaged, or two come from different numbers of frames.
[[nodiscard]] Result<std::vector<SceneSamples>> readSampleFolder(const std::filesystem::path& folder,
                                                                 std::span<const std::string> scenes = {});

}  // namespace scantrove::train
