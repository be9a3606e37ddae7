#pragma once
#include "core/synthetic/material.h"

namespace scantrove::synthetic::pattern {

// Patterns of the hard scenes, as in Pattern: strong wood grain, cloths, print. `footprint_m` as in albedo().
[[nodiscard]] Rgb grain(const Material& m, const SurfacePoint& s, float footprint_m);
[[nodiscard]] Rgb floral(const Material& m, const SurfacePoint& s, float footprint_m);
[[nodiscard]] Rgb tartan(const Material& m, const SurfacePoint& s, float footprint_m);
[[nodiscard]] Rgb page(const Material& m, const SurfacePoint& s, float footprint_m);
[[nodiscard]] Rgb magazine(const Material& m, const SurfacePoint& s, float footprint_m);
[[nodiscard]] Rgb packaging(const Material& m, const SurfacePoint& s, float footprint_m);
[[nodiscard]] Rgb keys(const Material& m, const SurfacePoint& s, float footprint_m);

}  // namespace scantrove::synthetic::pattern
