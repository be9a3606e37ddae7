#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <functional>
#include <memory>
#include <random>

#include "core/synthetic/bumpy_shape.h"
#include "core/synthetic/curtain.h"
#include "core/synthetic/lathe.h"
#include "core/synthetic/rounded_shapes.h"

namespace scantrove::synthetic {
namespace {

/// Negative inside, positive outside. Only the sign and zeros matter.
using Implicit = std::function<double(const Vec3&)>;

/// Casts random rays at a shape. Each hit lies on the surface with free space in front, and its normal points
/// along the gradient of the implicit function. Rays without a hit cross free space only.
void expectExact(const Shape& shape, const Implicit& implicit, double tolerance_m) {
  std::mt19937 random(3);
  std::uniform_real_distribution<double> uniform(-1, 1);
  int hits = 0;
  for (int i = 0; i < 4000; ++i) {
    const Vec3 from = Vec3(uniform(random), uniform(random), uniform(random)).normalized() * 0.8;
    const Vec3 towards = Vec3(uniform(random), uniform(random), uniform(random)) * 0.15;
    const Ray ray{from, (towards - from) * 0.7};  // not of unit length
    const ShapeHit hit = shape.intersect(ray, kNoHit);
    const double meters_per_t = ray.direction.norm();
    const double end = std::min(hit.t, 3.0);
    for (double t = 0; t < end - 2e-4 / meters_per_t; t += 1e-3 / meters_per_t) {
      ASSERT_GT(implicit(ray.at(t)), -tolerance_m) << "ray " << i << " passes through the solid at t = " << t;
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
    EXPECT_GT(implicit(p + h * normal), implicit(p - h * normal)) << "normals point outwards";
  }
  EXPECT_GT(hits, 300);
}

TEST(SyntheticShape, RaysHitARoundedBoxAtItsSurface) {
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

TEST(SyntheticShape, RaysHitASharpBoxExactly) {
  const Vec3 half(0.1, 0.06, 0.15);
  expectExact(
      RoundedBox(half, 0), [&](const Vec3& p) { return (p.cwiseAbs() - half).maxCoeff(); }, 1e-9);
}

TEST(SyntheticShape, RaysHitASphereExactly) {
  expectExact(
      Sphere(0.12), [](const Vec3& p) { return p.norm() - 0.12; }, 1e-9);
}

TEST(SyntheticShape, RaysHitATorusAtItsSurface) {
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

TEST(SyntheticShape, LatheEqualsACylinder_WhenItsProfileIsOne) {
  expectExact(
      Lathe({{0, -0.1}, {0.08, -0.1}, {0.08, 0.12}, {0, 0.12}}),
      [](const Vec3& p) {
        return std::max(std::hypot(p.x(), p.y()) - 0.08, std::max(-0.1 - p.z(), p.z() - 0.12));
      },
      1e-7);
}

TEST(SyntheticShape, LatheEqualsACone_WhenItsProfileIsOne) {
  expectExact(
      Lathe({{0, 0}, {0.1, 0}, {0, 0.15}}),
      [](const Vec3& p) { return std::max(std::hypot(p.x(), p.y()) - 0.1 * (1 - p.z() / 0.15), -p.z()); },
      1e-7);
}

TEST(SyntheticShape, LatheIsHollow_WhenItsProfileIsACup) {
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

TEST(SyntheticShape, ReachBoundsTheSurface) {
  const RoundedBox box({0.1, 0.06, 0.15}, 0.02);
  const Lathe can(canProfile(0.04, 0.03, 0.1));
  const Torus ring(0.1, 0.03);
  const Sphere ball(0.12);
  std::mt19937 random(5);
  std::normal_distribution<double> normal;
  for (const Shape* shape : std::initializer_list<const Shape*>{&box, &can, &ring, &ball}) {
    for (int i = 0; i < 20; ++i) {
      const Vec3 direction = Vec3(normal(random), normal(random), normal(random)).normalized();
      double farthest = -kNoHit;
      for (int k = 0; k < 20000; ++k) {
        const Vec3 from = Vec3(normal(random), normal(random), normal(random)).normalized();
        const Vec3 towards = 0.1 * Vec3(normal(random), normal(random), normal(random));
        const Ray ray{from, towards - from};
        const ShapeHit hit = shape->intersect(ray, kNoHit);
        if (hit.t < kNoHit) farthest = std::max(farthest, direction.dot(ray.at(hit.t)));
      }
      EXPECT_LT(farthest, shape->reach(direction) + 1e-5);
      EXPECT_GT(farthest, shape->reach(direction) - 0.006) << "the accuracy of this many rays";
    }
  }
  const Torus half(0.1, 0.03, 0.0);
  EXPECT_EQ(half.reach(-Vec3::UnitY()), 0) << "the flat cut";
}

TEST(SyntheticShape, CurtainHangsInFolds) {
  const Curtain curtain({1.0, 0.10, 2.0}, 0.004, 6);
  int changes = 0;
  double before = 0;
  double nearest = kNoHit;
  double farthest = -kNoHit;
  for (int i = 0; i < 400; ++i) {
    const Ray ray{{-0.49 + 0.98 * i / 400, -1, 0.3}, {0, 1, 0}};
    const ShapeHit hit = curtain.intersect(ray, kNoHit);
    ASSERT_LT(hit.t, kNoHit) << "no gaps";
    const Vec3 point = ray.at(hit.t);
    nearest = std::min(nearest, point.y());
    farthest = std::max(farthest, point.y());
    const Vec3 normal = curtain.describe(point, hit.part).normal;
    EXPECT_LT(normal.y(), 0) << "towards the viewer";
    changes += normal.x() * before < 0 ? 1 : 0;
    before = normal.x();
  }
  EXPECT_GE(changes, 10) << "six folds, each with two turns";
  EXPECT_GT(farthest - nearest, 0.05);
  EXPECT_EQ(curtain.intersect({{0, -1, 1.01}, {0, 1, 0}}, kNoHit).t, kNoHit);
}

/// Height of the bumpy top of a box at z = 0.1; the ray comes from above.
double heightAt(const BumpyShape& shape, double x, double y) {
  return 1 - shape.intersect({{x, y, 1}, {0, 0, -1}}, kNoHit).t;
}

TEST(BumpyShape, HasBumpsOfTheRequestedHeightBelowTheSurface) {
  const BumpyShape shape(std::make_unique<RoundedBox>(Vec3(0.5, 0.5, 0.1), 0.0), 0.004, 0.06, 7);
  double lowest = kNoHit;
  double highest = -kNoHit;
  for (double x = -0.4; x < 0.4; x += 0.007) {
    for (double y = -0.4; y < 0.4; y += 0.007) {
      const double height = heightAt(shape, x, y);
      lowest = std::min(lowest, height);
      highest = std::max(highest, height);
      const Vec3 normal = shape.describe({x, y, height}, 0).normal;
      constexpr double kStep = 1e-3;
      const double slope_x = (heightAt(shape, x + kStep, y) - heightAt(shape, x - kStep, y)) / (2 * kStep);
      const double slope_y = (heightAt(shape, x, y + kStep) - heightAt(shape, x, y - kStep)) / (2 * kStep);
      const Vec3 expected = Vec3(-slope_x, -slope_y, 1).normalized();
      EXPECT_LT((normal - expected).norm(), 0.03 + (height > 0.1 - 1e-4 ? 0.3 : 0))
          << "less accurate where the surface is cut off";
    }
  }
  EXPECT_LE(highest, 0.1 + 1e-9);
  EXPECT_GT(highest - lowest, 0.0025);
  EXPECT_LT(highest - lowest, 0.0055);
}

TEST(BumpyShape, IsEqual_FromEveryDirection) {
  const BumpyShape shape(std::make_unique<RoundedBox>(Vec3(0.5, 0.5, 0.1), 0.0), 0.004, 0.06, 7);
  std::mt19937 random(9);
  std::uniform_real_distribution<double> uniform(-1, 1);
  for (int i = 0; i < 2000; ++i) {
    const Vec3 from{uniform(random), uniform(random), 0.6 + 0.4 * uniform(random)};
    const Vec3 towards{0.4 * uniform(random), 0.4 * uniform(random), 0.1};
    const Ray ray{from, towards - from};
    if (-ray.direction.normalized().z() < 0.35) continue;  // shallower than 20 degrees
    const Vec3 point = ray.at(shape.intersect(ray, kNoHit).t);
    EXPECT_NEAR(point.z(), heightAt(shape, point.x(), point.y()), 0.0002);
  }
}

}  // namespace
}  // namespace scantrove::synthetic
