#pragma once
#include "core/synthetic/scene.h"

namespace scantrove::synthetic {

/// The scene in three tints that walls, furniture and things share. As in many real rooms, colour then often
/// fails to separate touching things. A thing keeps its pattern, in shades of its tint.
[[nodiscard]] SyntheticScene makeLowContrast(SyntheticScene scene, std::uint32_t seed);

}  // namespace scantrove::synthetic
