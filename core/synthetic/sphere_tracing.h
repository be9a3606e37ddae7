#pragma once
#include "core/synthetic/shape.h"

namespace scantrove::synthetic {

/// Marches along a ray from `t` to `leave`, by the free distance that `distance` guarantees; to a micrometre.
template <class Distance>
[[nodiscard]] double march(const Ray& ray, double t, double leave, const Distance& distance) {
  constexpr double kSurface_m = 1e-6;  // hit tolerance
  constexpr double kGrazing_m = 3e-5;  // a ray that ran out of steps within this distance counts as a hit
  constexpr int kMaxSteps = 96;
  const double per_meter = 1.0 / ray.direction.norm();
  double d = 0;
  for (int step = 0; step < kMaxSteps; ++step) {
    d = distance(ray.at(t));
    if (d < kSurface_m) {
      return t;
    }
    t += d * per_meter;
    if (!(t < leave)) {
      return kNoHit;
    }
  }
  return d < kGrazing_m ? t : kNoHit;
}

}  // namespace scantrove::synthetic
