#include "app/true_objects.h"

#include <algorithm>
#include <nlohmann/json.hpp>
#include <opencv2/imgproc.hpp>
#include <vector>

#include "core/base/regular_file.h"
#include "core/evaluation/object_extent.h"
#include "core/exchange/label_image_writer.h"
#include "core/scan/open_source.h"

namespace scantrove {
namespace {

namespace fs = std::filesystem;

constexpr int kFramesApart = 10;    // between frames used to measure sizes
constexpr int kPointsAFrame = 400;  // approximate maximum per object and frame

void addPoints(const RgbdFrame& frame, const Intrinsics& K, const cv::Mat& instances,
               std::map<int, std::vector<Eigen::Vector3f>>& points) {
  std::map<int, int> areas;
  for (const std::uint16_t id : cv::Mat_<std::uint16_t>(instances)) {
    if (points.contains(id)) ++areas[id];
  }
  std::map<int, int> passed;
  for (int v = 0; v < instances.rows; ++v) {
    for (int u = 0; u < instances.cols; ++u) {
      const int id = instances.at<std::uint16_t>(v, u);
      const std::uint16_t depth = frame.depth.at<std::uint16_t>(v, u);
      const auto area = areas.find(id);
      if (area == areas.end() || depth == 0 || passed[id]++ % (1 + area->second / kPointsAFrame) != 0)
        continue;
      const Eigen::Vector3f p_camera = K.backProject(static_cast<float>(u), static_cast<float>(v),
                                                     static_cast<float>(depth) * frame.meters_per_unit);
      points[id].push_back(frame.T_world_camera->cast<float>() * p_camera);
    }
  }
}

/// Measures missing extents of objects in every tenth frame of the recording.
Result<void> measureExtents(const fs::path& folder, TrueScene& scene) {
  std::map<int, std::vector<Eigen::Vector3f>> points;
  for (const auto& [id, object] : scene.objects) {
    if (object.extent_m <= 0) points[id] = {};
  }
  if (points.empty()) return {};
  SourceOptions options;
  options.stride = kFramesApart;
  const auto source = openSource(folder.string(), options);
  if (!source) {
    return fail("The sizes of the true objects are not known: " + source.error().what,
                "Give a recording with depth and poses, or extent_m in its instances.json.");
  }
  for (FrameRead read = (*source)->next(); read.status != FrameRead::Status::end; read = (*source)->next()) {
    if (read.status == FrameRead::Status::failed) return fail(read.error);
    const auto image = scene.images.find(read.frame.index);
    if (read.status != FrameRead::Status::frame || !read.frame.T_world_camera || image == scene.images.end())
      continue;
    auto instances = readLabelImage(image->second);
    if (!instances) return fail(instances.error());
    if (instances->size() != read.frame.depth.size()) {
      cv::resize(*instances, *instances, read.frame.depth.size(), 0, 0, cv::INTER_NEAREST_EXACT);
    }
    const Intrinsics K = read.frame.intrinsics.value_or((*source)->info().intrinsics);
    addPoints(read.frame, K, *instances, points);
  }
  for (const auto& [id, of_object] : points) scene.objects[id].extent_m = longestSide(of_object);
  return {};
}

}  // namespace

Result<bool> readInstanceList(const fs::path& file, TrueScene& scene) {
  std::error_code ignored;
  if (!fs::exists(file, ignored)) return false;
  const Result<std::string> text = readFile(file);
  if (!text) return fail(text.error());
  try {
    for (const nlohmann::json& instance : nlohmann::json::parse(*text)) {
      const int id = instance.at("id").get<int>();
      scene.names[id] = instance.at("name").get<std::string>();
      if (instance.at("object").get<bool>()) scene.objects[id].extent_m = instance.value("extent_m", 0.0);
    }
  } catch (const nlohmann::json::exception& exception) {
    return fail(
        file.string() + " is not a list of instances: " + exception.what() + ".",
        R"(It is a list of {"id": 7, "name": "mug", "object": true}, as 'scantrove record' writes it.)");
  }
  return true;
}

Result<TrueScene> readTrueScene(const fs::path& folder, const std::function<bool(long)>& isScanned) {
  TrueScene scene;
  SCANTROVE_TRY(moveInto(scene.images, numberedImages(folder)));
  std::erase_if(scene.images, [&](const auto& image) { return !isScanned(image.first); });
  if (scene.images.empty()) {
    return fail("No instance image in " + folder.string() + " belongs to a frame of the scan.",
                "Give the truth of the recording that was scanned.");
  }
  const Result<bool> listed = readInstanceList(folder / "instances.json", scene);
  if (!listed) return fail(listed.error());
  for (const auto& [number, path] : scene.images) {
    const auto instances = readLabelImage(path);
    if (!instances) return fail(instances.error());
    if (!*listed) {
      for (const std::uint16_t id : cv::Mat_<std::uint16_t>(*instances)) {
        if (id != 0) scene.objects.try_emplace(id);
      }
    }
    countVisible(*instances, scene.objects);
  }
  SCANTROVE_TRY(measureExtents(folder, scene));
  return scene;
}

}  // namespace scantrove
