#include "app/nyu2_scan.h"

#include <algorithm>
#include <memory>
#include <type_traits>
#include <utility>

#include "core/capture/folder_listing.h"
#include "core/capture/nyu_raw_folder.h"
#include "core/pipeline/mapping_pipeline.h"
#include "core/segmentation/upsample_segments.h"

namespace scantrove {
namespace {

namespace fs = std::filesystem;

std::string nameOf(const NyuOrigin& origin) { return fs::path(origin.depth_file).filename().string(); }

template <class Id>
cv::Mat1i imageOf(const std::vector<Id>& ids, const cv::Size& size) {
  cv::Mat1i image(size, 0);
  std::ranges::transform(ids, image.begin(), [](Id id) {
    if constexpr (std::is_same_v<Id, RegionId>) {
      return static_cast<int>(id.value);
    } else {
      return static_cast<int>(id);
    }
  });
  return image;
}

Nyu2Outcome compare(const FrameResult& result, const RgbdFrame& frame, const cv::Mat1i& truth) {
  const SegmentMap& segments = result.segments;
  const DepthUpsampler upsampler(segments.depths_m, segments.width, segments.height,
                                 {frame.depth.cols,
                                  frame.depth.rows,
                                  {frame.depth.ptr<std::uint16_t>(), frame.depth.total()},
                                  frame.meters_per_unit});
  return {nyu2Error(imageOf(upsampler.apply(segments.ids), truth.size()), truth),
          nyu2Error(imageOf(upsampler.apply(result.view.regions), truth.size()), truth)};
}

}  // namespace

Result<Nyu2Videos> Nyu2Videos::open(const fs::path& root) {
  Nyu2Videos videos;
  SCANTROVE_TRY(moveInto(videos.scenes_, nyuSceneFolders(root)));
  return videos;
}

fs::path Nyu2Videos::folderOf(const NyuOrigin& origin) const {
  // A scene of the labels may consist of several folders: basement_0001 of basement_0001a and _0001b. The
  // name of the depth image has the right one.
  const std::string parent = fs::path(origin.depth_file).parent_path().filename().string();
  for (const std::string& name : {parent, origin.scene}) {
    if (const auto found = scenes_.find(name); found != scenes_.end()) return found->second;
  }
  return {};
}

Result<Nyu2Clip> Nyu2Videos::read(const NyuOrigin& origin, int frames) {
  const fs::path folder = folderOf(origin);
  if (folder.empty()) return fail("The raw data has no folder of the scene " + origin.scene + ".");
  if (folder != folder_) {
    folder_.clear();
    SCANTROVE_TRY(moveInto(names_, listFolder(folder)));
    pairs_ = nyuRawPairs(names_);
    folder_ = folder;
  }
  const auto labeled = std::ranges::find(pairs_, nameOf(origin), &NyuRawPair::depth);
  if (labeled == pairs_.end())
    return fail("The labelled frame " + (folder / nameOf(origin)).string() + " is missing.");
  const int last = static_cast<int>(labeled - pairs_.begin());
  SourceOptions options;
  options.start = std::max(0, last - frames + 1);
  options.frames = last - options.start + 1;
  auto source = openNyuRawFolder(folder, names_, options);
  if (!source) return fail(source.error());
  Nyu2Clip clip;
  clip.K = (*source)->info().intrinsics;
  while (true) {
    FrameRead read = (*source)->next();
    if (read.status == FrameRead::Status::end) break;
    if (read.status == FrameRead::Status::failed) return fail(read.error);
    if (read.status == FrameRead::Status::skipped) clip.skipped.push_back(read.error.message());
    if (read.status == FrameRead::Status::frame) clip.frames.push_back(std::move(read.frame));
  }
  if (clip.frames.empty() || clip.frames.back().index != last) {
    return fail("The labelled frame " + (folder / nameOf(origin)).string() +
                " cannot be used: " + (clip.skipped.empty() ? "it cannot be read." : clip.skipped.back()));
  }
  return clip;
}

Result<std::optional<Nyu2Outcome>> scanNyu2Clip(ComputeContext& compute, const ScanParams& params,
                                                const Intrinsics& K, std::span<const RgbdFrame> frames,
                                                const cv::Mat1i& truth, bool (*is_stopped)()) {
  MappingPipeline::Setup setup{K, params};
  setup.frame_count = static_cast<int>(frames.size());
  const auto pipeline = MappingPipeline::create(compute, setup);
  if (!pipeline) return fail(pipeline.error());
  std::optional<FrameResult> last;
  for (const RgbdFrame& frame : frames) {
    if (is_stopped()) return std::nullopt;
    auto result = (*pipeline)->processFrame(frame);
    if (!result) return fail(result.error());
    (*pipeline)->timer().endFrame();
    last = std::move(*result);
  }
  if (!last || !last->pose.usable()) return std::nullopt;
  return compare(*last, frames.back(), truth);
}

}  // namespace scantrove
