#include "core/dataset/key_frame_images.h"

#include <spdlog/fmt/fmt.h>

#include <algorithm>
#include <map>
#include <opencv2/core.hpp>
#include <set>
#include <utility>

#include "core/base/regular_file.h"
#include "core/dataset/aligned_view.h"
#include "core/dataset/frame_choice.h"
#include "core/dataset/frame_fitness.h"
#include "core/dataset/painted_masks.h"
#include "core/dataset/region_choice.h"
#include "core/dataset/region_masks.h"
#include "core/dataset/registered_depth.h"
#include "core/image/color_bytes.h"
#include "core/image/image_file.h"
#include "core/image/image_header.h"
#include "core/image/jpeg_encoder.h"
#include "core/image/png_encoder.h"

namespace scantrove {
namespace {

std::string nameOf(const KeyFrameInfo& frame) { return "Key frame " + std::to_string(frame.index); }

Result<void> checkSize(const cv::Mat& image, const Intrinsics& K, const KeyFrameInfo& frame,
                       const char* kind) {
  if (image.cols == K.width && image.rows == K.height && K.width > 0) return {};
  return fail(fmt::format("{}: its {} image is {} x {}, its camera {} x {}.", nameOf(frame), kind, image.cols,
                          image.rows, K.width, K.height));
}

/// The recorded bytes without an orientation if every program decodes them alike; else a PNG.
Result<void> takeImage(LabeledImage& image, const cv::Mat& color) {
  auto bytes = readFile(image.frame.color_file);
  if (!bytes) return fail(bytes.error());
  const std::span view(reinterpret_cast<const std::uint8_t*>(bytes->data()), bytes->size());
  const bool is_kept = isPlainColor(view);
  const bool is_jpeg = is_kept && imageFormat(view) == ImageFormat::jpeg;
  image.image_bytes = is_kept ? withoutOrientation(std::move(*bytes)) : encodePng(color);
  image.image_name = image.stem + (is_jpeg ? ".jpg" : ".png");
  return {};
}

Result<cv::Mat> decodedImage(const LabeledImage& image) {
  return decodeColorImage(
      {reinterpret_cast<const std::uint8_t*>(image.image_bytes.data()), image.image_bytes.size()},
      image.frame.color_file.string());
}

void keepOnly(cv::Mat& regions, const std::unordered_set<int>& kept) {
  int last = 0;
  bool is_kept = false;
  for (int y = 0; y < regions.rows; ++y) {
    auto* row = regions.ptr<int>(y);
    for (int x = 0; x < regions.cols; ++x) {
      if (row[x] == 0) continue;
      if (row[x] != last) is_kept = kept.contains(last = row[x]);
      if (!is_kept) row[x] = 0;
    }
  }
}

/// With the scan, if there are several.
std::string nameIn(const ExportJob& job, const KeyFrameInfo& frame) {
  return (job.scans().isProject() ? job.part().name + ": " : "") + nameOf(frame);
}

bool ignoresUnlabeled(const ExportOptions& options) {
  return options.choices.unlabeled == UnlabeledObjects::ignore && hasIgnoreRegions(options.format);
}

/// Moves the regions to ignore from the labels into a mask of their own.
void takeIgnored(LabeledImage& image, const std::unordered_set<int>& ignored) {
  image.ignored = cv::Mat::zeros(image.regions.size(), CV_8UC1);
  for (int y = 0; y < image.regions.rows && !ignored.empty(); ++y) {
    auto* row = image.regions.ptr<int>(y);
    auto* mask = image.ignored.ptr(y);
    for (int x = 0; x < image.regions.cols; ++x) {
      if (row[x] == 0 || !ignored.contains(row[x])) continue;
      mask[x] = 255;
      row[x] = 0;
    }
  }
}

/// Whether scans share folders of images. Those of BOP are scenes.
bool hasPrefixes(DatasetFormat format) { return joinsScans(format) && format != DatasetFormat::bop; }

void addPrefix(LabeledImage& image, const std::string& prefix) {
  if (prefix.empty()) return;
  image.stem = prefix + "_" + image.stem;
  if (!image.image_name.empty()) image.image_name = prefix + "_" + image.image_name;
}

/// Why frames are unfit, by their index. Error: cancelled.
Result<std::map<int, std::string>> findUnfit(ExportJob& job, const std::vector<KeyFrameInfo>& frames) {
  FrameFitness fitness;
  int done = 0;
  for (const KeyFrameInfo& frame : frames) {
    const std::string what = "checking frame " + std::to_string(frame.index);
    SCANTROVE_TRY(job.step(done++, 2 * static_cast<int>(frames.size()), what));
    if (frame.color_file.empty()) continue;
    const auto depth = job.scan().depth(frame.index);
    const auto color = job.scan().color(frame.index);
    const bool is_usable = depth && color && checkSize(*depth, frame.K_depth, frame, "depth") &&
                           checkSize(*color, frame.K_color, frame, "colour");
    if (is_usable) fitness.add(frame, *depth, *color);  // the export itself reports unusable frames
  }
  return fitness.unfit();
}

}  // namespace

Result<KeyFrameImage> readKeyFrameImage(LabeledScan& scan, const KeyFrameInfo& frame) {
  KeyFrameImage read;
  auto& [image, color] = read;
  image.frame = frame;
  image.stem = fmt::format("{:06}", frame.index);
  const auto depth = scan.depth(frame.index);
  if (!depth) return fail(depth.error());
  SCANTROVE_TRY(checkSize(*depth, frame.K_depth, frame, "depth"));
  if (frame.color_file.empty()) {
    image.K = frame.K_depth;
    image.T_world_camera = frame.T_world_depth;
    KeyFrameInfo alone = frame;
    alone.K_color = frame.K_depth;
    alone.T_color_depth.setIdentity();
    image.depth_m = registerDepth(alone, *depth);
  } else {
    SCANTROVE_TRY(moveInto(color, scan.color(frame.index)));
    SCANTROVE_TRY(checkSize(color, frame.K_color, frame, "colour"));
    SCANTROVE_TRY(takeImage(image, color));
    image.K = frame.K_color;
    image.T_world_camera = frame.colorCameraPose();
    image.depth_m = registerDepth(frame, *depth);
  }
  return read;
}

Result<void> labelImage(LabeledScan& scan, KeyFrameImage& read, const std::unordered_set<int>& kept) {
  LabeledImage& image = read.image;
  auto view = renderAligned(scan, image.K, image.T_world_camera, image.depth_m);
  if (!view) return fail(view.error());
  image.T_world_camera = view->T_world_camera;
  image.regions = refineRegions(view->map, {image.depth_m, read.color}, std::max(image.K.fx, image.K.fy));
  applyPaintedMasks(scan.paintedMasks(image.frame.index), image.regions);
  keepOnly(image.regions, kept);
  return {};
}

std::unordered_set<int> idsOf(const std::vector<LabeledRegion>& regions) {
  std::unordered_set<int> ids;
  for (const LabeledRegion& region : regions) ids.insert(static_cast<int>(region.id));
  return ids;
}

Result<std::vector<KeyFrameInfo>> framesToExport(ExportJob& job, bool needs_color) {
  if (job.frames()) return *job.frames();
  auto choice = chooseFrames(job.scan(), job.options());
  if (!choice) return fail(choice.error());
  std::vector<KeyFrameInfo>* const frames = &choice->frames;
  if (const std::string missing = choice->missing(); !missing.empty()) {
    if (frames->empty() && !job.scans().isProject()) {
      return fail("No image of the scan " + job.scan().name() + " can be exported: " + missing,
                  "Check key frames, or reopen them (scantrove session review --list).");
    }
    job.summary().notes.push_back(job.scans().isProject() ? job.scan().name() + ": " + missing : missing);
  }
  if (frames->empty() && !job.scans().isProject())
    return fail("The scan " + job.scan().name() + " has no key frames: there are no images to export.");
  std::vector<std::string>& skipped = job.summary().skipped;
  std::erase_if(*frames, [&](const KeyFrameInfo& frame) {
    const bool is_without = needs_color && frame.color_file.empty();
    if (is_without) skipped.push_back(nameIn(job, frame) + " has no colour image.");
    return is_without;
  });
  if (!job.options().include_unfit) {
    const auto unfit = findUnfit(job, *frames);
    if (!unfit) return fail(unfit.error());
    std::erase_if(*frames, [&](const KeyFrameInfo& frame) {
      const auto reason = unfit->find(frame.index);
      if (reason == unfit->end()) return false;
      skipped.push_back(nameIn(job, frame) + " was left out: " + reason->second + ".");
      ++job.summary().unfit;
      return true;
    });
  }
  job.frames() = *frames;
  return *frames;
}

Result<void> forEachLabeledImage(ExportJob& job, bool needs_color, const UseLabeledImage& use) {
  LabeledScan& scan = job.scan();
  const auto frames = framesToExport(job, needs_color);
  if (!frames) return fail(frames.error());
  const DatasetPart& part = job.part();
  std::unordered_set<int> ignored;
  if (ignoresUnlabeled(job.options())) ignored = idsOf(part.unlabeled);
  std::unordered_set<int> kept = idsOf(part.chosen);
  kept.insert(ignored.begin(), ignored.end());
  for (const LabeledRegion& region : part.chosen) job.counts().countOf(classOf(region));
  const auto total = static_cast<int>(frames->size());
  const int checked = job.options().include_unfit ? 0 : total;  // steps of findUnfit()
  const int before = job.summary().images;
  int done = 0;
  for (const KeyFrameInfo& frame : *frames) {
    SCANTROVE_TRY(job.step(checked + done++, checked + total, "frame " + std::to_string(frame.index)));
    auto read = readKeyFrameImage(scan, frame);
    if (!read) {
      job.summary().skipped.push_back(nameIn(job, frame) + " was left out: " + read.error().what);
      continue;
    }
    SCANTROVE_TRY(labelImage(scan, *read, kept));
    if (ignoresUnlabeled(job.options())) takeIgnored(read->image, ignored);
    if (hasPrefixes(job.options().format)) addPrefix(read->image, part.prefix);
    job.counts().beginImage(part.split);
    SCANTROVE_TRY(use(read->image));
    job.endImage();
  }
  if (job.summary().images > before) return {};
  if (job.scans().isProject()) {
    job.summary().notes.push_back("No key frame of the scan " + scan.name() + " can be used.");
    return {};
  }
  std::string advice = needs_color ? "Without colour, export masks, ply or mesh." : "";
  if (job.summary().unfit > 0) advice = "Export unfit frames, too (--include-unfit-frames).";
  return fail("No key frame of the scan " + scan.name() + " can be used. " + job.summary().skipped.front(),
              std::move(advice));
}

Result<std::string> asJpeg(const LabeledImage& image) {
  if (image.image_name.ends_with(".jpg")) return image.image_bytes;
  constexpr int kQuality = 95;
  const auto color = decodedImage(image);
  return color ? Result<std::string>(encodeJpeg(*color, kQuality)) : fail(color.error());
}

Result<std::string> asPng(const LabeledImage& image) {
  if (image.image_name.ends_with(".png")) return image.image_bytes;
  const auto color = decodedImage(image);
  return color ? Result<std::string>(encodePng(*color)) : fail(color.error());
}

std::vector<std::uint32_t> visibleRegions(const cv::Mat& regions) {
  std::set<std::uint32_t> ids;
  int last = 0;
  for (int y = 0; y < regions.rows; ++y) {
    const auto* row = regions.ptr<int>(y);
    for (int x = 0; x < regions.cols; ++x) {
      if (row[x] != last && row[x] != 0) ids.insert(static_cast<std::uint32_t>(row[x]));
      last = row[x];
    }
  }
  return {ids.begin(), ids.end()};
}

}  // namespace scantrove
