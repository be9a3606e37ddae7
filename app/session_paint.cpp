#include "app/session_paint.h"

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <iostream>
#include <limits>
#include <map>
#include <opencv2/core.hpp>
#include <system_error>
#include <unordered_set>
#include <utility>

#include "app/command.h"
#include "app/json_output.h"
#include "app/session_edits.h"
#include "core/base/text.h"
#include "core/dataset/key_frame_images.h"
#include "core/editing/mask_tools.h"
#include "core/exchange/atomic_file.h"
#include "core/image/image_file.h"
#include "core/image/png_encoder.h"
#include "core/pipeline/mapping_pipeline.h"
#include "core/session/session_catalogue.h"
#include "core/session/session_scan.h"

namespace scantrove {
namespace {

/// Grey values above are painted.
constexpr int kPaintedAbove = 127;

Result<KeyFrameInfo> keyFrameOf(SessionScan& scan, const OpenSession& session, int frame) {
  const Result<std::vector<KeyFrameInfo>> frames = scan.keyFrames(true);
  if (!frames) return fail(frames.error());
  const auto found = std::ranges::find(*frames, frame, &KeyFrameInfo::index);
  if (found != frames->end()) return *found;
  return fail(
      "No image of frame " + std::to_string(frame) + " was kept in " + session.folder().string() + ".",
      "'scantrove export --format masks' writes the images of all key frames, with their numbers.");
}

std::string sizeInWords(const cv::Size& size) {
  return std::to_string(size.width) + " x " + std::to_string(size.height) + " pixels";
}

Result<cv::Mat> maskFromFile(const std::string& file, const cv::Size& size, int frame) {
  Result<cv::Mat> mask = readGrayImage(file);
  if (!mask) return fail(mask.error());
  if (mask->type() != CV_8UC1)
    return fail(file + " is no mask of 8 bits with one channel.", "Save it as a grey PNG of 8 bits.");
  if (mask->size() != size)
    return fail(file + " has " + sizeInWords(mask->size()) + ", the image of frame " + std::to_string(frame) +
                    " has " + sizeInWords(size) + ".",
                "Paint a mask of the image's size.");
  return cv::Mat(*mask > kPaintedAbove);
}

Result<cv::Mat> maskFromPolygons(const std::vector<std::string>& texts, const cv::Size& size) {
  std::vector<std::vector<cv::Point2f>> outlines;
  for (const std::string& text : texts) {
    const auto numbers = parseNumbers(text);
    const bool is_outline = numbers && numbers->size() >= 6 && numbers->size() % 2 == 0 &&
                            std::ranges::all_of(*numbers, [](double value) { return std::isfinite(value); });
    if (!is_outline)
      return fail("'" + forTerminal(text, 100) + "' is no polygon.",
                  "Write columns and rows of three points or more: x,y,x,y,x,y.");
    std::vector<cv::Point2f>& outline = outlines.emplace_back();
    for (std::size_t i = 0; i < numbers->size(); i += 2)
      outline.emplace_back(static_cast<float>((*numbers)[i]), static_cast<float>((*numbers)[i + 1]));
  }
  cv::Mat mask = cv::Mat::zeros(size, CV_8UC1);
  paintPolygon(mask, outlines, PaintMode::add);
  return mask;
}

/// Region ids as 16 bits. Error: one is larger.
Result<cv::Mat> inSixteenBits(const cv::Mat& regions) {
  cv::Mat image(regions.size(), CV_16UC1);
  for (int y = 0; y < regions.rows; ++y) {
    for (int x = 0; x < regions.cols; ++x) {
      const int region = regions.at<int>(y, x);
      if (region > std::numeric_limits<std::uint16_t>::max())
        return fail("Region " + std::to_string(region) + " does not fit into an image of 16 bits.",
                    "'scantrove export --format coco' has no such limit.");
      image.at<std::uint16_t>(y, x) = static_cast<std::uint16_t>(region);
    }
  }
  return image;
}

/// What the arguments say is painted, in the pixels of the frame's image.
struct PaintedFrame {
  KeyFrameInfo frame;
  cv::Mat mask;  ///< CV_8UC1
};

Result<PaintedFrame> paintedFrame(SessionScan& scan, const OpenSession& session,
                                  const SessionArguments& arguments) {
  const Result<KeyFrameInfo> frame = keyFrameOf(scan, session, arguments.frame);
  if (!frame) return fail(frame.error());
  const Intrinsics& K = frame->color_file.empty() ? frame->K_depth : frame->K_color;
  const cv::Size size(K.width, K.height);
  const Result<cv::Mat> mask = arguments.polygons.empty()
                                   ? maskFromFile(arguments.mask_file, size, arguments.frame)
                                   : maskFromPolygons(arguments.polygons, size);
  if (!mask) return fail(mask.error());
  return PaintedFrame{*frame, *mask};
}

/// A correction of the frame's image.
MaskCorrection correctionIn(const SessionScan& scan, const SessionArguments& arguments, const cv::Mat& added,
                            const cv::Mat& removed) {
  MaskCorrection correction = correctionOf(added, removed);
  correction.key_frame = scan.keyFrameOf(arguments.frame)->frame;
  correction.image = arguments.frame;
  return correction;
}

/// The key frame with all its regions.
Result<KeyFrameImage> labeledFrame(SessionScan& scan, OpenSession& session, const KeyFrameInfo& frame) {
  Result<KeyFrameImage> image = readKeyFrameImage(scan, frame);
  if (!image) return image;
  std::unordered_set<int> all;
  for (const RegionId region : session.pipeline().labels().table().regions())
    all.insert(static_cast<int>(region.value));
  SCANTROVE_TRY(labelImage(scan, *image, all));
  return image;
}

/// The region that most painted pixels show; none: they show none.
RegionId regionUnder(const cv::Mat& mask, const cv::Mat& regions) {
  std::map<int, int> pixels;
  for (int y = 0; y < mask.rows; ++y) {
    for (int x = 0; x < mask.cols; ++x) {
      if (mask.at<std::uint8_t>(y, x) != 0 && regions.at<int>(y, x) != 0) ++pixels[regions.at<int>(y, x)];
    }
  }
  const auto most = std::ranges::max_element(pixels, {}, [](const auto& count) { return count.second; });
  return most == pixels.end() ? RegionId{} : RegionId{static_cast<std::uint32_t>(most->first)};
}

}  // namespace

Result<void> paintRegion(OpenSession& session, const SessionArguments& arguments) {
  SessionScan scan(session);
  const Result<PaintedFrame> painted = paintedFrame(scan, session, arguments);
  if (!painted) return fail(painted.error());
  const cv::Mat nothing = cv::Mat::zeros(painted->mask.size(), CV_8UC1);
  Operation operation{.kind = OperationKind::paint};
  for (const std::uint32_t region : arguments.regions) operation.regions.push_back(RegionId{region});
  operation.correction = correctionIn(scan, arguments, arguments.paint_removes ? nothing : painted->mask,
                                      arguments.paint_removes ? painted->mask
                                      : arguments.paint_sets  ? cv::Mat(painted->mask == 0)
                                                              : nothing);
  operation.correction->this_image_only = arguments.this_image_only;
  return performEdit(session, arguments, operation);
}

Result<void> paintNewRegion(OpenSession& session, const SessionArguments& arguments) {
  Operation naming{
      .kind = OperationKind::name, .name = arguments.name, .category = arguments.category.value_or("")};
  SCANTROVE_TRY(moveInto(naming, withCheckedNames(naming)));
  SessionScan scan(session);
  const Result<PaintedFrame> painted = paintedFrame(scan, session, arguments);
  if (!painted) return fail(painted.error());
  const Result<KeyFrameImage> image = labeledFrame(scan, session, painted->frame);
  if (!image) return fail(image.error());
  const RegionId under = regionUnder(painted->mask, image->image.regions);
  if (!under) return fail("The painted pixels show no region.", "Paint something that was scanned.");
  Operation operation{.kind = OperationKind::paint, .regions = {under}};
  operation.correction = correctionIn(scan, arguments, painted->mask, painted->mask == 0);
  operation.correction->makes_region = true;
  const auto outcome = session.edit(operation);
  if (outcome && !naming.name.empty()) {
    naming.regions = {outcome->regions.front()};
    session.setMetadata(sessionOnlyKeyOf(naming.regions.front()),
                        arguments.without_catalogue ? naming.name : "");
    const auto named = session.edit(naming);
    if (!named) return fail(named.error());
  }
  if (outcome) updateCatalogue(session, arguments);
  return reportEdit(outcome, arguments);
}

Result<void> unpaintRegion(OpenSession& session, const SessionArguments& arguments) {
  SessionScan scan(session);
  const Result<KeyFrameInfo> frame = keyFrameOf(scan, session, arguments.frame);
  if (!frame) return fail(frame.error());
  const Intrinsics& K = frame->color_file.empty() ? frame->K_depth : frame->K_color;
  const cv::Mat nothing = cv::Mat::zeros(K.height, K.width, CV_8UC1);
  Operation operation{.kind = OperationKind::unpaint};
  for (const std::uint32_t region : arguments.regions) operation.regions.push_back(RegionId{region});
  operation.correction = correctionIn(scan, arguments, nothing, nothing);
  return performEdit(session, arguments, operation);
}

Result<void> writeMasksOfImage(OpenSession& session, const SessionArguments& arguments) {
  std::error_code ignored;
  if (std::filesystem::symlink_status(arguments.out, ignored).type() != std::filesystem::file_type::not_found)
    return fail(arguments.out + " exists already.", "Name a new file with --out.");
  SessionScan scan(session);
  const Result<KeyFrameInfo> frame = keyFrameOf(scan, session, arguments.frame);
  if (!frame) return fail(frame.error());
  const Result<KeyFrameImage> image = labeledFrame(scan, session, *frame);
  if (!image) return fail(image.error());
  const Result<cv::Mat> numbers = inSixteenBits(image->image.regions);
  if (!numbers) return fail(numbers.error());
  SCANTROVE_TRY(writeFileAtomically(arguments.out, encodePng(*numbers)));
  const std::vector<std::uint32_t> regions = visibleRegions(image->image.regions);
  if (arguments.json) {
    printJson({{"file", arguments.out},
               {"size", {numbers->cols, numbers->rows}},
               {"regions", regions},
               {"painted", !scan.paintedMasks(arguments.frame).empty()}});
  } else {
    std::cout << "masks    " << inLine(arguments.out) << ", " << sizeInWords(numbers->size()) << ", "
              << regions.size() << " regions\n";
  }
  return {};
}

}  // namespace scantrove
