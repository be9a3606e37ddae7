#pragma once
#include "core/synthetic/thing.h"

namespace scantrove::synthetic {

// Objects lower than 15 mm, of random size and material, that lie on tables.
[[nodiscard]] Thing makeRandomPaper(HashStream& random);     ///< one sheet or several; flat above
[[nodiscard]] Thing makeRandomMagazine(HashStream& random);  ///< closed or open; flat above
[[nodiscard]] Thing makeThinBook(HashStream& random);        ///< closed; flat above
[[nodiscard]] Thing makeRandomKnife(HashStream& random);
[[nodiscard]] Thing makeRandomFork(HashStream& random);
[[nodiscard]] Thing makeRandomSpoon(HashStream& random);
[[nodiscard]] Thing makeRandomPen(HashStream& random);
[[nodiscard]] Thing makeRandomKeyboard(HashStream& random);
[[nodiscard]] Thing makeFlatPlate(HashStream& random);
[[nodiscard]] Thing makeRandomPhone(HashStream& random);
[[nodiscard]] Thing makeRandomNapkin(HashStream& random);

/// Any of these.
[[nodiscard]] Thing makeRandomFlatThing(HashStream& random);
/// One that others can lie on: paper, a magazine or a book.
[[nodiscard]] Thing makeFlatStackable(HashStream& random);

}  // namespace scantrove::synthetic
