#pragma once
#include "core/synthetic/thing.h"

namespace scantrove::synthetic {

// Things with flat sides, of random size, shape and material, by kind.
[[nodiscard]] Thing makeRandomCarton(HashStream& random, double low_m,
                                     double high_m);       ///< edges of that length
[[nodiscard]] Thing makeRandomBook(HashStream& random);    ///< lying
[[nodiscard]] Thing makeUprightBook(HashStream& random);   ///< spine towards -y
[[nodiscard]] Thing makeRandomBlocks(HashStream& random);  ///< L, T, U, stairs: boxes in one piece
[[nodiscard]] Thing makeRandomLaptop(HashStream& random);
[[nodiscard]] Thing makeRandomMonitor(HashStream& random);
[[nodiscard]] Thing makeRandomShoe(HashStream& random);
[[nodiscard]] Thing makeRandomCushion(HashStream& random);  ///< lying
[[nodiscard]] Thing makeRandomSuitcase(HashStream& random);
[[nodiscard]] Thing makeContainer(HashStream& random);  ///< a tray or an open box; its stand is inside
/// A board, picture or pole whose upper end leans on a wall (y = 0 and behind it). The wall's upper edge is
/// at `wall_height_m`, rounded with `edge_m`; the foot stands on z = 0.
[[nodiscard]] Thing makeLeaning(HashStream& random, double wall_height_m, double edge_m);

}  // namespace scantrove::synthetic
