#include <spdlog/fmt/fmt.h>

#include <cmath>
#include <opencv2/core.hpp>
#include <utility>

#include "core/dataset/bop_model.h"
#include "core/dataset/dataset_formats.h"
#include "core/dataset/depth_units.h"
#include "core/dataset/key_frame_images.h"
#include "core/dataset/mesh_parts.h"
#include "core/dataset/ply_file.h"
#include "core/dataset/region_choice.h"
#include "core/dataset/silhouette.h"
#include "core/dataset/up_direction.h"
#include "core/image/png_encoder.h"

namespace scantrove {
namespace {

constexpr double kMillimetersPerMeter = 1000;

ExportJson rowByRow(const Eigen::Matrix3d& matrix) {
  ExportJson list = ExportJson::array();
  for (int row = 0; row < 3; ++row) {
    for (int column = 0; column < 3; ++column) list.push_back(matrix(row, column));
  }
  return list;
}

ExportJson millimetersOf(const Eigen::Vector3d& v) {
  return {v.x() * kMillimetersPerMeter, v.y() * kMillimetersPerMeter, v.z() * kMillimetersPerMeter};
}

ExportJson boxAsList(const cv::Rect& box) {
  if (box.empty()) return {-1, -1, -1, -1};  // bop_toolkit's value for "nothing"
  return {box.x, box.y, box.width, box.height};
}

ExportJson cameraMatrix(const Intrinsics& K) { return {K.fx, 0.0, K.cx, 0.0, K.fy, K.cy, 0.0, 0.0, 1.0}; }

/// The scene under construction.
class BopScene {
 public:
  explicit BopScene(ExportJob& job) : job_(job) {}

  /// Begins the scene of a scan: "000001/", in a split project "train/000001/".
  Result<void> beginScan() {
    const DatasetPart& part = job_.part();
    folder_ = (part.split ? splitName(*part.split) + "/" : "") + fmt::format("{:06}/", part.number);
    models_.clear();
    class_names_.clear();
    for (ExportJson* scene : {&cameras_, &poses_, &infos_}) *scene = ExportJson::object();
    return writeModels();
  }

  Result<void> endScan() {
    SCANTROVE_TRY(writeJson(folder_ + "scene_camera.json", cameras_));
    SCANTROVE_TRY(writeJson(folder_ + "scene_gt.json", poses_));
    return writeJson(folder_ + "scene_gt_info.json", infos_);
  }

  Result<void> add(const LabeledImage& image) {
    const std::string key = std::to_string(image.frame.index);
    const cv::Mat depth = depthInUnits(image.depth_m, image.frame.meters_per_unit);
    SCANTROVE_TRY(job_.write(folder_ + "rgb/" + image.image_name, image.image_bytes));
    SCANTROVE_TRY(job_.write(folder_ + "depth/" + image.stem + ".png", encodePng(depth)));
    describeCamera(image, key);
    poses_[key] = ExportJson::array();
    infos_[key] = ExportJson::array();
    for (const auto& [region, model] : models_) SCANTROVE_TRY(addObject(image, key, depth, region, model));
    return {};
  }

  Result<void> finish() {
    SCANTROVE_TRY(writeJson("models/models_info.json", model_infos_));
    SCANTROVE_TRY(writeJson("camera.json", camera_));
    return writeJson("labels.json", labels_);
  }

 private:
  Result<void> writeModels() {
    const auto mesh = job_.scan().mesh();
    if (!mesh) return fail(mesh.error());
    SCANTROVE_TRY(checkMesh(*mesh));
    const auto frames = job_.scan().keyFrames(false);
    if (!frames) return fail(frames.error());
    models_ = bopModelsOf(*mesh, job_.chosen(), upDirection(*frames, *mesh));
    for (const LabeledRegion& region : job_.chosen()) class_names_[region.id] = classOf(region);
    addToLegend(labels_, legendOf(job_.chosen(), job_.scan().origin()), job_.part());
    for (const auto& [region, model] : models_) {
      const LabeledMesh mesh_mm = model.meshInMillimeters();
      const std::uint32_t id = job_.part().idOf(region);
      const std::string name = fmt::format("models/obj_{:06}.ply", id);
      SCANTROVE_TRY(job_.write(name, encodePly(mesh_mm, {.label = false}, "millimetres, z up")));
      model_infos_[std::to_string(id)] = bopModelInfo(mesh_mm);
      job_.summary().points += mesh_mm.vertices.size();
      job_.summary().faces += mesh_mm.faces.size();
    }
    return {};
  }

