#include <spdlog/fmt/fmt.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <opencv2/core.hpp>
#include <utility>

#include "core/dataset/bop_model.h"
#include "core/dataset/dataset_formats.h"
#include "core/dataset/depth_units.h"
#include "core/dataset/export_instances.h"
#include "core/dataset/key_frame_images.h"
#include "core/dataset/mesh_parts.h"
#include "core/dataset/obj_file.h"
#include "core/dataset/region_choice.h"
#include "core/dataset/up_direction.h"
#include "core/image/png_encoder.h"

namespace scantrove {
namespace {

constexpr float kMetersPerUnit = 0.001F;
/// An object with fewer pixels with depth in an image is left out of it: programs cannot begin there.
constexpr int kMinPixelsWithDepth = 16;
/// Cameras that differ by less, in pixels of an image 640 wide, share a folder.
constexpr float kSameCamera_px = 1;

bool isSameCamera(const Intrinsics& a, const Intrinsics& b) {
  if (a.width != b.width || a.height != b.height) return false;
  // The same ray's pixels in both images: their distance is largest at a border.
  const auto differs = [](float fa, float ca, float fb, float cb, float pixel) {
    return std::abs(fb * (pixel - ca) / fa + cb - pixel);
  };
  const auto width = static_cast<float>(a.width), height = static_cast<float>(a.height);
  const float most = std::max({differs(a.fx, a.cx, b.fx, b.cx, 0), differs(a.fx, a.cx, b.fx, b.cx, width),
                               differs(a.fy, a.cy, b.fy, b.cy, 0), differs(a.fy, a.cy, b.fy, b.cy, height)});
  return most <= kSameCamera_px * std::max(1.0F, width / 640);
}

std::string textOfK(const Intrinsics& K) {
  return fmt::format("{:.9g} 0 {:.9g}\n0 {:.9g} {:.9g}\n0 0 1\n", K.fx, K.cx, K.fy, K.cy);
}

std::string textOf(const Eigen::Isometry3d& T) {
  std::string text;
  for (int row = 0; row < 4; ++row) {
    const Eigen::RowVector4d numbers = T.matrix().row(row);
    text += fmt::format("{:.12g} {:.12g} {:.12g} {:.12g}\n", numbers[0], numbers[1], numbers[2], numbers[3]);
  }
  return text;
}

/// FoundationPose finds masks and depth by replacing every "rgb" in an image's path, so names have none.
std::string folderName(const ExportInstance& instance) {
  std::string name = safeFileName(instance.id, instance.name);
  for (std::size_t at = 0; (at = name.find("rgb", at)) != std::string::npos; at += 5)
    name.replace(at, 3, "r_g_b");
  return name;
}

/// The folders under construction, one for each object and camera.
class FoundationPoseFolders {
 public:
  explicit FoundationPoseFolders(ExportJob& job) : job_(job), instances_(instancesOf(job.chosen())) {}

  Result<void> makeModels() {
    auto mesh = job_.scan().mesh();
    if (!mesh) return fail(mesh.error());
    SCANTROVE_TRY(checkMesh(*mesh));
    const auto frames = job_.scan().keyFrames(false);
    if (!frames) return fail(frames.error());
    const Eigen::Vector3f up = upDirection(*frames, *mesh);
    models_ = bopModelsOf(withInstanceIds(std::move(*mesh), instances_), regionsStandingFor(instances_), up);
    for (const ExportInstance& instance : instances_) {
      if (!models_.contains(instance.id))
        job_.summary().notes.push_back(onOneLine(instance.name) + " has no surface and was left out.");
    }
    return {};
  }

  Result<void> add(const LabeledImage& image) {
    const std::size_t camera = cameraOf(image.K);
    const cv::Mat depth = depthInUnits(image.depth_m, kMetersPerUnit);
    Shared shared;
    for (const ExportInstance& instance : instances_) {
      const auto model = models_.find(instance.id);
      if (model == models_.end()) continue;
      const cv::Mat mask = instance.maskIn(image);
      cv::Mat measured;
      cv::bitwise_and(mask, depth > 0, measured);
      if (cv::countNonZero(measured) < kMinPixelsWithDepth) continue;
      SCANTROVE_TRY(encodeShared(image, depth, shared));
      SCANTROVE_TRY(addTo(folderOf(instance, camera), image, shared, mask, model->second));
      job_.counts().countMask(instance.class_name, cv::countNonZero(mask));
    }
    return {};
  }

