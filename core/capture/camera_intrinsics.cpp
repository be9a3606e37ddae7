#include "core/capture/camera_intrinsics.h"

#include <spdlog/spdlog.h>

#include <cmath>
#include <numbers>
#include <sstream>

#include "core/base/text.h"
#include "core/base/text_file.h"
#include "core/capture/folder_listing.h"
#include "core/capture/json_file.h"
#include "core/capture/pose_files.h"

namespace scantrove {

namespace {

bool isCenterNear(float center, int size) {
  return center >= -0.5F * static_cast<float>(size) && center <= 1.5F * static_cast<float>(size);
}

constexpr double kNarrowestView_deg = 2;
constexpr double kWidestView_deg = 160;
constexpr const char* kAdvice = "Give fx,fy,cx,cy in pixels, e.g. --intrinsics 525,525,319.5,239.5.";

double fieldOfView(int pixels, float focal_length) {
  return 2 * std::atan(0.5 * pixels / focal_length) * 180 / std::numbers::pi;
}

std::string text(double value) {
  std::ostringstream out;
  out << value;
  return out.str();
}

std::string sizeText(const Intrinsics& K) { return std::to_string(K.width) + "x" + std::to_string(K.height); }

std::string describe(const Intrinsics& K) {
  return text(K.fx) + "," + text(K.fy) + "," + text(K.cx) + "," + text(K.cy);
}

Result<Intrinsics> intrinsicsFrom(const nlohmann::json& json, const std::filesystem::path& file) {
  const auto matrix = json.at("intrinsic_matrix").get<std::vector<float>>();
  if (matrix.size() != 9) {
    return fail(file.string() + ": intrinsic_matrix has " + std::to_string(matrix.size()) +
                " values, not 9.");
  }
  return Intrinsics{
      matrix[0], matrix[4], matrix[6], matrix[7], json.value("width", 0), json.value("height", 0)};
}

Result<ColorCamera> colorCameraFrom(const nlohmann::json& json, const std::filesystem::path& file) {
  ColorCamera camera;
  SCANTROVE_TRY(moveInto(camera.K, intrinsicsFrom(json, file)));
  const auto values = json.at("T_color_depth").get<std::vector<double>>();
  const bool is_matrix = values.size() == 16;
  const auto motion =
      is_matrix ? rigidMotion(Eigen::Map<const Eigen::Matrix4d>(values.data()).transpose()) : std::nullopt;
  if (!motion) {
    return fail(file.string() + ": T_color_depth is no rigid motion of 16 values.",
                "Correct it, or give --color-registration.");
  }
  camera.T_color_depth = *motion;
  return camera;
}

/// A 4x4 camera matrix (ScanNet).
Result<Intrinsics> readProjection(const std::filesystem::path& file) {
  const auto matrix = readMatrixFile(file);
  if (!matrix) return fail(matrix.error().what, "Correct it, or give --intrinsics fx,fy,cx,cy.");
  const auto at = [&](int row, int column) { return static_cast<float>((*matrix)(row, column)); };
  return Intrinsics{at(0, 0), at(1, 1), at(0, 2), at(1, 2), 0, 0};
}

/// The pose of a camera on its rig; identity without a file.
Result<Eigen::Isometry3d> readPlace(const std::filesystem::path& file) {
  std::error_code error;
  if (!std::filesystem::exists(file, error)) return Eigen::Isometry3d::Identity();
  return readPoseFile(file);
}

/// Finds `cam_K.txt` or ScanNet's files in `place`.
Result<std::optional<CameraModel>> findOtherIntrinsics(const std::filesystem::path& place) {
  std::error_code error;
  Result<CameraModel> model = CameraModel();
  if (const auto file = place / "cam_K.txt"; std::filesystem::exists(file, error)) {
    model = readIntrinsicsMatrix(file);
  } else if (const auto files = place / "intrinsic";
             std::filesystem::exists(files / "intrinsic_depth.txt", error)) {
    model = readScannetIntrinsics(files, "intrinsic");
  } else {
    return std::optional<CameraModel>();
  }
  if (!model) return fail(model.error());
  return std::optional(*model);
}

}  // namespace

Result<void> checkFocalLengths(const Intrinsics& K, const std::string& origin) {
  if (!std::isfinite(K.fx) || !std::isfinite(K.fy) || !std::isfinite(K.cx) || !std::isfinite(K.cy)) {
    return fail("Intrinsics " + describe(K) + " (" + origin + ") have values that are not finite.", kAdvice);
  }
  if (!(K.fx > 0 && K.fy > 0)) {
    return fail("Intrinsics " + describe(K) + " (" + origin + "): the focal lengths must be positive.",
                kAdvice);
  }
  return {};
}

Result<void> checkIntrinsics(const Intrinsics& K, const std::string& origin) {
  SCANTROVE_TRY(checkFocalLengths(K, origin));
  for (const double angle : {fieldOfView(K.width, K.fx), fieldOfView(K.height, K.fy)}) {
    if (!(angle >= kNarrowestView_deg && angle <= kWidestView_deg)) {
      return fail("Intrinsics " + describe(K) + " (" + origin + "): a camera with " + sizeText(K) +
                      " images would see an angle of " + text(angle) +
                      " degrees; depth cameras see 2 to 160.",
                  kAdvice);
    }
  }
  if (!isCenterNear(K.cx, K.width) || !isCenterNear(K.cy, K.height)) {
    return fail("Intrinsics " + describe(K) + " (" + origin + "): the centre lies far outside the " +
                    sizeText(K) + " images.",
                kAdvice);
  }
  return {};
}

bool isSameCamera(const Intrinsics& a, const Intrinsics& b) {
  constexpr float kAgree_px = 3;
  return std::abs(a.fx - b.fx) < kAgree_px && std::abs(a.fy - b.fy) < kAgree_px &&
         std::abs(a.cx - b.cx) < kAgree_px && std::abs(a.cy - b.cy) < kAgree_px;
}

Intrinsics fitToImages(const CameraModel& model, int width, int height) {
  if (model.K.width > 0 && model.K.height > 0) {
    return model.K.width == width && model.K.height == height ? model.K : model.K.resizedTo(width, height);
  }
  Intrinsics K = model.K;
  K.width = width;
  K.height = height;
  return K;
}

Result<CameraModel> readIntrinsicsMatrix(const std::filesystem::path& file) {
  const Result<std::string> text = readTextFile(file);
  if (!text) {
    return fail(text.error());
  }
  const auto values = parseNumbers(*text);
  if (!values || values->size() != 9) {
    return fail(file.string() + " is not a 3x3 camera matrix.",
                "Correct it, or give --intrinsics fx,fy,cx,cy.");
  }
  const auto at = [&](std::size_t i) { return static_cast<float>((*values)[i]); };
  return CameraModel{{at(0), at(4), at(2), at(5), 0, 0}, std::nullopt};
}

Result<CameraModel> readIntrinsicsJson(const std::filesystem::path& file) {
  const auto read = readJson(file);
  if (!read) return fail(read.error());
  const nlohmann::json& json = *read;
  try {
    CameraModel model;
    SCANTROVE_TRY(moveInto(model.K, intrinsicsFrom(json, file)));
    if (json.contains("depth_scale")) {
      model.units_per_meter = json.at("depth_scale").get<double>();
    }
    if (json.contains("color_camera")) {
      ColorCamera camera;
      SCANTROVE_TRY(moveInto(camera, colorCameraFrom(json.at("color_camera"), file)));
      model.color = ColorRegistration{camera};
    } else if (json.value("color_registered", false)) {
      model.color = ColorRegistration{};
    }
    model.is_color_optional = json.value("color_optional", false);
    return model;
  } catch (const nlohmann::json::exception& exception) {
    return fail(file.string() + " is no Open3D camera: " + exception.what() + ".",
                "Correct it, or give --intrinsics fx,fy,cx,cy.");
  }
}

Result<CameraModel> readScannetIntrinsics(const std::filesystem::path& folder, const std::string& prefix) {
  CameraModel model;
  SCANTROVE_TRY(moveInto(model.K, readProjection(folder / (prefix + "_depth.txt"))));
  const std::filesystem::path color_file = folder / (prefix + "_color.txt");
  std::error_code error;
  if (!std::filesystem::exists(color_file, error)) return model;
  ColorCamera color;
  SCANTROVE_TRY(moveInto(color.K, readProjection(color_file)));
  Eigen::Isometry3d T_rig_depth, T_rig_color;
  SCANTROVE_TRY(moveInto(T_rig_depth, readPlace(folder / "extrinsic_depth.txt")));
  SCANTROVE_TRY(moveInto(T_rig_color, readPlace(folder / "extrinsic_color.txt")));
  color.T_color_depth = T_rig_color.inverse() * T_rig_depth;
  model.color = ColorRegistration{color};
  return model;
}

Result<std::optional<CameraModel>> findIntrinsics(const std::filesystem::path& folder) {
  std::error_code error;
  const auto present = [](Result<CameraModel> model) {
    return std::move(model).map([](CameraModel found) { return std::optional(found); });
  };
  if (const auto file = folder / "camera-intrinsics.txt"; std::filesystem::exists(file, error)) {
    return present(readIntrinsicsMatrix(file));
  }
  for (const char* const name : {"intrinsic.json", "camera_intrinsic.json"}) {
    if (const auto file = folder / name; std::filesystem::exists(file, error)) {
      return present(readIntrinsicsJson(file));
    }
  }
  auto found = findOtherIntrinsics(folder);
  if (!found || *found) return found;
  const std::filesystem::path parent = parentOf(folder);
  auto beside = findOtherIntrinsics(parent);
  if (beside && *beside) {
    spdlog::warn("{}: taking the intrinsics beside it, in {}.", folder.string(), parent.string());
  }
  return beside;
}

}  // namespace scantrove
