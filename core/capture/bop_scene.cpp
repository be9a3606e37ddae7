#include "core/capture/bop_scene.h"

#include <spdlog/spdlog.h>

#include <algorithm>
#include <array>
#include <map>

#include "core/base/text.h"
#include "core/capture/folder_listing.h"
#include "core/capture/folder_pairs.h"
#include "core/capture/json_file.h"
#include "core/capture/source_options.h"
#include "core/image/image_file.h"

namespace scantrove {
namespace {

constexpr const char* kBopCameras = "scene_camera.json";
constexpr double kMillimeters = 1000;

/// One frame's entry in scene_camera.json.
struct BopCamera {
  Intrinsics K;  ///< width and height 0
  double units_per_meter = kMillimeters;
  std::optional<Eigen::Isometry3d> T_world_camera;
};

bool isBopScene(const std::filesystem::path& folder) {
  std::error_code error;
  return std::filesystem::is_regular_file(folder / kBopCameras, error) &&
         std::filesystem::is_directory(folder / "depth", error);
}

/// Throws a JSON exception if there are fewer numbers.
template <std::size_t count>
std::array<double, count> bopNumbers(const nlohmann::json& json, const char* name) {
  return json.at(name).get<std::array<double, count>>();
}

std::optional<Eigen::Isometry3d> bopPose(const nlohmann::json& json) {
  if (!json.contains("cam_R_w2c") || !json.contains("cam_t_w2c")) return std::nullopt;
  const auto rotation = bopNumbers<9>(json, "cam_R_w2c");
  const auto place = bopNumbers<3>(json, "cam_t_w2c");
  const auto motion =
      rigidMotion(Eigen::Map<const Eigen::Matrix<double, 3, 3, Eigen::RowMajor>>(rotation.data()),
                  Eigen::Map<const Eigen::Vector3d>(place.data()) / kMillimeters);
  return motion ? std::optional(motion->inverse()) : std::nullopt;
}

BopCamera bopCamera(const nlohmann::json& json) {
  const auto K = bopNumbers<9>(json, "cam_K");
  const auto at = [&](std::size_t i) { return static_cast<float>(K[i]); };
  return {{at(0), at(4), at(2), at(5), 0, 0}, kMillimeters / json.value("depth_scale", 1.0), bopPose(json)};
}

Result<std::map<int, BopCamera>> readBopCameras(const std::filesystem::path& file) {
  const auto json = readJson(file);
  if (!json) return fail(json.error());
  std::string frame;
  try {
    std::map<int, BopCamera> cameras;
    for (const auto& [key, camera] : json->items()) {
      frame = ", frame " + key;
      const auto number = parseFrameNumber(key);
      if (!number) continue;
      cameras[*number] = bopCamera(camera);
      const std::string origin = file.string() + frame;
      SCANTROVE_TRY(checkDepthScale(cameras[*number].units_per_meter, origin));
      SCANTROVE_TRY(checkFocalLengths(cameras[*number].K, origin));
    }
    return cameras;
  } catch (const nlohmann::json::exception& exception) {
    return fail(file.string() + frame + " is no camera of BOP: " + exception.what() + ".",
                "Correct it, or open its images as a folder with depth/ and rgb/.");
  }
}

/// Depth of another unit in units of the first frame.
ImageDecoder decoderInUnits(const std::filesystem::path& file, double factor) {
  return [file, factor]() -> Result<cv::Mat> {
    auto depth = readDepthImage(file);
    if (!depth) return depth;
    cv::Mat converted;
    depth->convertTo(converted, CV_16U, factor);
    converted.setTo(0, converted == UINT16_MAX);  // too far for 16 bits
    return converted;
  };
}

bool isSameLens(const Intrinsics& a, const Intrinsics& b) {
  return a.fx == b.fx && a.fy == b.fy && a.cx == b.cx && a.cy == b.cy;
}

/// Gives the entries their cameras; those without one are removed.
Result<void> addBopCameras(ImageSequence& sequence, const std::map<int, BopCamera>& cameras) {
  const std::size_t before = sequence.entries.size();
  std::erase_if(sequence.entries,
                [&](const ImageSequenceEntry& entry) { return !cameras.contains(entry.index); });
  const std::string file = (sequence.folder / kBopCameras).string();
  if (sequence.entries.empty()) return fail(file + " has no camera for any depth image.");
  if (sequence.entries.size() < before) {
    spdlog::warn("{}: {} of {} depth images have no camera and are left out.", file,
                 before - sequence.entries.size(), before);
  }
  const auto size = depthSizeOf(sequence.entries);
  const BopCamera& first = cameras.at(sequence.entries.front().index);
  sequence.camera = CameraModel{first.K, std::nullopt};
  sequence.camera_origin = file;
  sequence.units_per_meter = first.units_per_meter;
  const bool is_changing = std::ranges::any_of(sequence.entries, [&](const ImageSequenceEntry& entry) {
    return !isSameLens(cameras.at(entry.index).K, first.K);
  });
  for (ImageSequenceEntry& entry : sequence.entries) {
    const BopCamera& camera = cameras.at(entry.index);
    entry.T_world_camera = camera.T_world_camera;
    sequence.has_poses = sequence.has_poses || camera.T_world_camera;
    if (size && is_changing)
      entry.intrinsics = fitToImages({camera.K, std::nullopt}, size->width, size->height);
    if (camera.units_per_meter != first.units_per_meter)
      entry.decode_depth = decoderInUnits(entry.depth, first.units_per_meter / camera.units_per_meter);
  }
  return {};
}

std::optional<std::filesystem::path> bopColorFolder(const std::filesystem::path& scene) {
  std::error_code error;
  for (const char* const name : {"rgb", "gray"}) {
    if (std::filesystem::is_directory(scene / name, error)) return scene / name;
  }
  return std::nullopt;
}

}  // namespace

std::optional<std::filesystem::path> findBopScene(const std::filesystem::path& folder) {
  if (isBopScene(folder)) return folder;
  std::optional<std::filesystem::path> scene;
  const auto names = listFolder(folder);
  for (const std::string& name : names.value_or(std::vector<std::string>())) {
    const bool may_be_folder = name.find('.') == std::string::npos;  // looking at every image takes long
    if (!may_be_folder || !isBopScene(folder / name)) continue;
    if (scene) return std::nullopt;
    scene = folder / name;
  }
  return scene;
}

Result<std::unique_ptr<FrameSource>> openBopScene(const std::filesystem::path& folder,
                                                  const SourceOptions& options) {
  const std::filesystem::path scene = findBopScene(folder).value_or(folder);
  const auto cameras = readBopCameras(scene / kBopCameras);
  if (!cameras) return fail(cameras.error());
  ImageSequence sequence;
  sequence.kind = "BOP";
  sequence.folder = scene;
  const auto color_folder = bopColorFolder(scene);
  sequence.has_color = color_folder.has_value();
  SCANTROVE_TRY(moveInto(sequence.entries, pairFolders(scene / "depth", color_folder, folderName(scene))));
  SCANTROVE_TRY(addBopCameras(sequence, *cameras));
  return openImageSequence(std::move(sequence), options);
}

}  // namespace scantrove
