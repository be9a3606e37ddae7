#pragma once
#include <string>

#include "core/compute/compute_context.h"
#include "tools/train/samples.h"

namespace scantrove::train {

/// Scans a synthetic scene ("room:7:uneven", as after "demo:") and compares with its truth what the program
/// sees: borders at every 10th frame; region sets at every 6th frame and at key frames, as the refinement
/// sees them. The origin of the samples is left empty.
[[nodiscard]] Result<SceneSamples> sampleScene(const std::string& scene, int frames, ComputeContext& compute);

}  // namespace scantrove::train
