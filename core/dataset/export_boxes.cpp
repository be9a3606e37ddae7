#include <spdlog/fmt/fmt.h>

#include <map>
#include <numbers>
#include <opencv2/core.hpp>
#include <optional>
#include <utility>

#include "core/dataset/category_list.h"
#include "core/dataset/dataset_formats.h"
#include "core/dataset/depth_units.h"
#include "core/dataset/export_instances.h"
#include "core/dataset/key_frame_images.h"
#include "core/dataset/mesh_parts.h"
#include "core/dataset/ply_file.h"
#include "core/dataset/region_choice.h"
#include "core/dataset/up_direction.h"
#include "core/dataset/upright_box.h"
#include "core/image/png_encoder.h"

namespace scantrove {
namespace {

constexpr double kDegreesPerRadian = 180 / std::numbers::pi;

/// SUN RGB-D stores millimetres with their 16 bits turned by three.
cv::Mat asStoredBySunRgbd(cv::Mat depth_mm) {
  for (auto it = depth_mm.begin<std::uint16_t>(); it != depth_mm.end<std::uint16_t>(); ++it)
    *it = static_cast<std::uint16_t>(*it << 3U | *it >> 13U);
  return depth_mm;
}

/// Rotation of the camera's frame into its levelled frame: x right, y down along gravity, z forward and
/// level. `up`: unit vector in the camera's frame. A camera that looks straight up or down has the upper edge
/// of its image in front.
Eigen::Matrix3d levelled(const Eigen::Vector3d& up) {
  const auto level = [&](const Eigen::Vector3d& v) -> Eigen::Vector3d { return v - v.dot(up) * up; };
  Eigen::Vector3d forward = level(Eigen::Vector3d::UnitZ());
  constexpr double kSteep = 0.05;
  if (forward.norm() < kSteep) forward = level(-Eigen::Vector3d::UnitY());
  forward.normalize();
  Eigen::Matrix3d R;
  R.row(0) = (-up).cross(forward).transpose();
  R.row(1) = -up.transpose();
  R.row(2) = forward.transpose();
  return R;
}

std::string rowsOf(const Eigen::Matrix3d& matrix, const std::string& end_of_row) {
  std::string text;
  for (int i = 0; i < 3; ++i)
    text += fmt::format("{:.9g} {:.9g} {:.9g}{}\n", matrix(i, 0), matrix(i, 1), matrix(i, 2), end_of_row);
  return text;
}

ExportJson xyzOf(double x, double y, double z) { return {{"x", x}, {"y", y}, {"z", z}}; }

ExportJson numbersOf(const Eigen::Vector3d& v) { return {v.x(), v.y(), v.z()}; }

ExportJson rowsAsJson(const Eigen::Matrix4d& matrix) {
  ExportJson rows = ExportJson::array();
  for (int i = 0; i < 4; ++i)
    rows.push_back(ExportJson{matrix(i, 0), matrix(i, 1), matrix(i, 2), matrix(i, 3)});
  return rows;
}

/// The data set under construction. Boxes are in the scene's frame: the scan's, turned so that z is up.
class BoxDataset {
 public:
  explicit BoxDataset(ExportJob& job)
      : job_(job),
        categories_(job.scans().classes(), job.scans().chosen()),
        instances_(instancesOf(job.chosen())) {}

