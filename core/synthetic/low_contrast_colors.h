#pragma once
#include "core/synthetic/scene.h"

namespace scantrove::synthetic {

/// The same scene in three tints that walls, furniture and things share, so that what touches often looks
/// alike: where colour does not tell one thing from the next, as in many real rooms. A thing keeps its
/// pattern, in shades of its tint.
[[nodiscard]] SyntheticScene makeLowContrast(SyntheticScene scene, std::uint32_t seed);

}  // namespace scantrove::synthetic
