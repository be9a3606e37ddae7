#include "app/session_paint.h"

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <iostream>
#include <limits>
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

}  // namespace

Result<void> paintRegion(OpenSession& session, const SessionArguments& arguments) {
  SessionScan scan(session);
  const Result<KeyFrameInfo> frame = keyFrameOf(scan, session, arguments.frame);
  if (!frame) return fail(frame.error());
  const Intrinsics& K = frame->color_file.empty() ? frame->K_depth : frame->K_color;
  const cv::Size size(K.width, K.height);
  const Result<cv::Mat> painted = arguments.polygons.empty()
                                      ? maskFromFile(arguments.mask_file, size, arguments.frame)
                                      : maskFromPolygons(arguments.polygons, size);
  if (!painted) return fail(painted.error());
  const cv::Mat nothing = cv::Mat::zeros(size, CV_8UC1);
  Operation operation{.kind = OperationKind::paint};
  for (const std::uint32_t region : arguments.regions) operation.regions.push_back(RegionId{region});
  operation.correction = correctionOf(arguments.paint_removes ? nothing : *painted,
                                      arguments.paint_removes ? *painted
                                      : arguments.paint_sets  ? cv::Mat(*painted == 0)
                                                              : nothing);
  operation.correction->key_frame = scan.keyFrameOf(arguments.frame)->frame;
  operation.correction->image = arguments.frame;
  operation.correction->this_image_only = arguments.this_image_only;
  return performEdit(session, arguments, operation);
}

Result<void> writeMasksOfImage(OpenSession& session, const SessionArguments& arguments) {
  std::error_code ignored;
  if (std::filesystem::symlink_status(arguments.out, ignored).type() != std::filesystem::file_type::not_found)
    return fail(arguments.out + " exists already.", "Name a new file with --out.");
  SessionScan scan(session);
  const Result<KeyFrameInfo> frame = keyFrameOf(scan, session, arguments.frame);
  if (!frame) return fail(frame.error());
  Result<KeyFrameImage> image = readKeyFrameImage(scan, *frame);
  if (!image) return fail(image.error());
  std::unordered_set<int> all;
  for (const RegionId region : session.pipeline().labels().table().regions())
    all.insert(static_cast<int>(region.value));
  SCANTROVE_TRY(labelImage(scan, *image, all));
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
