#pragma once
#include "core/synthetic/thing.h"

namespace scantrove::synthetic {

// Furniture of random size, shape and material: static and no object.
[[nodiscard]] Thing makeRandomTable(HashStream& random, const Vec3& size);  ///< on legs or one foot
[[nodiscard]] Thing makeDesk(HashStream& random, double length);            ///< with drawers on one side
[[nodiscard]] Thing makeCupboard(HashStream& random, const Vec3& size);     ///< doors or drawers with handles
[[nodiscard]] Thing makeBookcase(HashStream& random, const Vec3& size);     ///< open shelves
[[nodiscard]] Thing makeSofa(HashStream& random, double length);
[[nodiscard]] Thing makeBed(HashStream& random, double length);
[[nodiscard]] Thing makePillar(HashStream& random);
[[nodiscard]] Thing makeDoor(HashStream& random);  ///< door and frame
[[nodiscard]] Thing makeCurtain(HashStream& random, double length);
[[nodiscard]] Thing makeRug(HashStream& random);

}  // namespace scantrove::synthetic
