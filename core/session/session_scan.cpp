#include "core/session/session_scan.h"

#include <algorithm>
#include <array>
#include <cstdint>
#include <map>
#include <set>
#include <utility>
#include <vector>

#include "core/editing/frame_review_states.h"
#include "core/fusion/kernels/color_voxel.h"
#include "core/pipeline/mapping_pipeline.h"
#include "core/session/key_frame_choice.h"
#include "core/session/key_frame_files.h"
#include "core/session/mask_corrections.h"
#include "core/session/unknown_colors.h"

namespace scantrove {

SessionScan::SessionScan(OpenSession& session) : session_(session) {
  std::map<int, const SavedFrame*> frames;
  for (const SavedFrame& frame : session.frames()) frames[frame.number] = &frame;
  std::set<int> source_indices;
  for (const SavedKeyFrame& key : session.keyFrames()) {
    const auto found = frames.find(key.frame);
    if (found == frames.end() || !found->second->isUsable()) continue;
    stored_.push_back({found->second->source_index, &key, found->second});
    source_indices.insert(found->second->source_index);
  }
  if (source_indices.size() == stored_.size()) return;
  // Frames of several recordings may share numbers: then they are numbered consecutively.
  for (StoredFrame& kept : stored_) kept.index = kept.frame->number;
}

std::string SessionScan::name() const {
  const std::string name =
      std::filesystem::absolute(session_.folder()).lexically_normal().filename().string();
  return name.empty() ? "scan" : name;
}

Result<std::vector<LabeledRegion>> SessionScan::regions() {
  const auto summaries = session_.regions();
  if (!summaries) return fail(summaries.error());
  std::vector<LabeledRegion> regions;
  for (const RegionSummary& summary : *summaries) {
    LabeledRegion region;
    region.id = summary.region.value;
    region.name = summary.label.name;
    region.category = summary.label.category;
    region.class_id = summary.label.class_id;
    if (summary.label.object) region.object = summary.label.object.value;
    region.confirmed = summary.label.confirmed;
    region.is_program_name = !summary.label.is_named;
    region.background = summary.label.background;
    region.rejected = summary.label.rejected;
    region.voxels = static_cast<int>(summary.voxels);
    region.box_world_m = summary.box_world;
    region.centroid_world_m = summary.centroid_world;
    regions.push_back(std::move(region));
  }
  return regions;
}

std::vector<ObjectClass> SessionScan::classes() {
  std::vector<ObjectClass> list;
  const ClassTable classes = session_.classes();
  for (const auto& [id, one] : classes.all()) list.push_back(one);
  return list;
}

KeyFrameInfo SessionScan::infoOf(const OpenSession& session, const SavedKeyFrame& images,
                                 const SavedFrame& frame) {
  KeyFrameInfo info;
  info.index = frame.source_index;
  info.timestamp_s = frame.time_s;
  info.T_world_depth = frame.T_world_camera;
  info.K_depth = session.intrinsicsOf(frame);
  info.meters_per_unit = images.meters_per_unit;
  info.K_color = info.K_depth;
  if (images.color_camera) {
    info.K_color = images.color_camera->K;
    info.T_color_depth = images.color_camera->T_color_depth;
  } else if (images.color_width > 0) {
    info.K_color = info.K_depth.resizedTo(images.color_width, images.color_height);
  }
  if (!images.color_file.empty()) info.color_file = session.folder() / images.color_file;
  return info;
}

const SavedKeyFrame* SessionScan::keyFrameOf(int index) const {
  const auto found = std::ranges::find(stored_, index, &StoredFrame::index);
  return found == stored_.end() ? nullptr : found->images;
}

std::vector<PaintedMask> SessionScan::paintedMasks(int index) {
  const SavedKeyFrame* images = keyFrameOf(index);
  if (images == nullptr) return {};
  return paintedMasksOf(session_.history(), session_.pipeline().labels().table(), images->frame);
}

Result<std::vector<KeyFrameInfo>> SessionScan::keyFrames(bool all_frames) {
  std::vector<KeyFrameInfo> list;
  // A frame without colour does not stand for a place that another one shows with colour.
  KeyFrameChoice choice, with_color;
  const std::map<int, ReviewState> states = reviewStatesOf(session_.history());
  const auto isLeftOut = [&](const StoredFrame& kept) {
    return stateIn(states, kept.images->frame) == ReviewState::left_out;
  };
  for (const StoredFrame& kept : stored_) {
    if (!kept.images->color_file.empty() && !isLeftOut(kept)) with_color.takes(kept.frame->T_world_camera);
  }
  for (const StoredFrame& kept : stored_) {
    const bool is_replaced = kept.images->color_file.empty() && !with_color.isNew(kept.frame->T_world_camera);
    if (is_replaced && !all_frames) continue;
    // A frame that was left out does not stand for its place either.
    if (!isLeftOut(kept) && !choice.takes(kept.frame->T_world_camera) && !all_frames) continue;
    KeyFrameInfo info = infoOf(session_, *kept.images, *kept.frame);
    info.index = kept.index;
    info.review = stateIn(states, kept.images->frame);
    list.push_back(std::move(info));
  }
  return list;
}

Result<RgbdFrame> SessionScan::read(int index) {
  if (last_read_ && last_read_->first == index) return last_read_->second;
  const auto found = std::ranges::find(stored_, index, &StoredFrame::index);
  if (found == stored_.end())
    return fail(
        "No images of frame " + std::to_string(index) + " were kept in " + session_.folder().string() + ".",
        "");
  Result<RgbdFrame> frame = readKeyFrame(session_.folder(), *found->images, *found->frame);
  if (frame) last_read_.emplace(index, *frame);
  return frame;
}

Result<cv::Mat> SessionScan::color(int index) {
  Result<RgbdFrame> frame = read(index);
  if (!frame) return fail(frame.error());
  return frame->color;
}

Result<cv::Mat> SessionScan::depth(int index) {
  Result<RgbdFrame> frame = read(index);
  if (!frame) return fail(frame.error());
  return frame->depth;
}

Result<ViewOfMap> SessionScan::renderView(const Intrinsics& K, const Eigen::Isometry3d& T_world_camera) {
  const auto seen = session_.pipeline().readout().renderView(T_world_camera, K);
  if (!seen) return fail(seen.error());
  ViewOfMap view{cv::Mat(K.height, K.width, CV_32SC1), seen->depth().z_m};
  std::ranges::transform(seen->regions, view.regions.begin<int>(),
                         [](RegionId region) { return static_cast<int>(region.value); });
  return view;
}

std::uint32_t SessionScan::regionOf(std::uint32_t fragment) const {
  const std::vector<RegionId>& regions = session_.pipeline().labels().table().regions();
  return fragment < regions.size() ? regions[fragment].value : 0;
}

Result<LabeledMesh> SessionScan::mesh() {
  auto surface = session_.pipeline().readout().extractMesh();
  if (!surface) return fail(surface.error());
  LabeledMesh mesh;
  if (!*surface) return mesh;
  std::vector<bool> has_color;
  for (const SurfaceMesh::Vertex& vertex : (*surface)->vertices) {
    mesh.vertices.push_back({vertex.position, vertex.normal, vertex.color, regionOf(vertex.fragment.value)});
    has_color.push_back(vertex.has_color);
  }
  mesh.faces = std::move((*surface)->faces);
  fillUnknownColors(mesh, std::move(has_color));
  return mesh;
}

Result<void> SessionScan::forEachPoint(const std::function<void(const SurfacePoint&)>& give) {
  SCANTROVE_TRY(session_.pipeline().readout().forEachCloudPoint([&](const LabelPoint& point) {
    const auto byte = [](unsigned value) { return static_cast<std::uint8_t>(value); };
    give({{point.x, point.y, point.z},
          {point.normal_x, point.normal_y, point.normal_z},
          {byte(COLOR_RED(point.color)), byte(COLOR_GREEN(point.color)), byte(COLOR_BLUE(point.color))},
          regionOf(point.fragment)});
  }));
  session_.pipeline().labels().estimated().forEach([&](const Eigen::Vector3f& point, FragmentId fragment) {
    SurfacePoint estimated{.position_world_m = point, .rgb = kUnknownColor, .is_estimated = true};
    estimated.region = regionOf(fragment.value);
    if (estimated.region != 0) give(estimated);
  });
  return {};
}

Result<Trajectory> SessionScan::trajectory() {
  Trajectory trajectory;
  for (const SavedFrame& frame : session_.frames()) {
    if (frame.isUsable()) trajectory.push_back({frame.time_s, frame.T_world_camera});
  }
  return trajectory;
}

}  // namespace scantrove
