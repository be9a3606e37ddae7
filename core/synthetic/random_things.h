#pragma once
#include "core/synthetic/thing.h"

namespace scantrove::synthetic {

// Random things; the stream determines kinds, sizes, shapes and colours.
[[nodiscard]] Thing makeSmallThing(HashStream& random);  ///< 5 - 40 cm, for tables and shelves
[[nodiscard]] Thing makeStackable(HashStream& random);   ///< a carton, a book, a block: flat above
[[nodiscard]] Thing makeFloorThing(HashStream& random);  ///< 20 cm - 1 m: chair, basket, parcel, suitcase
[[nodiscard]] Thing makeRandomToy(HashStream& random);   ///< a bear, a car, a ring, an arch, a ball

}  // namespace scantrove::synthetic
