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
  grain,      ///< wood with dark rings, `scale` metres apart, along u
  floral,     ///< cloth with flowers of `second` and `third`, `scale` metres apart
  tartan,     ///< cloth with crossing bands, repeated after `scale` metres
  page,       ///< paper with columns of print and a picture on its upper and lower face
  magazine,   ///< a cover: a picture over the whole face, a title, lines of print, a bar code
  packaging,  ///< a carton printed on all faces: brand, picture, small print, bar code
  keys,       ///< a keyboard: rows of keys on the upper face
};

struct Material {
  Pattern pattern = Pattern::plain;
  Rgb main = Rgb::Constant(0.5F);
  Rgb second = Rgb::Constant(0.2F);
  Rgb third = Rgb::Constant(0.8F);
  float scale = 0.03F;
  float gloss = 0;           ///< share of mirrored light: strength of the highlight; HardCamera loses depth
  bool casts_shadow = true;  ///< false for walls: the light comes through them
  std::uint32_t seed = 0;    ///< makes two objects of one pattern differ
  float polish = 60;         ///< sharpness of the highlight: exponent of its lobe
  float darkness = 0;        ///< share of infrared light that is swallowed; HardCamera loses depth
  float transparency = 0;    ///< share of light that passes; tinted with `main`; HardCamera loses depth
};

/// The colour of a surface point. `footprint_m` is the size of a pixel on the surface: detail finer than that
/// fades.
[[nodiscard]] Rgb albedo(const Material& material, const SurfacePoint& surface, float footprint_m);

}  // namespace scantrove::synthetic
