#pragma once
#include "core/synthetic/thing.h"

namespace scantrove::synthetic {

// Materials of the hard generation, on which cameras lose depth or which distract by their patterns.
[[nodiscard]] Material randomMetal(HashStream& random);     ///< polished
[[nodiscard]] Material randomGlass(HashStream& random);     ///< clear or tinted, casts no shadow
[[nodiscard]] Material randomLacquer(HashStream& random);   ///< glossy, of any colour
[[nodiscard]] Material randomDarkness(HashStream& random);  ///< black plastics, glossy or matt
[[nodiscard]] Material randomCloth(HashStream& random);     ///< with a pattern of high contrast
[[nodiscard]] Material randomTop(HashStream& random);       ///< of tables: strong grain, stone, varnish

/// Gives a thing the materials that real ones of its kind often have: metal cans, glass bottles, black
/// monitors, printed cartons, tables with strong grain. Kinds without a rule stay as they are.
void giveHardMaterials(HashStream random, Thing& thing);

}  // namespace scantrove::synthetic
