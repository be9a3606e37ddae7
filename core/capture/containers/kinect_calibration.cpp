#include "core/capture/containers/kinect_calibration.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <optional>

#include "core/capture/json_file.h"
#include "core/capture/pose_files.h"

namespace scantrove {

namespace {

/// A mode's image is a part, from `offset` on, of an image of the size `full` of the whole sensor, for which
/// the calibration is normalised.
struct KinectMode {
  cv::Size size;
  cv::Size full;
  cv::Point offset;
};
// Depth: NFOV unbinned and binned, WFOV binned, WFOV unbinned (and passive infrared).
constexpr std::array<std::array<int, 6>, 4> kDepthModes{{{640, 576, 1024, 1024, 192, 180},
                                                         {320, 288, 512, 512, 96, 90},
                                                         {512, 512, 512, 512, 0, 0},
                                                         {1024, 1024, 1024, 1024, 0, 0}}};
// Colour of 16:9 leaves out an eighth of the sensor's 4:3 image at the top and at the bottom.
constexpr std::array<std::array<int, 6>, 6> kColorModes{{{1280, 720, 1280, 960, 0, 120},
                                                         {1920, 1080, 1920, 1440, 0, 180},
                                                         {2560, 1440, 2560, 1920, 0, 240},
                                                         {3840, 2160, 3840, 2880, 0, 360},
                                                         {2048, 1536, 2048, 1536, 0, 0},
                                                         {4096, 3072, 4096, 3072, 0, 0}}};

std::optional<KinectMode> kinectMode(std::span<const std::array<int, 6>> modes, const cv::Size& size) {
  const auto found =
      std::ranges::find_if(modes, [&](const auto& mode) { return size == cv::Size(mode[0], mode[1]); });
  if (found == modes.end()) return std::nullopt;
  const auto& mode = *found;
  return KinectMode{size, {mode[2], mode[3]}, {mode[4], mode[5]}};
}

/// A camera of the file.
struct KinectCamera {
  std::array<double, 14> values{};  // cx, cy, fx, fy (of 1 = the image's side), k1 - k6, codx, cody, p2, p1
  Eigen::Isometry3d T_camera_rig = Eigen::Isometry3d::Identity();

  [[nodiscard]] Intrinsics intrinsics(const KinectMode& mode) const {
    const auto scaled = [](double value, int side) { return value * side; };
    return {static_cast<float>(scaled(values[2], mode.full.width)),
            static_cast<float>(scaled(values[3], mode.full.height)),
            static_cast<float>(scaled(values[0], mode.full.width) - mode.offset.x - 0.5),
            static_cast<float>(scaled(values[1], mode.full.height) - mode.offset.y - 0.5),
            mode.size.width,
            mode.size.height};
  }
  [[nodiscard]] LensDistortion lens() const {
    return {values[4], values[5], values[13], values[12], values[6], values[7], values[8], values[9]};
  }
};

/// Throws nlohmann's exceptions. None: numbers are wrong.
std::optional<KinectCamera> kinectCamera(const nlohmann::json& json) {
  KinectCamera camera;
  const auto values = json.at("Intrinsics").at("ModelParameters").get<std::vector<double>>();
  const nlohmann::json& Rt = json.at("Rt");
  const auto rotation = Rt.at("Rotation").get<std::vector<double>>();
  const auto translation = Rt.at("Translation").get<std::vector<double>>();
  if (values.size() < camera.values.size() || rotation.size() != 9 || translation.size() != 3)
    return std::nullopt;
  std::copy_n(values.begin(), camera.values.size(), camera.values.begin());
  if (!std::ranges::all_of(camera.values, [](double value) { return std::isfinite(value); }))
    return std::nullopt;
  const auto motion = rigidMotion(Eigen::Map<const Eigen::Matrix3d>(rotation.data()).transpose(),
                                  Eigen::Map<const Eigen::Vector3d>(translation.data()));
  if (!motion) return std::nullopt;
  camera.T_camera_rig = *motion;
  return camera;
}

std::string kinectSizeText(const cv::Size& size) {
  return std::to_string(size.width) + "x" + std::to_string(size.height);
}

}  // namespace

Result<ContainerCameras> kinectCameras(const std::string& json, const cv::Size& depth, const cv::Size& color,
                                       const std::string& name) {
  const auto broken = [&](const std::string& why) {
    return fail("The calibration in " + name + " cannot be used: " + why + (why.ends_with('.') ? "" : "."),
                "Give --intrinsics fx,fy,cx,cy and --color-registration.");
  };
  std::optional<KinectCamera> depth_camera, color_camera;
  const auto calibration = parseJson(json, "its calibration.json");
  if (!calibration) return broken(calibration.error().what);
  try {
    for (const nlohmann::json& camera : calibration->at("CalibrationInformation").at("Cameras")) {
      const auto location = camera.at("Location").get<std::string>();
      if (location == "CALIBRATION_CameraLocationD0") depth_camera = kinectCamera(camera);
      if (location == "CALIBRATION_CameraLocationPV0") color_camera = kinectCamera(camera);
    }
  } catch (const nlohmann::json::exception& exception) {
    return broken(exception.what());
  }
  const auto depth_mode = kinectMode(kDepthModes, depth);
  if (!depth_camera) return broken("it describes no depth camera");
  if (!depth_mode) return broken("no mode of the camera has depth images of " + kinectSizeText(depth));
  ContainerCameras cameras;
  cameras.depth.K = depth_camera->intrinsics(*depth_mode);
  cameras.depth.lens = depth_camera->lens();
  cameras.depth.units_per_meter = 1000;  // millimetres
  const auto color_mode = kinectMode(kColorModes, color);
  cameras.is_color_place_known = color_camera && color_mode;
  if (cameras.is_color_place_known) {
    cameras.color = ColorCamera{color_camera->intrinsics(*color_mode),
                                color_camera->T_camera_rig * depth_camera->T_camera_rig.inverse()};
    cameras.color_lens = color_camera->lens();
  }
  return cameras;
}

}  // namespace scantrove
