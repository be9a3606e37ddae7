#pragma once
#include "core/synthetic/thing.h"

namespace scantrove::synthetic {

enum class ChairBack {
  upright_slats,
  ladder,        ///< slats across
  panel,         ///< closed from the seat up
  raised_panel,  ///< with a gap above the seat
};

/// A chair of wood or plastics: four legs, a seat at 43 - 47 cm, and a back up to 80 - 100 cm between two
/// posts. Its front is towards -y. Others may stand on the seat.
[[nodiscard]] Thing makeRandomChair(HashStream& random, ChairBack back);
[[nodiscard]] Thing makeRandomChair(HashStream& random);  ///< with any back

}  // namespace scantrove::synthetic
