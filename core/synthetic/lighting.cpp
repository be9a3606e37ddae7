#include "core/synthetic/lighting.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>

#include "core/synthetic/hash_stream.h"
#include "core/synthetic/view_caster.h"

namespace scantrove::synthetic {
namespace {
constexpr double kLift_m = 0.006;  // offset against self-shadowing
constexpr float kInnerRing_m = 0.025F;
constexpr float kOuterRing_m = 0.07F;
constexpr float kFar = 1e6F;
constexpr double kMapHeight_m = 6;  // height of the maps' viewpoint
constexpr float kLampStrength = 0.8F;

/// Light that a glossy surface mirrors from direction `to_light`.
float highlightOf(const Material& material, const Vec3& normal, const Vec3& to_light, const Vec3& to_eye) {
  const auto half = static_cast<float>(std::max(0.0, (to_light + to_eye).normalized().dot(normal)));
  return std::pow(half, material.polish);
}

}  // namespace

Lights makeRandomLights(std::uint32_t seed, const Vec3& center) {
  HashStream random(seed, 14000);
  const double azimuth = random.uniform(0, 2 * std::numbers::pi);
  const double height = random.uniform(35, 60) / 180 * std::numbers::pi;
  const double aside_x = random.uniform(-0.9, 0.9);
  const double aside_y = random.uniform(-0.9, 0.9);
  Lights lights;
  lights.to_sun = {std::cos(height) * std::cos(azimuth), std::cos(height) * std::sin(azimuth),
                   std::sin(height)};
  lights.lamp = Vec3(center.x() + aside_x, center.y() + aside_y, random.uniform(1.9, 2.4));
  return lights;
}

Lighting::Lighting(const SyntheticScene& scene, const Vec3& center, double radius, const Lights& lights)
    : to_light_(lights.to_sun.normalized()),
      lamp_(lights.lamp),
      from_light_(bake(scene, center, to_light_, radius, 768)),
      from_above_(bake(scene, center, Vec3::UnitZ(), radius, 384)),
      first_lit_(highestWithin(from_light_, 2.5 / from_light_.texels_per_meter)),
      tops_(highestWithin(from_above_, kOuterRing_m + 0.01)) {}

float Lighting::DepthMap::at(int x, int y) const {
  const bool inside = x >= 0 && y >= 0 && x < size && y < size;
  return inside
             ? z[static_cast<std::size_t>(y) * static_cast<std::size_t>(size) + static_cast<std::size_t>(x)]
             : kFar;
}

Lighting::DepthMap Lighting::bake(const SyntheticScene& scene, const Vec3& center, const Vec3& to_light,
                                  double radius, int size) {
  View view;
  view.parallel = true;
  view.shadow_casters_only = true;
  view.width = view.height = size;
  view.fx = view.fy = size / (2 * radius);
  view.cx = view.cy = (size - 1) / 2.0;
  const Vec3 z_axis = -to_light;
  const Vec3 x_axis = z_axis.cross(Vec3::UnitY()).normalized();
  view.T_world_view.linear() << x_axis, z_axis.cross(x_axis), z_axis;
  view.T_world_view.translation() = center + to_light * kMapHeight_m;
  const ViewCaster caster(scene, view);
  DepthMap map{view.T_world_view.inverse(), view.fx, size, {}};
  map.z.reserve(static_cast<std::size_t>(size) * static_cast<std::size_t>(size));
  for (int v = 0; v < size; ++v) {
    for (int u = 0; u < size; ++u) {
      const ViewCaster::Hit hit = caster.cast(u, v);
      map.z.push_back(hit ? static_cast<float>(hit.z) : kFar);
    }
  }
  return map;
}

Lighting::DepthMap Lighting::highestWithin(const DepthMap& map, double radius) {
  const int reach = static_cast<int>(std::ceil(radius * map.texels_per_meter));
  DepthMap result = map;
  for (const bool along_x : {true, false}) {  // a square window, one axis after the other
    const DepthMap source = result;
    auto texel = result.z.begin();
    for (int y = 0; y < map.size; ++y) {
      for (int x = 0; x < map.size; ++x) {
        float highest = kFar;
        for (int i = -reach; i <= reach; ++i) {
          highest = std::min(highest, along_x ? source.at(x + i, y) : source.at(x, y + i));
        }
        *texel++ = highest;
      }
    }
  }
  return result;
}

float Lighting::sunlit(const Vec3& point) const {
  const Vec3 p = from_light_.T_map_world * point;
  const double half = (from_light_.size - 1) / 2.0;
  const double x = p.x() * from_light_.texels_per_meter + half;
  const double y = p.y() * from_light_.texels_per_meter + half;
  const int x0 = floorInt(static_cast<float>(x));
  const int y0 = floorInt(static_cast<float>(y));
  if (x0 < 1 || y0 < 1 || x0 + 2 >= from_light_.size || y0 + 2 >= from_light_.size) {
    return 1;
  }
  const float z = static_cast<float>(p.z()) - 0.004F;
  if (z <= first_lit_.at(x0, y0)) {
    return 1;
  }
  // 4 x 4 comparisons; the outer ones are weighted by their overlap with the 3 x 3 window.
  const float fx = static_cast<float>(x) - static_cast<float>(x0);
  const float fy = static_cast<float>(y) - static_cast<float>(y0);
  const float weight_x[4] = {1 - fx, 1, 1, fx};
  const float weight_y[4] = {1 - fy, 1, 1, fy};
  float lit = 0;
  for (int dy = 0; dy < 4; ++dy) {
    const float* row = &from_light_.z[static_cast<std::size_t>((y0 - 1 + dy) * from_light_.size + x0 - 1)];
    for (int dx = 0; dx < 4; ++dx) {
      lit += row[dx] >= z ? weight_x[dx] * weight_y[dy] : 0.0F;
    }
  }
  return lit / 9;
}

float Lighting::openness(const Vec3& point, const Vec3& normal) const {
  struct Tap {
    float x, y, reach;  // metres
  };
  static const std::array<Tap, 10> kTaps = [] {
    std::array<Tap, 10> taps{};
    for (std::size_t i = 0; i < taps.size(); ++i) {
      const bool inner = i < 4;
      const double angle =
          2 * std::numbers::pi * static_cast<double>(i) / (inner ? 4 : 6) + (inner ? 0.4 : 0);
      const float reach = inner ? kInnerRing_m : kOuterRing_m;
      taps[i] = {reach * static_cast<float>(std::cos(angle)), reach * static_cast<float>(std::sin(angle)),
                 reach};
    }
    return taps;
  }();
  const Vec3 p = from_above_.T_map_world * Vec3(point + kLift_m * normal);
  const auto scale = static_cast<float>(from_above_.texels_per_meter);
  const float middle = 0.5F * static_cast<float>(from_above_.size - 1) + 0.5F;
  const float x = static_cast<float>(p.x()) * scale + middle;
  const float y = static_cast<float>(p.y()) * scale + middle;
  const auto z = static_cast<float>(p.z());
  if (z <= tops_.at(static_cast<int>(x), static_cast<int>(y))) {
    return 1;
  }
  float blocked = 0;
  for (const Tap& tap : kTaps) {
    const float higher = z - from_above_.at(floorInt(x + scale * tap.x), floorInt(y + scale * tap.y));
    blocked += std::clamp(higher / (2 * tap.reach), 0.0F, 1.0F);  // z grows downwards in the map
  }
  return 1 - 0.7F * blocked / static_cast<float>(kTaps.size());
}

Rgb Lighting::shade(const Vec3& point, const Vec3& normal, const Vec3& to_eye, const Rgb& albedo,
                    const Material& material, float openness) const {
  static const Rgb kSun = Rgb(1.0F, 0.93F, 0.82F) * 0.80F;
  static const Rgb kSky(0.40F, 0.43F, 0.48F);
  static const Rgb kGround(0.22F, 0.20F, 0.175F);
  const Vec3 lifted = point + kLift_m * normal;
  const auto facing = static_cast<float>(normal.dot(to_light_));
  const auto up = static_cast<float>(0.5 + 0.5 * normal.z());
  Rgb light = (kGround + (kSky - kGround) * up) * openness;
  float highlight = 0;
  if (facing > 0) {
    const float sun = sunlit(lifted);
    light += kSun * (facing * sun);
    if (material.gloss > 0) {
      highlight = material.gloss * sun * highlightOf(material, normal, to_light_, to_eye);
    }
  }
  if (lamp_ && material.gloss > 0) {
    highlight +=
        kLampStrength * material.gloss * highlightOf(material, normal, (*lamp_ - point).normalized(), to_eye);
  }
  return albedo * light + highlight;
}

}  // namespace scantrove::synthetic
