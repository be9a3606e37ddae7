#include "core/synthetic/renderer.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <opencv2/imgproc.hpp>
#include <optional>
#include <vector>

#include "core/synthetic/view_caster.h"

namespace scantrove::synthetic {
namespace {

/// Linear light to an sRGB byte.
std::uint8_t displayByte(float linear) {
  static constexpr int kSteps = 4096;
  static const std::array<std::uint8_t, kSteps> kTable = [] {
    std::array<std::uint8_t, kSteps> table{};
    for (int i = 0; i < kSteps; ++i) {
      const float x = (static_cast<float>(i) + 0.5F) / kSteps;
      const float s = x <= 0.0031308F ? 12.92F * x : 1.055F * std::pow(x, 1 / 2.4F) - 0.055F;
      table[static_cast<std::size_t>(i)] = static_cast<std::uint8_t>(std::lround(255 * s));
    }
    return table;
  }();
  const float soft = linear < 0.8F ? linear : 0.8F + 0.2F * (1 - std::exp((0.8F - linear) / 0.2F));
  return kTable[static_cast<std::size_t>(std::clamp(soft * kSteps, 0.0F, kSteps - 1.0F))];
}

/// Neighbouring pixels of a row on one surface; they share slowly varying values.
constexpr int kRun_px = 4;
struct Run {
  int part = -1;
  int first_u = 0;
  Vec3 normal = Vec3::Zero();
  float openness = 1;
};

/// A surface point in a pixel.
struct Sight {
  const ViewCaster::Hit& hit;
  int u, v;
  const Vec3& ray;  ///< world frame, one metre along the optical axis
  const Vec3& to_eye;
  const SurfacePoint& surface;
  const Eigen::Matrix3d& rotation;  ///< of its part
  double facing;                    ///< cosine between normal and `to_eye`
};

/// Light that surfaces send to the eye.
class SurfaceLight {
 public:
  SurfaceLight(const SyntheticScene& scene, const Lighting& lighting, const ViewCaster& caster,
               const View& view)
      : scene_(scene),
        lighting_(lighting),
        caster_(caster),
        view_(view),
        eye_(view.T_world_view.translation()) {}

  [[nodiscard]] Rgb of(const Sight& sight, Run& run) const {
    const Material& material = scene_.parts()[static_cast<std::size_t>(sight.hit.part)].material;
    Vec3 normal = sight.rotation.lazyProduct(sight.surface.shading_normal);
    if (sight.facing < 0) {
      normal = -normal;
    }
    const auto footprint = static_cast<float>(sight.hit.z / view_.fx / std::max(std::abs(sight.facing), 0.2));
    const Vec3 point = eye_ + sight.hit.z * sight.ray;
    if (sight.hit.part != run.part || sight.u - run.first_u >= kRun_px || normal.dot(run.normal) < 0.98) {
      run = {sight.hit.part, sight.u, normal, lighting_.openness(point, normal)};
    }
    Rgb own = albedo(material, sight.surface, footprint);
    // Less passes where the surface is seen at a grazing angle.
    const float through =
        material.transparency * (0.35F + 0.65F * static_cast<float>(std::abs(sight.facing)));
    if (through > 0) own *= 1 - through;
    Rgb light = lighting_.shade(point, normal, sight.to_eye, own, material, run.openness);
    if (through > 0) light += through * material.main * behind(sight);
    return light;
  }

