#include "core/synthetic/depth_loss.h"

#include <algorithm>
#include <cmath>
#include <opencv2/imgproc.hpp>

#include "core/synthetic/pattern_tools.h"

namespace scantrove::synthetic {
namespace {

constexpr float kGain = 4;            // a quarter of the light of a white surface is enough
constexpr float kFull_m = 2;          // light decreases beyond this distance
constexpr float kBlindFrom = 0.906F;  // cosine of 25 degrees: the mirrored projector begins to blind
constexpr float kBlindAt = 0.985F;    // cosine of 10 degrees: it blinds fully
constexpr int kWindowRadius_px = 4;   // of the matched windows, at 640 x 480
constexpr float kNeeded = 0.35F;      // mean light that a window needs ...
constexpr float kVariation = 0.4F;    // ... more or less, by place and frame
constexpr float kSafe = 0.8F;         // windows with more light have exact readings
constexpr float kDisplaced = 7.5F;    // disparity steps, for each unit of missing light

/// What a material does to the projector's light.
struct Reflection {
  float scattered = 1;
  float gloss = 0;
};

std::vector<Reflection> reflectionsOf(const std::vector<SyntheticScene::Part>& parts) {
  std::vector<Reflection> reflections;
  reflections.reserve(parts.size());
  for (const SyntheticScene::Part& part : parts) {
    const Material& m = part.material;
    const float stays = 1 - m.transparency;  // light passes twice: in and out
    reflections.push_back({(1 - m.gloss) * (1 - m.darkness) * stays * stays, m.gloss});
  }
  return reflections;
}

/// Needed light at a pixel: patches that stay in the image, and smaller ones that change with the frame.
float neededLight(int u, int v, std::uint32_t seed, std::uint32_t frame) {
  constexpr float kPatch_px = 7;
  constexpr float kFlicker_px = 4;
  const auto x = static_cast<float>(u);
  const auto y = static_cast<float>(v);
  const float stays = pattern::noise(x / kPatch_px, y / kPatch_px, seed + 31);
  const float flickers = pattern::noise(x / kFlicker_px, y / kFlicker_px, hashBits(frame, 32, 0, seed));
  return kNeeded + kVariation * (0.6F * stays + 0.4F * flickers);
}

}  // namespace

cv::Mat returnedLight(const RenderedFrame& image, const std::vector<SyntheticScene::Part>& parts) {
  const std::vector<Reflection> reflections = reflectionsOf(parts);
  cv::Mat light = cv::Mat::zeros(image.z_m.size(), CV_32FC1);
  for (int v = 0; v < light.rows; ++v) {
    const float* z = image.z_m.ptr<float>(v);
    const float* cosine = image.incidence.ptr<float>(v);
    const std::int32_t* part = image.parts.ptr<std::int32_t>(v);
    float* out = light.ptr<float>(v);
    for (int u = 0; u < light.cols; ++u) {
      if (part[u] < 0) continue;
      const Reflection& reflection = reflections[static_cast<std::size_t>(part[u])];
      const float farther = std::max(1.0F, z[u] / kFull_m);
      const float scattered = std::min(1.0F, kGain * reflection.scattered * cosine[u] / (farther * farther));
      out[u] = scattered * (1 - reflection.gloss * pattern::smoothstep(kBlindFrom, kBlindAt, cosine[u]));
    }
  }
  return light;
}

void loseReadings(cv::Mat& measured, const cv::Mat& light, const KinectModel& model, std::uint32_t seed,
                  std::uint32_t frame) {
  const double per_px = measured.cols / 640.0;
  const int window_px = 2 * std::max(1, static_cast<int>(std::lround(kWindowRadius_px * per_px))) + 1;
  cv::Mat seen = cv::Mat::zeros(measured.size(), CV_32FC1);
  light.copyTo(seen, measured > 0);
  cv::blur(seen, seen, {window_px, window_px}, {-1, -1}, cv::BORDER_REPLICATE);
  const auto steps_m = static_cast<float>(model.focal_px * model.baseline_m / model.disparity_step_px);
  for (int v = 0; v < measured.rows; ++v) {
    const float* mean_light = seen.ptr<float>(v);
    float* z = measured.ptr<float>(v);
    for (int u = 0; u < measured.cols; ++u) {
      if (z[u] == 0 || mean_light[u] >= kSafe) continue;
      if (mean_light[u] < neededLight(u, v, seed, frame)) {
        z[u] = 0;
        continue;
      }
      const std::uint32_t bits =
          hashBits(static_cast<std::uint32_t>(u), static_cast<std::uint32_t>(v), frame, seed + 33);
      const float error = hashUniform(bits) + hashUniform(bits * 0x9e3779b9U) - 1;
      const float steps = static_cast<float>(std::lrint(steps_m / z[u]) +
                                             std::lrint(kDisplaced * (1 - mean_light[u]) * error));
      z[u] = steps > 0 ? steps_m / steps : 0.0F;
    }
  }
}

}  // namespace scantrove::synthetic
