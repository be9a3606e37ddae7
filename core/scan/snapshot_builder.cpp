#include "core/scan/snapshot_builder.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <opencv2/imgproc.hpp>
#include <unordered_set>
#include <utility>

#include "core/editing/frame_review_states.h"
#include "core/fusion/kernels/color_voxel.h"

namespace scantrove {
namespace {
constexpr auto kMinInterval = std::chrono::milliseconds(80);
/// Voxels up to this distance from the surface, in voxels, are displayed. With less, slanted surfaces have
/// holes; with more, they are drawn in several layers.
constexpr float kHalfSheet = 0.6F;

std::int32_t number(std::uint32_t segment) { return static_cast<std::int32_t>(segment); }
std::int32_t number(RegionId region) { return static_cast<std::int32_t>(region.value); }

/// Ids as a CV_32SC1 image.
template <class Id>
cv::Mat idImage(const std::vector<Id>& ids, int width, int height) {
  if (ids.empty()) return {};
  cv::Mat image(height, width, CV_32SC1);
  std::transform(ids.begin(), ids.end(), image.begin<std::int32_t>(), [](Id id) { return number(id); });
  return image;
}

cv::Mat rawDepth(const RgbdFrame& frame, const Intrinsics& K) {
  if (frame.depth.empty()) return {};
  cv::Mat small;
  cv::resize(frame.depth, small, {K.width, K.height}, 0, 0, cv::INTER_NEAREST);
  small.convertTo(small, CV_32F, static_cast<double>(frame.meters_per_unit));
  return small;
}

/// Number of different regions in the image.
int countRegions(const RenderedView& view) {
  std::unordered_set<RegionId> in_view;
  RegionId last;
  for (const RegionId region : view.regions) {
    if (region != last && region) in_view.insert(region);
    last = region;
  }
  return static_cast<int>(in_view.size());
}

CloudBrick::Point cloudPoint(const LabelPoint& point) {
  CloudBrick::Point packed{point.x, point.y, point.z, FragmentId{point.fragment}};
  if (COLOR_WEIGHT(point.color) > 0) {
    packed.color = PackedColor::of(static_cast<std::uint8_t>(COLOR_RED(point.color)),
                                   static_cast<std::uint8_t>(COLOR_GREEN(point.color)),
                                   static_cast<std::uint8_t>(COLOR_BLUE(point.color)));
  }
  packed.height = static_cast<std::int8_t>(std::lround(point.height * CloudBrick::Point::kHeightSteps));
  packed.normal = PackedNormal::of({point.normal_x, point.normal_y, point.normal_z});
  return packed;
}

/// Without colour and normal. Every second voxel along each axis holds one, so that they look sparse. They
/// lie in the middle of a voxel, because the window thins out points by their voxels.
CloudBrick::Point estimatedPoint(const Eigen::Vector3f& center, FragmentId fragment, float voxel_size_m) {
  const Eigen::Vector3f place = center - Eigen::Vector3f::Constant(voxel_size_m / 2);
  return {place.x(), place.y(), place.z(), fragment};
}

}  // namespace

void SnapshotBuilder::measureRate() {
  const auto now = std::chrono::steady_clock::now();
  frame_times_.push_back(now);
  while (frame_times_.size() > 2 && now - frame_times_.front() > std::chrono::seconds(1))
    frame_times_.pop_front();
  const std::chrono::duration<double> span = now - frame_times_.front();
  if (span.count() > 0) fps_ = static_cast<double>(frame_times_.size() - 1) / span.count();
}

void SnapshotBuilder::addFrame(const MappingPipeline& pipeline, RgbdFrame frame, FrameResult result,
                               std::vector<SeenObject> objects) {
  measureRate();
  if (result.pose.usable()) {
    trail_.push_back(result.pose.T_world_camera.translation().cast<float>());
    if (!frame.color.empty()) last_seen_ = frame.color;
  }
  // A frame without colour shows the last image: devices may store fewer colour images than depth images.
  if (frame.color.empty()) frame.color = last_color_;
  last_color_ = frame.color;
  waiting_.beginFrame();
  addBricks(pipeline.touchedBricks());
  showFrame(std::move(frame), std::move(result), std::move(objects));
}

void SnapshotBuilder::addReviews(const MappingPipeline& pipeline, ScanSnapshot& snapshot) const {
  if (key_frames_ == nullptr) return;
  const std::map<int, ReviewState> states = reviewStatesOf(pipeline.labels().editor().log());
  auto reviews = std::make_shared<std::vector<FrameReview>>();
  for (std::size_t i = 0; i < key_frames_->size(); ++i)
    reviews->push_back({key_frame_numbers_[i], (*key_frames_)[i], stateIn(states, key_frame_numbers_[i])});
  snapshot.reviews = std::move(reviews);
}

void SnapshotBuilder::setKeyFrames(std::vector<int> key_frames, std::vector<int> numbers,
                                   std::vector<Eigen::Vector3f> trail) {
  key_frames_ = std::make_shared<const std::vector<int>>(std::move(key_frames));
  key_frame_numbers_ = std::move(numbers);
  trail_ = std::move(trail);
}

void SnapshotBuilder::addBricks(std::span<const Eigen::Vector3i> bricks) {
  if (has_pictures_) waiting_.add(bricks);
}

void SnapshotBuilder::restart(MappingPipeline& given_up) {
  addBricks(given_up.readout().allBricks());
  addBricks(given_up.labels().estimated().mapBricks());
  trail_.clear();
}

void SnapshotBuilder::keepRegionChanges(MappingPipeline& pipeline, bool by_person) {
  RegionTable& table = pipeline.labels().table();
  for (const FragmentId fragment : table.takeChanged())
    region_changes_.push_back({fragment, table.regionOf(fragment), by_person});
}

void SnapshotBuilder::endEdit(MappingPipeline& pipeline) {
  keepRegionChanges(pipeline, true);
  const std::vector<Eigen::Vector3i> edited = pipeline.labels().takeEditedBricks();
  if (has_pictures_) waiting_.addByPerson(edited);
}

Result<void> SnapshotBuilder::postWhenDue(MappingPipeline& pipeline, const ScanProgress& progress) {
  if (!mailbox_.empty() || std::chrono::steady_clock::now() - last_post_ < kMinInterval) return {};
  return post(pipeline, progress, Bricks::due);
}

Result<void> SnapshotBuilder::flush(MappingPipeline& pipeline, const ScanProgress& progress) {
  return post(pipeline, progress, Bricks::all);
}

Result<void> SnapshotBuilder::post(MappingPipeline& pipeline, const ScanProgress& progress, Bricks which) {
  auto snapshot = std::make_shared<ScanSnapshot>();
  snapshot->state = progress.state;
  snapshot->frame_index = frame_.index;
  snapshot->frames = progress.frames;
  snapshot->frames_total = progress.frames_total;
  snapshot->pose = result_.pose;
  snapshot->K = result_.view.K.width > 0 ? result_.view.K : pipeline.workingIntrinsics();
  if (has_pictures_) {
    addPictures(*snapshot);
    addRegions(pipeline, *snapshot);
  }
  snapshot->key_frames = key_frames_;
  snapshot->shown_key_frame = shown_key_frame_;
  addReviews(pipeline, *snapshot);
  SCANTROVE_TRY(addChangedBricks(pipeline, which, *snapshot));
  for (const StageTimer::Stage& stage : pipeline.timer().stages()) {
    snapshot->stage_times.push_back({stage.name, stage.last_ms});
  }
  snapshot->fps = fps_;
  snapshot->voxel_size_m = pipeline.bricks().voxelSize();
  snapshot->map_bricks = pipeline.bricks().brickCount();
  snapshot->map_megabytes = static_cast<double>(pipeline.bricks().device().bytes()) / (1 << 20);
  snapshot->region_count = countRegions(result_.view);
  last_post_ = std::chrono::steady_clock::now();
  mailbox_.post(std::move(snapshot));
  return {};
}

void SnapshotBuilder::addPictures(ScanSnapshot& snapshot) const {
  snapshot.trail = std::make_shared<const std::vector<Eigen::Vector3f>>(trail_);
  snapshot.color = frame_.color;
  const bool may_continue = snapshot.state == ScanState::scanning || snapshot.state == ScanState::paused;
  if (may_continue && !result_.pose.usable()) snapshot.last_seen = last_seen_;
  snapshot.depth_raw_m = rawDepth(frame_, snapshot.K);
  snapshot.depth_fused_m = result_.view.depth().z_m;
  snapshot.segments = idImage(result_.segments.ids, result_.segments.width, result_.segments.height);
  snapshot.regions = idImage(result_.view.regions, result_.view.K.width, result_.view.K.height);
  snapshot.objects = objects_;
  if (labels_.describe) std::ranges::for_each(snapshot.objects, labels_.describe);
}

void SnapshotBuilder::addRegions(MappingPipeline& pipeline, ScanSnapshot& snapshot) const {
  if (frame_.color_camera && !result_.view.vertices_world.empty()) {
    snapshot.color_places = locateInColor(frame_.color_camera, result_.view).places;
  }
  struct RegionTotal {
    std::int64_t voxels = 0;
    ViewCoverage seen_from;
    SupportPixels support_pixels;
  };
  std::map<RegionId, RegionTotal> regions;
  const RegionTable& table = pipeline.labels().table();
  const std::vector<RegionId>& region_of = table.regions();
  const std::vector<cl_int>& of_fragment = pipeline.labels().voxelsOfFragments();
  for (std::size_t fragment = 1; fragment < std::min(region_of.size(), of_fragment.size()); ++fragment) {
    if (!region_of[fragment] || of_fragment[fragment] <= 0) continue;
    RegionTotal& total = regions[region_of[fragment]];
    const FragmentId id{static_cast<std::uint32_t>(fragment)};
    total.voxels += of_fragment[fragment];
    total.seen_from.add(table.seenFrom(id));
    total.support_pixels += table.supportPixels(id);
  }
  const std::map<RegionId, RegionLabel> labels =
      labels_.of_regions ? labels_.of_regions() : std::map<RegionId, RegionLabel>();
  auto infos = std::make_shared<RegionInfos>();
  infos->reserve(regions.size());
  for (const auto& [region, total] : regions) {
    const auto found = labels.find(region);
    const RegionLabel label = found == labels.end() ? RegionLabel{} : found->second;
    const RegionNote& note = pipeline.labels().editor().notes().of(region);
    infos->push_back({region, total.voxels, note, label.object, total.seen_from, label,
                      isProposedBackground(total.support_pixels, note, label)});
  }
  snapshot.region_infos = std::move(infos);
  auto operations = std::make_shared<std::vector<DoneOperation>>();
  for (const OperationLog::Entry& entry : pipeline.labels().editor().log().entries()) {
    const Operation& operation = entry.operation;
    operations->push_back({entry.number, operation.kind, operation.regions, operation.name, operation.on,
                           entry.state, operation.review});
  }
  snapshot.operations = std::move(operations);
}

Result<void> SnapshotBuilder::readBricks(MappingPipeline& pipeline,
                                         std::span<const WaitingBricks::Brick> bricks,
                                         std::vector<CloudBrick>& to) {
  if (bricks.empty()) return {};
  std::vector<Eigen::Vector3i> positions;
  positions.reserve(bricks.size());
  for (const WaitingBricks::Brick& brick : bricks) positions.push_back(brick.position);
  const Result<LabelCloud::Extract> extract = pipeline.readout().extractCloud(positions);
  if (!extract) {
    waiting_.add(positions);
    return fail(extract.error());
  }
  for (std::size_t i = 0; i < bricks.size(); ++i) {
    const std::span points =
        std::span(extract->points).subspan(extract->first[i], extract->first[i + 1] - extract->first[i]);
    const auto is_shown = [](const LabelPoint& point) { return std::abs(point.height) <= kHalfSheet; };
    CloudBrick brick;
    brick.position = bricks[i].position;
    brick.version = version_;
    brick.by_person = bricks[i].by_person;
    brick.points.reserve(static_cast<std::size_t>(std::ranges::count_if(points, is_shown)));
    for (const LabelPoint& point : points) {
      if (is_shown(point)) brick.points.push_back(cloudPoint(point));
    }
    pipeline.labels().estimated().forEachIn(
        brick.position, [&](const Eigen::Vector3f& center, FragmentId fragment) {
          brick.points.push_back(estimatedPoint(center, fragment, pipeline.bricks().voxelSize()));
        });
    to.push_back(std::move(brick));
  }
  return {};
}

Result<void> SnapshotBuilder::addChangedBricks(MappingPipeline& pipeline, Bricks which,
                                               ScanSnapshot& snapshot) {
  ++version_;
  addBricks(pipeline.labels().estimated().takeChangedMapBricks());
  std::vector<CloudBrick> changed;
  std::vector<WaitingBricks::Brick> bricks;
  do {
    bricks = which == Bricks::all ? waiting_.takeAny(kMaxBricks) : waiting_.takeDue(kMaxBricks);
    SCANTROVE_TRY(readBricks(pipeline, bricks, changed));
  } while (which == Bricks::all && bricks.size() == kMaxBricks);
  // The content of a snapshot that was never taken goes with this one.
  if (const auto uncollected = mailbox_.collect()) {
    snapshot.changed_bricks = uncollected->changed_bricks;
    snapshot.changed_regions = uncollected->changed_regions;
  }
  std::ranges::move(changed, std::back_inserter(snapshot.changed_bricks));
  keepRegionChanges(pipeline, false);
  std::ranges::move(std::exchange(region_changes_, {}), std::back_inserter(snapshot.changed_regions));
  return {};
}

}  // namespace scantrove
