#include "core/capture/phones/transforms_json.h"

#include <spdlog/spdlog.h>

#include <algorithm>
#include <cmath>
#include <cstring>
#include <opencv2/core.hpp>
#include <set>
#include <vector>

#include "core/base/regular_file.h"
#include "core/capture/depth_file.h"
#include "core/capture/folder_listing.h"
#include "core/capture/folder_pairs.h"
#include "core/capture/phones/device_files.h"
#include "core/capture/phones/device_metadata.h"
#include "core/image/metric_depth.h"
#include "core/image/png_decoder.h"

namespace scantrove {

namespace {

constexpr const char* kTransformsName = "transforms.json";

std::string depthNameOf(const nlohmann::json& frame) {
  const std::string name = textOf(frame, "depth_file_path");
  return name.empty() ? textOf(frame, "depth_path") : name;
}

bool hasFrames(const nlohmann::json& json) {
  return json.is_object() && json.contains("frames") && json.at("frames").is_array();
}

/// A value of the frame, else of the whole file.
std::optional<double> numberFor(const nlohmann::json& frame, const nlohmann::json& file, const char* key) {
  const auto own = numberOf(frame, key);
  return own ? own : numberOf(file, key);
}

/// nerfstudio counts from the corner of a pixel: centres lie at +0.5.
std::optional<Intrinsics> transformsIntrinsics(const nlohmann::json& frame, const nlohmann::json& file) {
  const auto width = sideOf(frame.contains("w") ? frame : file, "w"),
             height = sideOf(frame.contains("h") ? frame : file, "h");
  if (!width || !height) return std::nullopt;
  auto fx = numberFor(frame, file, "fl_x");
  if (const auto angle = numberFor(frame, file, "camera_angle_x"); !fx && angle)
    fx = *width / (2 * std::tan(*angle / 2));
  if (!fx) return std::nullopt;
  const double fy = numberFor(frame, file, "fl_y").value_or(*fx);
  const double cx = numberFor(frame, file, "cx").value_or(*width / 2.0) - 0.5,
               cy = numberFor(frame, file, "cy").value_or(*height / 2.0) - 0.5;
  return Intrinsics{static_cast<float>(*fx),
                    static_cast<float>(fy),
                    static_cast<float>(cx),
                    static_cast<float>(cy),
                    *width,
                    *height};
}

/// Metres for each unit of 16-bit depth.
double unitOf(const nlohmann::json& file) {
  for (const char* const key : {"integer_depth_scale", "depth_unit_scale_factor"}) {
    if (const auto unit = numberOf(file, key); unit && *unit > 0) return *unit;
  }
  return 0.001;
}

bool isRgbaPng(const std::filesystem::path& file) {
  constexpr std::size_t kHeaderBytes = 26, kBitDepthAt = 24, kColorTypeAt = 25;
  constexpr char kRgba = 6, kBits = 8;
  const auto start = readFile(file, kHeaderBytes);
  return start && start->size() == kHeaderBytes && start->starts_with("\x89PNG") &&
         (*start)[kBitDepthAt] == kBits && (*start)[kColorTypeAt] == kRgba;
}

/// Four bytes of a pixel are a float, metres. A picture of depth in four channels gives no plausible numbers.
Result<cv::Mat> readPackedFloats(const std::filesystem::path& file) {
  const auto bytes = readFile(file);
  if (!bytes) return fail(bytes.error());
  const auto image =
      decodeRgbaPng({reinterpret_cast<const std::uint8_t*>(bytes->data()), bytes->size()}, file.string());
  if (!image) return image;
  cv::Mat1f metres(image->size());
  std::memcpy(metres.data, image->data, image->total() * image->elemSize());
  constexpr float kNearest_m = 0.05F, kFarthest_m = 50;
  const cv::Mat plausible = (metres >= kNearest_m) & (metres <= kFarthest_m);
  if (cv::countNonZero(plausible) * 2 < static_cast<int>(metres.total()))
    return fail(file.string() + " is a picture of depth with 8 bits, not depth.",
                "Record with NeRFCapture's online mode, or with an app that exports depth in millimetres.");
  return withoutInvalidDepth(metres);
}

using DepthReader = Result<cv::Mat> (*)(const std::filesystem::path&);

/// Floating-point depth in millimetres.
Result<cv::Mat> readFloatMillimeters(const std::filesystem::path& file) {
  return readMetricDepth(file).map([](const cv::Mat& depth) { return cv::Mat(depth / 1000); });
}

/// The decoder of depth images like `file`; none: as the file has it (16-bit numbers or metres).
DepthReader decoderFor(const std::filesystem::path& file) {
  if (isRgbaPng(file)) return readPackedFloats;
  const auto depth = readAnyDepth(file);
  constexpr double kFarthestMean_m = 100;
  const bool is_float = depth && depth->type() == CV_32FC1;
  return is_float && cv::mean(*depth, *depth > 0)[0] > kFarthestMean_m ? readFloatMillimeters : nullptr;
}

/// Names may lack the extension (NeRFCapture).
std::filesystem::path colorFile(const std::filesystem::path& folder, const std::string& name) {
  if (name.empty()) return {};
  for (const char* const end : {"", ".png", ".jpg"}) {
    if (auto file = fileIfPresent(folder / (name + end)); !file.empty()) return file;
  }
  return {};
}

std::optional<ImageSequenceEntry> transformsEntry(const std::filesystem::path& folder,
                                                  const nlohmann::json& frame, const nlohmann::json& file) {
  const std::string depth = depthNameOf(frame);
  if (depth.empty()) return std::nullopt;
  ImageSequenceEntry entry;
  entry.depth = fileIfPresent(folder / depth);
  entry.intrinsics = transformsIntrinsics(frame, file);
  if (entry.depth.empty() || !entry.intrinsics) return std::nullopt;
  entry.color = colorFile(folder, textOf(frame, "file_path"));
  entry.timestamp_s = numberOf(frame, "timestamp").value_or(-1);
  if (const auto matrix = numbersOf(frame, "transform_matrix", 16)) {
    entry.T_world_camera = fromArkitAxes(poseFromRows(*matrix));
    const double scale = numberOf(file, "applied_scale").value_or(1);
    if (entry.T_world_camera && scale > 0) entry.T_world_camera->translation() /= scale;
  }
  return entry;
}

/// Between images without times, which were chosen for how much the camera moved. Taken as a video's, their
/// motion would be that of a device that jumps.
constexpr double kImageInterval_s = 0.5;

/// Orders frames by the numbers in their names, where these differ, and gives frames without times some.
void numberFrames(std::vector<ImageSequenceEntry>& entries) {
  std::set<int> numbers;
  for (ImageSequenceEntry& entry : entries) {
    const std::string stem = entry.depth.filename().string();
    entry.index = numberInName(stem, DigitRun::first).value_or(-1);
    numbers.insert(entry.index);
  }
  const bool are_unique = numbers.size() == entries.size() && *numbers.begin() >= 0;
  for (std::size_t i = 0; i < entries.size() && !are_unique; ++i) entries[i].index = static_cast<int>(i);
  std::ranges::stable_sort(entries, {}, &ImageSequenceEntry::index);
  const bool have_times =
      std::ranges::all_of(entries, [](const ImageSequenceEntry& entry) { return entry.timestamp_s >= 0; });
  for (ImageSequenceEntry& entry : entries) {
    if (!have_times) entry.timestamp_s = entry.index * kImageInterval_s;
  }
}

void warnOfLens(const nlohmann::json& file, const std::string& name) {
  for (const char* const key : {"k1", "k2", "p1", "p2"}) {
    if (std::abs(numberOf(file, key).value_or(0)) > 1e-4) {
      spdlog::warn("{}: its lens distortion ({} ...) is not corrected.", name, key);
      return;
    }
  }
}

}  // namespace

bool isTransformsFolder(const std::filesystem::path& folder) {
  if (fileIfPresent(folder / kTransformsName).empty()) return false;
  const auto json = readJson(folder / kTransformsName);
  if (!json || !hasFrames(*json)) return false;
  const nlohmann::json& frames = json->at("frames");
  return std::any_of(frames.begin(), frames.end(),
                     [](const nlohmann::json& frame) { return !depthNameOf(frame).empty(); });
}

Result<ImageSequence> readTransformsFolder(const std::filesystem::path& folder) {
  const std::filesystem::path file = folder / kTransformsName;
  const auto json = readJson(file);
  if (!json) return fail(json.error());
  ImageSequence sequence;
  sequence.kind = "transforms.json";
  sequence.folder = folder;
  sequence.has_poses = true;
  sequence.is_color_optional = true;
  sequence.camera_origin = file.string();
  if (hasFrames(*json)) {
    for (const nlohmann::json& frame : json->at("frames")) {
      if (auto entry = transformsEntry(folder, frame, *json)) sequence.entries.push_back(std::move(*entry));
    }
  }
  if (sequence.entries.empty())
    return fail(file.string() + " has no frame with a depth image that exists and a camera (fl_x, w, h).",
                "Copy the images beside it, in the folders that it names.");
  numberFrames(sequence.entries);
  warnOfLens(*json, folderName(folder));
  sequence.units_per_meter = 1 / unitOf(*json);
  if (const auto decoder = decoderFor(sequence.entries.front().depth)) {
    for (ImageSequenceEntry& entry : sequence.entries)
      entry.decode_depth = [decoder, depth = entry.depth] { return decoder(depth); };
  }
  return sequence;
}

}  // namespace scantrove
