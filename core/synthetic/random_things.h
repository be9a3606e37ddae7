#pragma once
#include "core/synthetic/thing.h"

namespace scantrove::synthetic {

// Small things of random size, shape and material, by kind.
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
[[nodiscard]] Thing makeRandomCarton(HashStream& random, double low_m,
                                     double high_m);       ///< edges of that length
[[nodiscard]] Thing makeRandomBook(HashStream& random);    ///< lying
[[nodiscard]] Thing makeRandomBlocks(HashStream& random);  ///< L, T, U, stairs: boxes in one piece
[[nodiscard]] Thing makeRandomLaptop(HashStream& random);
[[nodiscard]] Thing makeRandomMonitor(HashStream& random);
[[nodiscard]] Thing makeRandomShoe(HashStream& random);
[[nodiscard]] Thing makeRandomToy(HashStream& random);      ///< a bear, a car, a ring, an arch, a ball
[[nodiscard]] Thing makeRandomCushion(HashStream& random);  ///< lying
[[nodiscard]] Thing makeRandomSuitcase(HashStream& random);

}  // namespace scantrove::synthetic
