#pragma once
#include <cstdint>

#include "core/synthetic/shape.h"

namespace scantrove::synthetic {

/// Linear light, red green blue, 0..1 and beyond.
using Rgb = Eigen::Array3f;

/// 0xRRGGBB as designers write it (sRGB) to linear light.
[[nodiscard]] Rgb rgb(std::uint32_t hex);

enum class Pattern {
  plain,      ///< `main` with the faintest mottling
  checker,    ///< squares of `scale` metres, main and second
  stripes,    ///< along u, of `scale` metres
  bands,      ///< along v (rings around a lathe), of `scale` metres
  dots,       ///< dots of `second` on `main`, `scale` metres apart
  wood,       ///< grain along u
  planks,     ///< wooden floor: boards of `scale` metres' width along u
  tiles,      ///< square tiles of `scale` metres with joints of `second`
  weave,      ///< cloth or rug: border of `second`, zigzag of `third`
  plaster,    ///< wall paint
  speckle,    ///< glaze or stone: specks of `second`
  bookCover,  ///< a book lying on its back: cover, spine at -x, paper elsewhere
  boxLabel,   ///< a printed carton: picture, title, lines of small print
  canLabel,   ///< a printed band around a can between metal rims
  picture,    ///< a framed landscape on the face towards -y
};

struct Material {
  Pattern pattern = Pattern::plain;
  Rgb main = Rgb::Constant(0.5F);
  Rgb second = Rgb::Constant(0.2F);
  Rgb third = Rgb::Constant(0.8F);
  float scale = 0.03F;
  float gloss = 0;           ///< strength of the highlight
  bool casts_shadow = true;  ///< false for walls: the light comes through them
  std::uint32_t seed = 0;    ///< makes two objects of one pattern differ
};

/// The colour of a surface point. `footprint_m` is the size of a pixel on the surface: detail finer than that
/// fades.
[[nodiscard]] Rgb albedo(const Material& material, const SurfacePoint& surface, float footprint_m);

}  // namespace scantrove::synthetic