  Result<void> finish() {
    if (folders_.empty() && job_.scans().isProject()) {
      job_.summary().notes.push_back("No object of the scan " + job_.part().name +
                                     " has a surface and images with its depth.");
      return {};
    }
    if (folders_.empty()) {
      return fail("No object of the scan " + job_.scan().name() + " has a surface and images with its depth.",
                  "Scan the objects from closer by, or export mesh.");
    }
    for (const auto& [key, folder] : folders_) {
      const LabeledMesh mesh = models_.at(key.first).meshInMeters();
      SCANTROVE_TRY(job_.write(folder + "/cam_K.txt", textOfK(cameras_[key.second])));
      SCANTROVE_TRY(job_.write(folder + "/mesh/model.obj", encodeObj(mesh, nameOf(key.first))));
      job_.summary().points += mesh.vertices.size();
      job_.summary().faces += mesh.faces.size();
    }
    if (cameras_.size() > 1) {
      job_.summary().notes.push_back(fmt::format(
          "The camera changed during the scan. Images of each of its {} intrinsics are in folders "
          "of their own.",
          cameras_.size()));
    }
    return job_.write("labels.json", jsonByLines(instanceLegend(instances_)));
  }

 private:
  using Key = std::pair<std::uint32_t, std::size_t>;  // instance, place in cameras_

  /// Files that all objects in an image share, encoded at their first use.
  struct Shared {
    std::string color, depth;
  };

  std::size_t cameraOf(const Intrinsics& K) {
    const auto found = std::find_if(cameras_.begin(), cameras_.end(),
                                    [&](const Intrinsics& known) { return isSameCamera(known, K); });
    if (found != cameras_.end()) return static_cast<std::size_t>(found - cameras_.begin());
    cameras_.push_back(K);
    return cameras_.size() - 1;
  }

  const std::string& folderOf(const ExportInstance& instance, std::size_t camera) {
    const std::string suffix = camera == 0 ? "" : "_camera" + std::to_string(camera + 1);
    return folders_.try_emplace(Key{instance.id, camera}, folderName(instance) + suffix).first->second;
  }

  [[nodiscard]] std::string nameOf(std::uint32_t id) const {
    return std::find_if(instances_.begin(), instances_.end(),
                        [&](const ExportInstance& instance) { return instance.id == id; })
        ->name;
  }

  static Result<void> encodeShared(const LabeledImage& image, const cv::Mat& depth, Shared& shared) {
    if (!shared.depth.empty()) return {};
    SCANTROVE_TRY(moveInto(shared.color, asPng(image)));
    shared.depth = encodePng(depth);
    return {};
  }

  Result<void> addTo(const std::string& folder, const LabeledImage& image, const Shared& shared,
                     const cv::Mat& mask, const BopModel& model) {
    const Eigen::Isometry3d T_camera_model = image.T_world_camera.inverse() * model.T_world_model;
    const std::string file = "/" + image.stem;
    SCANTROVE_TRY(job_.write(folder + "/rgb" + file + ".png", shared.color));
    SCANTROVE_TRY(job_.write(folder + "/depth" + file + ".png", shared.depth));
    SCANTROVE_TRY(job_.write(folder + "/masks" + file + ".png", encodePng(mask)));
    return job_.write(folder + "/ob_in_cam" + file + ".txt", textOf(T_camera_model));
  }

  ExportJob& job_;
  std::vector<ExportInstance> instances_;
  std::map<std::uint32_t, BopModel> models_;  // by instance
  std::vector<Intrinsics> cameras_;           // in the order of their first frames
  std::map<Key, std::string> folders_;
};

}  // namespace

Result<void> exportFoundationPose(ExportJob& job) {
  SCANTROVE_TRY(job.needRegions());
  FoundationPoseFolders folders(job);
  SCANTROVE_TRY(folders.makeModels());
  SCANTROVE_TRY(
      forEachLabeledImage(job, true, [&](const LabeledImage& image) { return folders.add(image); }));
  return folders.finish();
}

}  // namespace scantrove
