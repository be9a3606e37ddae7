#pragma once
#include "core/synthetic/layout.h"

namespace scantrove::synthetic {

/// Spreads a patterned cloth ("tablecloth", no object) over a table's top, on some tables. The stand for
/// things: on the cloth, or the top itself.
[[nodiscard]] Stand spreadCloth(HashStream& random, Layout& layout, const Stand& top);

/// Chairs at the sides of a table, facing it, some pushed under it. Skips those without room.
void placeChairsAt(HashStream& random, Layout& layout, const Stand& top, int count);

}  // namespace scantrove::synthetic