  Result<void> makeBoxes() {
    auto mesh = job_.scan().mesh();
    if (!mesh) return fail(mesh.error());
    SCANTROVE_TRY(checkMesh(*mesh));
    const auto frames = job_.scan().keyFrames(false);
    if (!frames) return fail(frames.error());
    const Eigen::Affine3f turn = turning(upDirection(*frames, *mesh), Eigen::Vector3f::UnitZ());
    R_scene_scan_ = Eigen::Quaterniond(turn.linear().cast<double>()).normalized().toRotationMatrix();
    LabeledMesh scene = transformed(std::move(*mesh), Eigen::Affine3f(R_scene_scan_.cast<float>()));
    const std::string ply = encodePly(scene, {}, "metres, z up, label = region id");
    SCANTROVE_TRY(job_.write("pointclouds/scene.ply", ply));
    job_.summary().points += scene.vertices.size();
    job_.summary().faces += scene.faces.size();
    const auto parts =
        splitByRegion(withInstanceIds(std::move(scene), instances_), regionsStandingFor(instances_));
    for (const ExportInstance& instance : instances_) {
      const auto part = parts.find(instance.id);
      if (part == parts.end()) {
        job_.summary().notes.push_back(onOneLine(instance.name) + " has no surface, and so no box.");
        continue;
      }
      std::vector<Eigen::Vector3f> points;
      for (const SurfacePoint& vertex : part->second.vertices) points.push_back(vertex.position_world_m);
      boxes_[instance.id] = fitUprightBox(points);
    }
    return {};
  }

  Result<void> add(const LabeledImage& image) {
    const std::string folder = "sunrgbd/" + image.stem + "/";
    Eigen::Isometry3d T_scene_camera = Eigen::Isometry3d::Identity();
    T_scene_camera.linear() = R_scene_scan_ * image.T_world_camera.linear();
    T_scene_camera.translation() = R_scene_scan_ * image.T_world_camera.translation();
    const Eigen::Vector3d up = T_scene_camera.linear().transpose() * Eigen::Vector3d::UnitZ();
    const Eigen::Matrix3d R_level_camera = levelled(up);
    const Eigen::Isometry3d T_level_scene = Eigen::Isometry3d(R_level_camera) * T_scene_camera.inverse();
    ExportJson objects = ExportJson::array();
    for (const ExportInstance& instance : instances_) {
      const auto box = boxes_.find(instance.id);
      if (box == boxes_.end()) continue;
      const int pixels = cv::countNonZero(instance.maskIn(image));
      if (pixels == 0) continue;
      objects.push_back(sunObject(instance, box->second, T_level_scene));
      job_.counts().countMask(instance.class_name, pixels);
    }
    SCANTROVE_TRY(writeImages(image, folder));
    Eigen::Matrix3d K = Eigen::Matrix3d::Identity();
    K(0, 0) = double{image.K.fx}, K(0, 2) = double{image.K.cx};
    K(1, 1) = double{image.K.fy}, K(1, 2) = double{image.K.cy};
    SCANTROVE_TRY(job_.write(folder + "intrinsics.txt", rowsOf(K, "")));
    SCANTROVE_TRY(job_.write(folder + "extrinsics/" + image.stem + ".txt", rowsOf(R_level_camera, " 0")));
    ExportJson annotation = ExportJson::object();
    annotation["name"] = validUtf8(job_.scan().name()) + "/" + image.stem;
    annotation["fileList"] = ExportJson::array({image.stem + ".jpg"});
    annotation["frames"] = ExportJson::array();
    annotation["objects"] = std::move(objects);
    annotation["T_level_scene"] = rowsAsJson(T_level_scene.matrix());
    return job_.write(folder + "annotation3Dfinal/index.json", jsonText(annotation, -1));
  }

  Result<void> finish() {
    ExportJson labels = ExportJson::object(), boxes = ExportJson::array(), objects = ExportJson::array();
    for (const ExportInstance& instance : instances_) {
      const auto found = boxes_.find(instance.id);
      if (found == boxes_.end()) continue;
      objects.push_back(labelCloudObject(instance, found->second));
      boxes.push_back(fullBox(instance, found->second));
    }
    labels["folder"] = "pointclouds";
    labels["filename"] = "scene.ply";
    labels["path"] = "pointclouds/scene.ply";
    labels["objects"] = std::move(objects);
    SCANTROVE_TRY(job_.write("labels/scene.json", jsonText(labels)));
    SCANTROVE_TRY(job_.write("labels/_classes.json", jsonText(labelCloudClasses())));
    Eigen::Matrix4d T_world_scene = Eigen::Matrix4d::Identity();
    T_world_scene.topLeftCorner<3, 3>() = R_scene_scan_.transpose();
    T_world_scene.topRightCorner<3, 1>() = job_.scan().origin();
    ExportJson all = ExportJson::object();
    all["T_world_scene"] = rowsAsJson(T_world_scene);
    all["boxes"] = std::move(boxes);
    return job_.write("boxes.json", jsonText(all));
  }

