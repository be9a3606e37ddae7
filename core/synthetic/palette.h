#pragma once
#include "core/synthetic/hash_stream.h"
#include "core/synthetic/material.h"

namespace scantrove::synthetic {

// Random colours and materials of random scenes.
[[nodiscard]] Rgb randomColor(HashStream& random);  ///< for things: any hue, from pale to strong
[[nodiscard]] Rgb randomPaint(HashStream& random);  ///< for walls and furniture: pale
[[nodiscard]] Material randomWood(HashStream& random);
[[nodiscard]] Material randomPaintwork(HashStream& random);  ///< wood or paint, of furniture
[[nodiscard]] Material randomFabric(HashStream& random);
[[nodiscard]] Material randomGlaze(HashStream& random);  ///< ceramics and plastics, patterned around
[[nodiscard]] Material randomPrint(HashStream& random, Pattern pattern);  ///< bookCover, boxLabel, canLabel

}  // namespace scantrove::synthetic
