#include "core/session/region_views.h"

#include <algorithm>
#include <functional>
#include <map>
#include <optional>
#include <utility>

#include "core/catalogue/view_descriptor.h"
#include "core/collection/candidate_crop.h"
#include "core/discovery/region_candidate.h"
#include "core/fusion/color_projection.h"
#include "core/geometry/view_sphere.h"
#include "core/pipeline/mapping_pipeline.h"
#include "core/session/key_frame_choice.h"
#include "core/session/key_frame_files.h"

namespace scantrove {
namespace {

/// Width at which key frames are rendered, and the minimum number of a region's pixels for a view.
constexpr int kSmallWidth_px = 160, kMinPixels = 8;
/// Weight of a region's pixels if the image's border cuts it off.
constexpr float kCropFraction = 0.4F;
/// Minimum worth of a view, relative to the best one.
constexpr float kMinOfBest = 0.2F;
constexpr float kBetweenViews_deg = 20;

/// A key frame that shows the region.
struct Showing {
  const SavedKeyFrame* images;
  const SavedFrame* frame;
  float worth = 0;  ///< pixels, reduced if cut off
  Eigen::Vector3f direction = Eigen::Vector3f::Zero();
};

bool isCutOff(const cv::Rect& box, const Intrinsics& K) {
  return box.x <= 0 || box.y <= 0 || box.br().x >= K.width || box.br().y >= K.height;
}

Result<std::vector<Showing>> framesThatShow(OpenSession& session, RegionId region) {
  std::map<int, const SavedFrame*> frames;
  for (const SavedFrame& frame : session.frames()) frames[frame.number] = &frame;
  std::vector<Showing> showing;
  KeyFrameChoice choice;  // a session may have the images of every frame
  for (const SavedKeyFrame& key : session.keyFrames()) {
    const auto found = frames.find(key.frame);
    if (found == frames.end() || !found->second->isUsable() || key.color_file.empty()) continue;
    const Eigen::Isometry3d& T_world_camera = found->second->T_world_camera;
    const Intrinsics K = session.intrinsicsOf(*found->second);
    const Intrinsics small = K.resizedTo(kSmallWidth_px, std::max(1, kSmallWidth_px * K.height / K.width));
    if (!choice.takes(T_world_camera)) continue;
    const Result<RenderedView> view = session.pipeline().readout().renderView(T_world_camera, small);
    if (!view) return fail(view.error());
    const std::optional<Candidate> seen = candidateOf(region, {*view}, kMinPixels);
    if (!seen) continue;
    const auto pixels = static_cast<float>(seen->pixels);
    showing.push_back({&key, found->second, isCutOff(seen->box_px, small) ? kCropFraction * pixels : pixels,
                       directionOf(*seen, T_world_camera)});
  }
  std::ranges::stable_sort(showing, std::greater<>(), &Showing::worth);
  return showing;
}

/// None: its images cannot be read, or do not show the region.
Result<std::optional<ObjectView>> cropFrom(OpenSession& session, const Showing& showing, RegionId region) {
  const Result<RgbdFrame> frame = readKeyFrame(session.folder(), *showing.images, *showing.frame);
  if (!frame || frame->color.empty()) return std::nullopt;
  const Intrinsics K = session.pipeline().workingIntrinsicsOf(showing.frame->intrinsics);
  const Result<RenderedView> view = session.pipeline().readout().renderView(showing.frame->T_world_camera, K);
  if (!view) return fail(view.error());
  const std::optional<Candidate> seen = candidateOf(region, {*view}, kMinPixels);
  if (!seen) return std::nullopt;
  const SurfaceInColor in_color = locateInColor(frame->color_camera, *view);
  std::optional<ObjectView> cut = cropView(*frame, view->T_world_camera, in_color, *seen);
  if (cut) cut->descriptor = describeView(cut->color, cut->mask);
  return cut;
}

}  // namespace

Result<std::vector<ObjectView>> viewsOfRegion(OpenSession& session, RegionId region, std::size_t most) {
  const Result<std::vector<Showing>> showing = framesThatShow(session, region);
  if (!showing) return fail(showing.error());
  std::vector<ObjectView> views;
  ViewSphere directions;
  float best = 0;
  for (const Showing& one : *showing) {
    if (views.size() >= most || one.worth < kMinOfBest * best) break;
    if (!directions.isNew(one.direction, kBetweenViews_deg)) continue;
    Result<std::optional<ObjectView>> view = cropFrom(session, one, region);
    if (!view) return fail(view.error());
    if (!*view) continue;
    best = std::max(best, one.worth);
    directions.keep(one.direction);
    views.push_back(std::move(**view));
  }
  return views;
}

}  // namespace scantrove
