#include "core/synthetic/kinect_noise.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <vector>

#include "core/synthetic/hash_random.h"

namespace scantrove::synthetic {
namespace {

constexpr std::uint32_t kGaussSteps = 4096;

/// Standard normal from 12 random bits: quantiles of the centres of 4096 equal slices.
float gauss(std::uint32_t bits) {
  static const std::array<float, kGaussSteps> kQuantile = [] {
    std::array<float, kGaussSteps> table{};
    double low = -6;  // bisect the normal distribution function in ascending order
    for (std::uint32_t i = 0; i < kGaussSteps; ++i) {
      const double target = (i + 0.5) / kGaussSteps;
      double a = low;
      double b = 6;
      for (int step = 0; step < 50; ++step) {
        const double middle = (a + b) / 2;
        (0.5 * std::erfc(-middle / std::sqrt(2.0)) < target ? a : b) = middle;
      }
      low = a;
      table[i] = static_cast<float>(a);
    }
    return table;
  }();
  return kQuantile[bits % kGaussSteps];
}

/// Whether two depths belong to different surfaces.
bool isJump(float a, float b) { return std::abs(a - b) > 0.015F + 0.015F * std::min(a, b); }

}  // namespace

cv::Mat projectorShadow(const cv::Mat& z_m, const Intrinsics& K, const KinectModel& model) {
  constexpr float kNothing = std::numeric_limits<float>::infinity();
  const float shift_m = K.fx * static_cast<float>(model.baseline_m);
  const int margin = static_cast<int>(shift_m / 0.2F) + 2;
  cv::Mat shadow = cv::Mat::zeros(z_m.size(), CV_8UC1);
  std::vector<float> nearest(static_cast<std::size_t>(z_m.cols + 2 * margin));  // for each projector column
  for (int v = 0; v < z_m.rows; ++v) {
    std::fill(nearest.begin(), nearest.end(), kNothing);
    const float* z = z_m.ptr<float>(v);
    const auto column = [&](int u) {
      return static_cast<float>(u + margin) - shift_m / std::max(z[u], 0.2F);
    };
    for (int u = 0; u < z_m.cols; ++u) {
      if (z[u] <= 0) {
        continue;
      }
      // A surface covers the columns from this pixel's to its neighbour's; an isolated pixel covers half a
      // column on each side.
      const bool joined = u + 1 < z_m.cols && z[u + 1] > 0 && !isJump(z[u], z[u + 1]);
      const float from = joined ? std::min(column(u), column(u + 1)) : column(u) - 0.5F;
      const float to = joined ? std::max(column(u), column(u + 1)) : column(u) + 0.5F;
      const float depth = joined ? std::max(z[u], z[u + 1]) : z[u];
      const int last = std::min(static_cast<int>(std::lrint(to)), static_cast<int>(nearest.size()) - 1);
      for (int c = std::max(static_cast<int>(std::lrint(from)), 0); c <= last; ++c) {
        float& cell = nearest[static_cast<std::size_t>(c)];
        cell = std::min(cell, depth);
      }
    }
    std::uint8_t* out = shadow.ptr<std::uint8_t>(v);
    for (int u = 0; u < z_m.cols; ++u) {
      const int c = static_cast<int>(std::lrint(column(u)));
      if (z[u] > 0 && c >= 0 && c < static_cast<int>(nearest.size())) {
        out[u] = isJump(z[u], nearest[static_cast<std::size_t>(c)]) ? 255 : 0;
      }
    }
  }
  return shadow;
}

cv::Mat measureDepth(const cv::Mat& z_m, const cv::Mat& incidence, const Intrinsics& K,
                     const KinectModel& model, std::uint32_t seed, std::uint32_t frame) {
  const cv::Mat shadow = projectorShadow(z_m, K, model);
  const auto steps_m = static_cast<float>(model.focal_px * model.baseline_m / model.disparity_step_px);
  const auto lateral = static_cast<float>(model.lateral_sigma_px);
  const auto grazing = static_cast<float>(model.grazing_cosine);
  const auto z_min = static_cast<float>(model.min_depth_m);
  const auto z_max = static_cast<float>(model.max_depth_m);
  cv::Mat measured = cv::Mat::zeros(z_m.size(), CV_32FC1);
  for (int v = 0; v < z_m.rows; ++v) {
    const float* true_z = z_m.ptr<float>(v);
    float* out = measured.ptr<float>(v);
    for (int u = 0; u < z_m.cols; ++u) {
      if (true_z[u] <= 0 || shadow.at<std::uint8_t>(v, u) != 0) {
        continue;
      }
      const std::uint32_t bits =
          hashBits(static_cast<std::uint32_t>(u), static_cast<std::uint32_t>(v), frame, seed);
      const std::uint32_t more = hashBits(bits, frame, 1, seed);
      // Lateral noise: near an edge, the pixel may show its neighbour.
      const int du = floorInt(lateral * gauss(bits) + 0.5F);
      const int dv = floorInt(lateral * gauss(bits >> 12) + 0.5F);
      const int nu = std::clamp(u + du, 0, z_m.cols - 1);
      const int nv = std::clamp(v + dv, 0, z_m.rows - 1);
      const float there = z_m.at<float>(nv, nu);
      const bool at_edge = there <= 0 || isJump(there, true_z[u]);
      if (at_edge &&
          (there <= 0 || hashUniform(more * 0x9e3779b9U) < static_cast<float>(model.edge_dropout))) {
        continue;
      }
      const float z = at_edge ? there : true_z[u];
      // Grazing incidence: holes in patches of a few pixels.
      const float cosine = incidence.at<float>(v, u);
      if (cosine < grazing) {
        const float left = (cosine - grazing / 3) / (grazing * 2 / 3);
        const float patch =
            0.5F * hashUniform(hashBits(static_cast<std::uint32_t>(u / 3), static_cast<std::uint32_t>(v / 3),
                                        frame, seed + 17)) +
            0.5F * hashUniform(more * 0x85ebca6bU);
        if (patch > left) {
          continue;
        }
      }
      const float noisy = z + static_cast<float>(model.sigma(z)) * gauss(more);
      if (!(noisy > z_min && noisy < z_max)) {
        continue;
      }
      const float disparity_steps = static_cast<float>(std::lrint(steps_m / noisy));
      out[u] = steps_m / disparity_steps;
    }
  }
  return measured;
}

void addColorNoise(cv::Mat& color, double sigma, std::uint32_t seed, std::uint32_t frame) {
  const auto amount = static_cast<float>(sigma);
  for (int v = 0; v < color.rows; ++v) {
    std::uint8_t* byte = color.ptr<std::uint8_t>(v);
    for (int i = 0; i < 3 * color.cols; i += 3) {
      const std::uint32_t bits =
          hashBits(static_cast<std::uint32_t>(i), static_cast<std::uint32_t>(v), frame, seed + 101);
      for (int c = 0; c < 3; ++c) {
        const float value = static_cast<float>(byte[i + c]) + amount * gauss(bits >> (10 * c));
        byte[i + c] = static_cast<std::uint8_t>(std::clamp(value + 0.5F, 0.0F, 255.0F));
      }
    }
  }
}

}  // namespace scantrove::synthetic
