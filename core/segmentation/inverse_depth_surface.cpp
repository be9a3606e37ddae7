#include "core/segmentation/inverse_depth_surface.h"

#include <Eigen/Cholesky>
#include <algorithm>
#include <cmath>

namespace scantrove {
namespace {

constexpr int kIterations = 6;
constexpr int kPlaneIterations = 3;  // before the quadratic terms
constexpr std::size_t kMinSamples = 30;
/// The second iteration accepts readings this many times farther, the next ones less and less.
constexpr float kFirstTolerance = 4;

using Coefficients = InverseDepthSurface::Coefficients;

Coefficients termsAt(double x, double y) { return {1, x, y, x * x, x * y, y * y}; }

/// Sums of the normal equations.
struct NormalEquations {
  Eigen::Matrix<double, 6, 6> a = Eigen::Matrix<double, 6, 6>::Zero();
  Coefficients b = Coefficients::Zero();
  std::size_t samples = 0;

  template <int kTerms>
  void add(const Coefficients& all, double inverse_depth, double weight) {
    const Eigen::Matrix<double, kTerms, 1> terms = all.head<kTerms>();
    a.topLeftCorner<kTerms, kTerms>().noalias() += weight * terms * terms.transpose();
    b.head<kTerms>() += weight * inverse_depth * terms;
    ++samples;
  }

  [[nodiscard]] std::optional<Coefficients> solve(int terms) const {
    if (samples < kMinSamples) return std::nullopt;
    const Eigen::LDLT<Eigen::MatrixXd> factors(a.topLeftCorner(terms, terms));
    if (factors.info() != Eigen::Success || !factors.isPositive()) return std::nullopt;
    Coefficients solution = Coefficients::Zero();
    solution.head(terms) = factors.solve(b.head(terms));
    if (!solution.allFinite()) return std::nullopt;
    return solution;
  }
};

}  // namespace

InverseDepthSurface::InverseDepthSurface(const Coefficients& coefficients) : c_(coefficients.cast<float>()) {
  // A plane n . X = d with 1 / z = (n.x x + n.y y + n.z) / d; its normal faces the camera where 1 / z > 0.
  normal_ = -Eigen::Vector3f(c_[1], c_[2], c_[0]).normalized();
}

std::optional<InverseDepthSurface> InverseDepthSurface::fit(std::span<const Sample> samples,
                                                            float tolerance_m, bool bowed) {
  constexpr int kPlane = 3, kBowed = 6;
  std::optional<InverseDepthSurface> surface;
  for (int iteration = 0; iteration < kIterations; ++iteration) {
    // The first fit takes all samples, so that its surface is rough.
    const bool bow = bowed && iteration >= kPlaneIterations;
    const float reach =
        tolerance_m * std::max(1.0F, kFirstTolerance / static_cast<float>(std::max(1, iteration)));
    NormalEquations sums;
    for (const Sample& sample : samples) {
      const float grow = std::max(1.0F, sample.z_m);
      double weight = 1;
      if (surface) {
        const float off = surface->height(sample.x, sample.y, sample.z_m) / (reach * grow);
        if (!(std::abs(off) < 1)) continue;
        const float near = 1 - off * off;
        weight = near * near;  // Tukey's biweight
      }
      // Noise of inverse depth is the same at each depth, so that readings count alike.
      const Coefficients terms = termsAt(sample.x, sample.y);
      const double inverse_depth = 1.0 / static_cast<double>(sample.z_m);
      bow ? sums.add<kBowed>(terms, inverse_depth, weight) : sums.add<kPlane>(terms, inverse_depth, weight);
    }
    const auto solution = sums.solve(bow ? kBowed : kPlane);
    if (!solution) return std::nullopt;
    surface.emplace(*solution);
  }
  return surface;
}

float InverseDepthSurface::inverseDepth(float x, float y) const {
  return c_[0] + x * (c_[1] + x * c_[3] + y * c_[4]) + y * (c_[2] + y * c_[5]);
}

float InverseDepthSurface::height(float x, float y, float z_m) const {
  const float inverse = inverseDepth(x, y);
  if (!(inverse > 0)) return z_m;
  const float along_ray = 1 / inverse - z_m;
  return along_ray * std::abs(normal_.dot(Eigen::Vector3f(x, y, 1)));
}

float InverseDepthSurface::depthAt(float x, float y, float height_m) const {
  const float inverse = inverseDepth(x, y);
  if (!(inverse > 0)) return 0;
  constexpr float kMinCosine = 0.05F;  // at a grazing view a small height would move the point far
  const float cosine = std::max(kMinCosine, std::abs(normal_.dot(Eigen::Vector3f(x, y, 1))));
  return std::max(0.0F, 1 / inverse - height_m / cosine);
}

}  // namespace scantrove