  Result<void> writeJson(const std::string& name, const ExportJson& json) {
    return job_.write(name, jsonByLines(json));
  }

  void describeCamera(const LabeledImage& image, const std::string& key) {
    Eigen::Isometry3d T_world_camera = image.T_world_camera;
    T_world_camera.translation() += job_.scan().origin();
    const Eigen::Isometry3d T_camera_world = T_world_camera.inverse();
    const double scale = std::round(image.frame.meters_per_unit * kMillimetersPerMeter * 1e6) / 1e6;
    cameras_[key] = {{"cam_K", cameraMatrix(image.K)},
                     {"depth_scale", scale},
                     {"cam_R_w2c", rowByRow(T_camera_world.linear())},
                     {"cam_t_w2c", millimetersOf(T_camera_world.translation())}};
    camera_ = {{"cx", image.K.cx}, {"cy", image.K.cy},         {"depth_scale", scale},  {"fx", image.K.fx},
               {"fy", image.K.fy}, {"height", image.K.height}, {"width", image.K.width}};
  }

  Result<void> addObject(const LabeledImage& image, const std::string& key, const cv::Mat& depth,
                         std::uint32_t region, const BopModel& model) {
    const Silhouette whole = silhouetteOf(model.mesh_world, image.K, image.T_world_camera);
    const cv::Mat visible = image.maskOf(region);
    const cv::Mat rendered = whole.mask(visible.size());
    cv::Mat mask;
    cv::bitwise_or(rendered, visible, mask);  // the image has a more accurate outline than the map
    const int inside = cv::countNonZero(mask);
    if (inside == 0) return {};
    const std::string file = fmt::format("/{}_{:06}.png", image.stem, poses_[key].size());
    SCANTROVE_TRY(job_.write(folder_ + "mask" + file, encodePng(mask)));
    SCANTROVE_TRY(job_.write(folder_ + "mask_visib" + file, encodePng(visible)));
    const Eigen::Isometry3d T_camera_model = image.T_world_camera.inverse() * model.T_world_model;
    poses_[key].push_back({{"cam_R_m2c", rowByRow(T_camera_model.linear())},
                           {"cam_t_m2c", millimetersOf(T_camera_model.translation())},
                           {"obj_id", job_.part().idOf(region)}});
    const int all = inside + whole.pixels - cv::countNonZero(rendered);
    const int seen = cv::countNonZero(visible);
    job_.counts().countMask(class_names_.at(region), seen);
    cv::Mat valid;
    cv::bitwise_and(mask, depth > 0, valid);
    const cv::Rect box = whole.tightBox() | boxOf(visible);
    infos_[key].push_back({{"bbox_obj", boxAsList(box)},
                           {"bbox_visib", boxAsList(boxOf(visible))},
                           {"px_count_all", all},
                           {"px_count_valid", cv::countNonZero(valid)},
                           {"px_count_visib", seen},
                           {"visib_fract", static_cast<double>(seen) / all}});
    return {};
  }

  ExportJob& job_;
  std::map<std::uint32_t, BopModel> models_;
  std::map<std::uint32_t, std::string> class_names_;
  ExportJson cameras_ = ExportJson::object(), poses_ = ExportJson::object(), infos_ = ExportJson::object();
  ExportJson camera_ = ExportJson::object(), model_infos_ = ExportJson::object(),
             labels_ = ExportJson::object();
  std::string folder_;  // of the scene
};

}  // namespace

Result<void> exportBop(ExportJob& job) {
  SCANTROVE_TRY(job.needRegions());
  BopScene scene(job);
  const auto addScan = [&]() -> Result<void> {
    SCANTROVE_TRY(scene.beginScan());
    SCANTROVE_TRY(
        forEachLabeledImage(job, true, [&](const LabeledImage& image) { return scene.add(image); }));
    return scene.endScan();
  };
  SCANTROVE_TRY(job.forEachScan(addScan));
  return scene.finish();
}

}  // namespace scantrove
