#include "core/picture/picture_scene.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <unordered_map>
#include <utility>
#include <vector>

#include "core/dataset/up_direction.h"

namespace scantrove {
namespace {

using RegionsById = std::unordered_map<std::uint32_t, LabeledRegion>;

RegionsById byId(const std::vector<LabeledRegion>& regions) {
  RegionsById by_id;
  for (const LabeledRegion& region : regions) by_id.emplace(region.id, region);
  return by_id;
}

/// The region of two of the corners, else of the first.
std::uint32_t regionOfFace(const LabeledMesh& mesh, const std::array<std::uint32_t, 3>& face) {
  const std::uint32_t a = mesh.vertices[face[0]].region, b = mesh.vertices[face[1]].region,
                      c = mesh.vertices[face[2]].region;
  return b == c ? b : a;
}

bool isObject(const LabeledRegion& region) {
  return (region.object || !region.name.empty()) && !region.background && !region.rejected;
}

/// The color of a face by its region. Regions of one object have the color of the first of them.
class FaceColors {
 public:
  FaceColors(PictureColors colors, const std::vector<LabeledRegion>& regions)
      : colors_(colors), regions_(byId(regions)) {
    for (const LabeledRegion& region : regions) {
      if (!region.object) continue;
      const auto [first, is_new] = first_of_object_.emplace(*region.object, region.id);
      if (!is_new) first->second = std::min(first->second, region.id);
    }
  }

  [[nodiscard]] Rgb operator()(std::uint32_t region, const Rgb& own) const {
    if (colors_ == PictureColors::regions) return regionColor(RegionId{region});
    const auto found = regions_.find(region);
    if (found == regions_.end() || !isObject(found->second)) return grey(own);
    const std::optional<std::int64_t>& object = found->second.object;
    return regionColor(RegionId{object ? first_of_object_.at(*object) : region});
  }

 private:
  /// The luminance (ITU-R BT.601).
  static Rgb grey(const Rgb& rgb) {
    const auto value = static_cast<std::uint8_t>((299 * rgb[0] + 587 * rgb[1] + 114 * rgb[2]) / 1000);
    return {value, value, value};
  }

  PictureColors colors_;
  RegionsById regions_;
  std::unordered_map<std::int64_t, std::uint32_t> first_of_object_;
};

/// The faces for which `is_drawn(region)` holds, with their corners.
template <class IsDrawn>
PictureSurface surfaceOf(const LabeledMesh& mesh, PictureColors colors, const FaceColors& face_color,
                         const IsDrawn& is_drawn) {
  constexpr std::uint32_t kUnused = 0xFFFFFFFF;
  PictureSurface surface;
  std::vector<std::uint32_t> new_index(mesh.vertices.size(), kUnused);
  for (const auto& face : mesh.faces) {
    const std::uint32_t region = regionOfFace(mesh, face);
    if (!is_drawn(region)) continue;
    std::array<std::uint32_t, 3> corners{};
    for (std::size_t i = 0; i < 3; ++i) {
      std::uint32_t& index = new_index[face[i]];
      if (index == kUnused) {
        const SurfacePoint& point = mesh.vertices[face[i]];
        index = static_cast<std::uint32_t>(surface.vertices.size());
        surface.vertices.push_back({point.position_world_m, point.normal_world, point.rgb});
      }
      corners[i] = index;
    }
    surface.faces.push_back(corners);
    if (colors != PictureColors::rgb)
      surface.face_colors.push_back(face_color(region, mesh.vertices[face[0]].rgb));
  }
  return surface;
}

/// From the middle of the surface to the mean position of the cameras.
Eigen::Vector3f frontOf(const PictureSurface& surface, const std::vector<KeyFrameInfo>& frames) {
  Eigen::AlignedBox3f box;
  for (const PictureSurface::Vertex& vertex : surface.vertices) box.extend(vertex.position_world_m);
  Eigen::Vector3f mean = Eigen::Vector3f::Zero();
  for (const KeyFrameInfo& frame : frames) mean += frame.T_world_depth.translation().cast<float>();
  if (frames.empty()) return Eigen::Vector3f::UnitX();
  const Eigen::Vector3f front = mean / static_cast<float>(frames.size()) - box.center();
  return front.norm() > 1e-3F ? front.normalized() : Eigen::Vector3f::UnitX();
}

}  // namespace

std::optional<PictureColors> parsePictureColors(const std::string& word) {
  if (word == "rgb") return PictureColors::rgb;
  if (word == "regions") return PictureColors::regions;
  if (word == "objects") return PictureColors::objects;
  return std::nullopt;
}

Result<PictureScene> makePictureScene(LabeledScan& scan, PictureColors colors, const std::string& object) {
  const Result<std::vector<LabeledRegion>> regions = scan.regions();
  if (!regions) return fail(regions.error());
  const Result<std::vector<KeyFrameInfo>> frames = scan.keyFrames(false);
  if (!frames) return fail(frames.error());
  const Result<LabeledMesh> mesh = scan.mesh();
  if (!mesh) return fail(mesh.error());
  const RegionsById by_id = byId(*regions);
  const auto isDrawn = [&](std::uint32_t region) {
    if (object.empty()) return true;
    const auto found = by_id.find(region);
    return found != by_id.end() && found->second.name == object;
  };
  if (!object.empty() &&
      std::ranges::none_of(*regions, [&](const auto& region) { return region.name == object; }))
    return fail("No object of " + scan.name() + " is called '" + object + "'.",
                "'scantrove session regions' lists the names.");
  PictureScene scene;
  scene.surface = surfaceOf(*mesh, colors, FaceColors(colors, *regions), isDrawn);
  if (scene.surface.faces.empty())
    return fail(scan.name() + " has no surface to show.",
                object.empty() ? "Scan more frames." : "Choose another object.");
  scene.up_world = upDirection(*frames, *mesh).cast<float>();
  scene.front_world = frontOf(scene.surface, *frames);
  return scene;
}

}  // namespace scantrove
