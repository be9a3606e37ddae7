#include "core/synthetic/bumpy_shape.h"

#include <algorithm>
#include <numbers>

#include "core/synthetic/hash_stream.h"

namespace scantrove::synthetic {
namespace {

constexpr double kDeviations = 5;   // range of a sum of waves in standard deviations
constexpr double kSteepest = 0.16;  // root mean square of the slope
constexpr double kGrazing = 0.15;   // minimum steepness of rays

/// sin to 0.1 %: a corrected parabola.
float quickSine(float angle) {
  const float turns = angle * static_cast<float>(0.5 / std::numbers::pi);
  const float x = 2 * (turns - static_cast<float>(floorInt(turns + 0.5F)));  // -1..1
  const float y = 4 * x * (1 - std::abs(x));
  return y * (0.775F + 0.225F * std::abs(y));
}

}  // namespace

BumpyShape::BumpyShape(std::unique_ptr<Shape> base, double bumps_m, double wavelength_m, std::uint32_t seed)
    : base_(std::move(base)) {
  HashStream random(seed, 3);
  const double deviation = std::min(bumps_m / kDeviations, kSteepest * wavelength_m / (2 * std::numbers::pi));
  middle_ = 2 * deviation;
  double squares = 0;
  for (Wave& wave : waves_) {
    const double length = std::clamp(wavelength_m * random.uniform(0.6, 1.4), 0.02, 0.15);
    const double z = random.uniform(-1, 1);
    const double around = random.uniform(0, 2 * std::numbers::pi);
    const double flat = std::sqrt(1 - z * z);
    const Vec3 along(flat * std::cos(around), flat * std::sin(around), z);
    wave.per_meter = (along * (2 * std::numbers::pi / length)).cast<float>();
    wave.phase = static_cast<float>(random.uniform(0, 2 * std::numbers::pi));
    wave.height = static_cast<float>(length);
    squares += length * length / 2;
  }
  for (Wave& wave : waves_) wave.height *= static_cast<float>(deviation / std::sqrt(squares));
}

double BumpyShape::split_off(const Vec3& point) const {
  const Eigen::Vector3f p = point.cast<float>();
  float sum = 0;
  for (const Wave& wave : waves_) sum += wave.height * quickSine(wave.per_meter.dot(p) + wave.phase);
  return std::max(0.0, middle_ + double{sum});
}

Vec3 BumpyShape::slope(const Vec3& point) const {
  const Eigen::Vector3f p = point.cast<float>();
  Eigen::Vector3f sum = Eigen::Vector3f::Zero();
  constexpr auto kQuarter = static_cast<float>(std::numbers::pi / 2);
  for (const Wave& wave : waves_) {
    sum += wave.height * quickSine(wave.per_meter.dot(p) + wave.phase + kQuarter) * wave.per_meter;
  }
  return sum.cast<double>();
}

ShapeHit BumpyShape::intersect(const Ray& ray, double t_max) const {
  ShapeHit hit = base_->intersect(ray, t_max);
  if (hit.t == kNoHit) {
    return hit;
  }
  // The ray descends by `steep` per unit of t below the tangent plane until it reaches the surface's depth.
  const Vec3 normal = base_->describe(ray.at(hit.t), hit.part).normal;
  const double steep = std::max(std::abs(ray.direction.dot(normal)), kGrazing * ray.direction.norm());
  double deeper = 0;
  for (int i = 0; i < 3; ++i) {
    const Vec3 below = ray.at(hit.t + deeper);
    deeper = split_off(below + deeper * steep * normal) / steep;
  }
  hit.t += deeper;
  return hit.t < t_max ? hit : ShapeHit{};
}

SurfacePoint BumpyShape::describe(const Vec3& point, int part) const {
  SurfacePoint surface = base_->describe(point, part);
  const Vec3 gradient = split_off(point) > 0 ? slope(point) : Vec3::Zero();
  const auto tilt = [&](const Vec3& normal) {
    return Vec3(normal + gradient - gradient.dot(normal) * normal).normalized();
  };
  surface.normal = tilt(surface.normal);
  surface.shading_normal = tilt(surface.shading_normal);
  return surface;
}

SyntheticScene makeBumpy(SyntheticScene scene, std::uint32_t seed) {
  SyntheticScene bumpy;
  for (const InstanceName& who : scene.instances())
    bumpy.addInstance(who.name, who.is_object, who.non_convex);
  for (SyntheticScene::Part& part : std::move(scene).takeParts()) {
    HashStream random(seed, 5000U + part.instance);
    const double wavelength = 0.03 * std::pow(4.3, random.uniform(0, 1));
    const double bumps = std::min(random.uniform(0.002, 0.005), 0.3 * part.shape->thickness());
    if (bumps > 0.001) {
      part.shape = std::make_unique<BumpyShape>(std::move(part.shape), bumps, wavelength, random.bits());
    }
    bumpy.add(part.instance, std::move(part.shape), part.T_world_part, part.material);
  }
  return bumpy;
}

}  // namespace scantrove::synthetic
