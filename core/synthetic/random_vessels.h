#pragma once
#include "core/synthetic/thing.h"

namespace scantrove::synthetic {

// Things with an axis, of random size, shape and material, by kind.
[[nodiscard]] Thing makeRandomMug(HashStream& random);
[[nodiscard]] Thing makeRandomVase(HashStream& random);
[[nodiscard]] Thing makeRandomBowl(HashStream& random);
[[nodiscard]] Thing makeRandomPlate(HashStream& random);
[[nodiscard]] Thing makeRandomCan(HashStream& random);  ///< flat above
[[nodiscard]] Thing makeRandomJar(HashStream& random);  ///< flat above
[[nodiscard]] Thing makeRandomBottle(HashStream& random);
[[nodiscard]] Thing makeRandomRoll(HashStream& random);    ///< of paper or tape, hollow
[[nodiscard]] Thing makeRandomFigure(HashStream& random);  ///< turned, with waists
[[nodiscard]] Thing makeRandomBucket(HashStream& random);  ///< 20 - 40 cm, some with a plant

}  // namespace scantrove::synthetic
