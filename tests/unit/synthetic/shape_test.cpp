#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <functional>
#include <random>

#include "core/synthetic/lathe.h"
#include "core/synthetic/rounded_shapes.h"

namespace scantrove::synthetic {
namespace {

/// Inside negative, outside positive; only the sign and the zero are used.
using Implicit = std::function<double(const Vec3&)>;

/// Random rays around a shape: each hit lies on the surface, nothing solid lies before it, and its normal is
/// the gradient of the implicit function; rays without a hit meet nothing solid.
void expectExact(const Shape& shape, const Implicit& implicit, double tolerance_m) {
  std::mt19937 random(3);
  std::uniform_real_distribution<double> uniform(-1, 1);
  int hits = 0;
  for (int i = 0; i < 4000; ++i) {
    const Vec3 from = Vec3(uniform(random), uniform(random), uniform(random)).normalized() * 0.8;
    const Vec3 towards = Vec3(uniform(random), uniform(random), uniform(random)) * 0.15;
    const Ray ray{from, (towards - from) * 0.7};  // not of unit length
    const ShapeHit hit = shape.intersect(ray, kNoHit);
    const double metres_per_t = ray.direction.norm();
    const double end = std::min(hit.t, 3.0);
    for (double t = 0; t < end - 2e-4 / metres_per_t; t += 1e-3 / metres_per_t) {
      ASSERT_GT(implicit(ray.at(t)), -tolerance_m) << "ray " << i << " passes through matter at t = " << t;
    }
    if (hit.t == kNoHit) {
      continue;
    }
    ++hits;
    const Vec3 p = ray.at(hit.t);
    ASSERT_NEAR(implicit(p), 0, tolerance_m) << "ray " << i;
    EXPECT_EQ(shape.intersect(ray, hit.t * 0.999).t, kNoHit) << "t_max is respected";
    const Vec3 normal = shape.describe(p, hit.part).normal;
    ASSERT_NEAR(normal.norm(), 1, 1e-9);
    const double h = 1e-4;
    EXPECT_GT(implicit(p + h * normal), implicit(p - h * normal)) << "normals point out of the matter";
  }
  EXPECT_GT(hits, 300);
}

TEST(SyntheticShape, RoundedBoxIsMetAtItsSurface) {
  const Vec3 half(0.1, 0.06, 0.15);
  const double radius = 0.02;
  expectExact(
      RoundedBox(half, radius),
      [&](const Vec3& p) {
        const Vec3 q = p.cwiseAbs() - half + Vec3::Constant(radius);
        return q.cwiseMax(0.0).norm() + std::min(q.maxCoeff(), 0.0) - radius;
      },
      1e-4);
}

TEST(SyntheticShape, SharpBoxIsMetExactly) {
  const Vec3 half(0.1, 0.06, 0.15);
  expectExact(
      RoundedBox(half, 0), [&](const Vec3& p) { return (p.cwiseAbs() - half).maxCoeff(); }, 1e-9);
}

TEST(SyntheticShape, SphereIsMetExactly) {
  expectExact(
      Sphere(0.12), [](const Vec3& p) { return p.norm() - 0.12; }, 1e-9);
}

TEST(SyntheticShape, TorusIsMetAtItsSurface) {
  expectExact(
      Torus(0.1, 0.03),
      [](const Vec3& p) { return std::hypot(std::hypot(p.x(), p.y()) - 0.1, p.z()) - 0.03; }, 1e-4);
}

TEST(SyntheticShape, HalfTorusHasAFlatCut) {
  expectExact(
      Torus(0.1, 0.03, 0.01),
      [](const Vec3& p) {
        return std::max(std::hypot(std::hypot(p.x(), p.y()) - 0.1, p.z()) - 0.03, 0.01 - p.y());
      },
      1e-4);
}

TEST(SyntheticShape, LatheOfACylinderIsTheCylinder) {
  expectExact(
      Lathe({{0, -0.1}, {0.08, -0.1}, {0.08, 0.12}, {0, 0.12}}),
      [](const Vec3& p) {
        return std::max(std::hypot(p.x(), p.y()) - 0.08, std::max(-0.1 - p.z(), p.z() - 0.12));
      },
      1e-7);
}

TEST(SyntheticShape, LatheOfAConeIsTheCone) {
  expectExact(
      Lathe({{0, 0}, {0.1, 0}, {0, 0.15}}),
      [](const Vec3& p) { return std::max(std::hypot(p.x(), p.y()) - 0.1 * (1 - p.z() / 0.15), -p.z()); },
      1e-7);
}

TEST(SyntheticShape, LatheOfACupIsHollow) {
  const Lathe cup({{0, 0}, {0.08, 0}, {0.08, 0.1}, {0.07, 0.1}, {0.07, 0.01}, {0, 0.01}});
  expectExact(
      cup,
      [](const Vec3& p) {
        const double ring = std::hypot(p.x(), p.y());
        const double outer = std::max({ring - 0.08, -p.z(), p.z() - 0.1});
        const double hollow = std::max(ring - 0.07, 0.01 - p.z());
        return std::max(outer, -hollow);
      },
      1e-7);
  const ShapeHit bottom = cup.intersect({{0.02, 0.01, 1}, {0, 0, -1}}, kNoHit);
  EXPECT_NEAR(bottom.t, 0.99, 1e-12);
}

TEST(SyntheticShape, ArcsAndRoundedCansKeepTheirSize) {
  Lathe::Profile arc;
  appendArc(arc, {0.05, 0.02}, 0.01, -90, 0, 4);
  ASSERT_EQ(arc.size(), 5U);
  EXPECT_NEAR(arc.front().y(), 0.01, 1e-12);
  EXPECT_NEAR(arc.back().x(), 0.06, 1e-12);
  const Bounds can = Lathe(canProfile(0.04, 0.03, 0.1)).bounds();
  EXPECT_NEAR(can.high.x(), 0.04, 1e-12);
  EXPECT_NEAR(can.high.z(), 0.1, 1e-6);
}

}  // namespace
}  // namespace scantrove::synthetic