 private:
  Result<void> writeImages(const LabeledImage& image, const std::string& folder) {
    const auto jpeg = asJpeg(image);
    if (!jpeg) return fail(jpeg.error());
    SCANTROVE_TRY(job_.write(folder + "image/" + image.stem + ".jpg", *jpeg));
    const cv::Mat depth = asStoredBySunRgbd(depthInUnits(image.depth_m, 0.001F));
    return job_.write(folder + "depth/" + image.stem + ".png", encodePng(depth));
  }

  /// In SUN RGB-D's annotation: corners of the base in the levelled frame, and heights along y, which points
  /// down.
  static ExportJson sunObject(const ExportInstance& instance, const UprightBox& box,
                              const Eigen::Isometry3d& T_level_scene) {
    ExportJson x = ExportJson::array(), z = ExportJson::array();
    for (const Eigen::Vector3d& corner : box.levelCorners()) {
      const Eigen::Vector3d p = T_level_scene * corner;
      x.push_back(p.x());
      z.push_back(p.z());
    }
    const double y = (T_level_scene * box.center).y();
    ExportJson polygon = ExportJson::object();
    polygon["X"] = std::move(x);
    polygon["Z"] = std::move(z);
    polygon["Ymin"] = y + box.size.z() / 2;
    polygon["Ymax"] = y - box.size.z() / 2;
    polygon["rectangle"] = 1;
    ExportJson object = ExportJson::object();
    object["name"] = instance.class_name;
    object["polygon"] = ExportJson::array({polygon});
    object["instance"] = instance.id;
    object["instance_name"] = instance.name;
    return object;
  }

  static ExportJson labelCloudObject(const ExportInstance& instance, const UprightBox& box) {
    const Eigen::Vector3d &c = box.center, &s = box.size;
    return {{"name", instance.class_name},
            {"centroid", xyzOf(c.x(), c.y(), c.z())},
            {"dimensions", {{"length", s.x()}, {"width", s.y()}, {"height", s.z()}}},
            {"rotations", xyzOf(0, 0, box.yaw_rad * kDegreesPerRadian)}};
  }

  static ExportJson fullBox(const ExportInstance& instance, const UprightBox& box) {
    return {{"instance", instance.id},
            {"name", instance.name},
            {"class", instance.class_name},
            {"object", instance.object ? ExportJson(*instance.object) : ExportJson(nullptr)},
            {"regions", instance.regions},
            {"center_m", numbersOf(box.center)},
            {"size_m", numbersOf(box.size)},
            {"yaw_deg", box.yaw_rad * kDegreesPerRadian}};
  }

  [[nodiscard]] ExportJson labelCloudClasses() const {
    ExportJson classes = ExportJson::array();
    for (const DatasetCategory& one : categories_.all())
      classes.push_back({{"name", one.name}, {"id", one.id}, {"color", hexOf(one.color)}});
    return {{"classes", std::move(classes)},
            {"default", categories_.all().front().id},
            {"type", "object_detection"},
            {"format", "centroid_abs"},
            {"created_with", {{"name", "Scantrove"}, {"version", "1.0"}}}};
  }

  ExportJob& job_;
  CategoryList categories_;
  std::vector<ExportInstance> instances_;
  std::map<std::uint32_t, UprightBox> boxes_;  // by instance, in the scene's frame
  Eigen::Matrix3d R_scene_scan_ = Eigen::Matrix3d::Identity();
};

}  // namespace

Result<void> exportBoxes(ExportJob& job) {
  SCANTROVE_TRY(job.needRegions());
  BoxDataset dataset(job);
  SCANTROVE_TRY(dataset.makeBoxes());
  SCANTROVE_TRY(
      forEachLabeledImage(job, true, [&](const LabeledImage& image) { return dataset.add(image); }));
  return dataset.finish();
}

}  // namespace scantrove