 private:
  /// Light from the nearest surface of another instance behind a transparent one.
  [[nodiscard]] Rgb behind(const Sight& sight) const {
    static const Rgb kNothing(0.58F, 0.63F, 0.69F);  // as in pixels without a surface
    const std::vector<SyntheticScene::Part>& parts = scene_.parts();
    const ViewCaster::Hit hit =
        caster_.cast(sight.u, sight.v, parts[static_cast<std::size_t>(sight.hit.part)].instance);
    if (!hit) return kNothing;
    const SyntheticScene::Part& part = parts[static_cast<std::size_t>(hit.part)];
    const SurfacePoint surface = part.shape->describe(caster_.localPoint(hit, sight.u, sight.v), hit.piece);
    Vec3 normal = part.T_world_part.linear() * surface.shading_normal;
    if (normal.dot(sight.to_eye) < 0) normal = -normal;
    const Vec3 point = eye_ + hit.z * sight.ray;
    const auto footprint = static_cast<float>(hit.z / view_.fx / std::max(normal.dot(sight.to_eye), 0.2));
    return lighting_.shade(point, normal, sight.to_eye, albedo(part.material, surface, footprint),
                           part.material, lighting_.openness(point, normal));
  }

  const SyntheticScene& scene_;
  const Lighting& lighting_;
  const ViewCaster& caster_;
  const View& view_;
  Vec3 eye_;
};

}  // namespace

RenderedFrame renderFrame(const SyntheticScene& scene, const Lighting* lighting, const Intrinsics& K,
                          const Eigen::Isometry3d& T_world_camera) {
  const View view{T_world_camera, K.fx, K.fy, K.cx, K.cy, K.width, K.height, false};
  const ViewCaster caster(scene, view);
  std::vector<Eigen::Matrix3d> rotations;  // of each part
  for (const SyntheticScene::Part& part : scene.parts()) {
    rotations.emplace_back(part.T_world_part.linear());
  }
  const Eigen::Matrix3d R_world_camera = T_world_camera.linear();
  RenderedFrame frame;
  frame.z_m = cv::Mat::zeros(K.height, K.width, CV_32FC1);
  frame.incidence = cv::Mat::zeros(K.height, K.width, CV_32FC1);
  frame.instances = cv::Mat::zeros(K.height, K.width, CV_16UC1);
  frame.parts = cv::Mat(K.height, K.width, CV_32SC1, cv::Scalar(-1));
  if (lighting != nullptr) {
    frame.color = cv::Mat(K.height, K.width, CV_8UC3, cv::Scalar(216, 208, 200));
  }
  std::optional<SurfaceLight> surface_light;
  if (lighting != nullptr) surface_light.emplace(scene, *lighting, caster, view);
  for (int v = 0; v < K.height; ++v) {
    Run run;
    for (int u = 0; u < K.width; ++u) {
      const ViewCaster::Hit hit = caster.cast(u, v);
      if (!hit) {
        continue;
      }
      const auto part_index = static_cast<std::size_t>(hit.part);
      const SyntheticScene::Part& part = scene.parts()[part_index];
      const Eigen::Matrix3d& rotation = rotations[part_index];
      const SurfacePoint surface = part.shape->describe(caster.localPoint(hit, u, v), hit.piece);
      const Vec3 ray = R_world_camera.lazyProduct(Vec3((u - view.cx) / view.fx, (v - view.cy) / view.fy, 1));
      const Vec3 to_eye = ray * (-1 / ray.norm());
      const Vec3 normal = rotation.lazyProduct(surface.normal);
      const double facing = normal.dot(to_eye);
      frame.z_m.at<float>(v, u) = static_cast<float>(hit.z);
      frame.incidence.at<float>(v, u) = static_cast<float>(std::abs(facing));
      frame.instances.at<std::uint16_t>(v, u) = part.instance;
      frame.parts.at<std::int32_t>(v, u) = hit.part;
      if (surface_light) {
        const Rgb light = surface_light->of({hit, u, v, ray, to_eye, surface, rotation, facing}, run);
        frame.color.at<cv::Vec3b>(v, u) = {displayByte(light[2]), displayByte(light[1]),
                                           displayByte(light[0])};
      }
    }
  }
  if (lighting != nullptr) {
    // The slight blur of a real lens also smooths the aliasing of one ray a pixel.
    cv::GaussianBlur(frame.color, frame.color, {3, 3}, 0.6, 0.6, cv::BORDER_REPLICATE);
  }
  return frame;
}

}  // namespace scantrove::synthetic
