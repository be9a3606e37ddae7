#include "core/capture/phones/multiscan.h"

#include <algorithm>
#include <cstring>
#include <functional>
#include <optional>

#include "core/base/text.h"
#include "core/base/text_file.h"
#include "core/capture/deflated_frames.h"
#include "core/capture/folder_listing.h"
#include "core/capture/phones/device_files.h"
#include "core/capture/phones/device_metadata.h"
#include "core/capture/time_unit.h"
#include "core/capture/video_frames.h"
#include "core/image/image_header.h"
#include "core/image/metric_depth.h"

namespace scantrove {

namespace {

constexpr std::string_view kDepthStreamEnd = ".depth.zlib";

/// NAME of NAME.depth.zlib; empty if the folder has no such file.
std::string scanName(const std::vector<std::string>& names) {
  const auto depth = std::ranges::find_if(names, [](const std::string& name) {
    return name.size() > kDepthStreamEnd.size() && name.ends_with(kDepthStreamEnd);
  });
  return depth == names.end() ? std::string() : depth->substr(0, depth->size() - kDepthStreamEnd.size());
}

/// What NAME.json says about the streams.
struct MultiscanStreams {
  cv::Size depth{256, 192}, color{1920, 1440};
  bool is_depth_float = true;  ///< half-precision metres; else millimetres of two bytes
};

std::optional<cv::Size> resolutionOf(const nlohmann::json& stream) {
  const auto rows_columns = numbersOf(stream, "resolution", 2);
  if (!rows_columns) return std::nullopt;
  for (const double side : *rows_columns) {
    if (side < 1 || side > kLongestImageSide_px) return std::nullopt;
  }
  return cv::Size(static_cast<int>((*rows_columns)[1]), static_cast<int>((*rows_columns)[0]));
}

MultiscanStreams streamsOf(const nlohmann::json& json) {
  MultiscanStreams streams;
  streams.is_depth_float = textOf(json, "depth_unit") != "mm";
  if (!json.is_object() || !json.contains("streams") || !json.at("streams").is_array()) return streams;
  for (const nlohmann::json& stream : json.at("streams")) {
    const std::string extension = textOf(stream, "file_extension");
    const auto size = resolutionOf(stream);
    if (size && extension.find("depth.zlib") != std::string::npos) streams.depth = *size;
    if (size && extension.find("mp4") != std::string::npos) streams.color = *size;
  }
  return streams;
}

/// Streams of depth, confidence and colour, which have one frame each for every line.
class MultiscanImages {
 public:
  MultiscanImages(const std::filesystem::path& folder, const std::string& scan,
                  const MultiscanStreams& streams)
      : streams_(streams) {
    const auto pixels = static_cast<std::size_t>(streams.depth.area());
    depth_ = std::make_shared<DeflatedFrames>(folder / (scan + std::string(kDepthStreamEnd)), 2 * pixels);
    if (const auto file = fileIfPresent(folder / (scan + ".confidence.zlib")); !file.empty())
      confidence_ = std::make_shared<DeflatedFrames>(file, pixels);
    if (const auto file = fileIfPresent(folder / (scan + ".mp4")); !file.empty())
      video_ = std::make_shared<VideoFrames>(file);
  }

  void addTo(ImageSequenceEntry& entry) const {
    const int position = entry.index;
    entry.decode_depth = [depth = depth_, streams = streams_, position] {
      return depth->frame(position).map([&](const std::string& bytes) {
        cv::Mat image(streams.depth, streams.is_depth_float ? CV_16FC1 : CV_16UC1);
        std::memcpy(image.data, bytes.data(), bytes.size());
        if (!streams.is_depth_float) return image;
        cv::Mat metres;
        image.convertTo(metres, CV_32F);
        return withoutInvalidDepth(metres);
      });
    };
    if (confidence_) {
      entry.decode_confidence = [confidence = confidence_, size = streams_.depth, position] {
        return confidence->frame(position).map([&](const std::string& bytes) {
          cv::Mat image(size, CV_8UC1);
          std::memcpy(image.data, bytes.data(), bytes.size());
          return image;
        });
      };
    }
    if (video_) entry.decode_color = [video = video_, position] { return video->frame(position); };
  }

 private:
  MultiscanStreams streams_;
  std::shared_ptr<DeflatedFrames> depth_, confidence_;
  std::shared_ptr<VideoFrames> video_;
};

std::optional<ImageSequenceEntry> multiscanEntry(std::string_view line, const cv::Size& color_size,
                                                 int index) {
  const auto json = parseJson(line, "the line");
  const auto matrix = json ? numbersOf(*json, "intrinsics", 9) : std::nullopt;
  if (!matrix) return std::nullopt;
  ImageSequenceEntry entry;
  entry.index = index;
  entry.timestamp_s = numberOf(*json, "timestamp").value_or(0);
  entry.intrinsics = intrinsicsFromColumns(*matrix, color_size.width, color_size.height);
  if (const auto columns = numbersOf(*json, "transform", 16)) {
    const Eigen::Matrix4d T_world_camera = Eigen::Map<const Eigen::Matrix4d>(columns->data());
    const Eigen::Matrix<double, 4, 4, Eigen::RowMajor> rows = T_world_camera;
    entry.T_world_camera = fromArkitAxes(poseFromRows({rows.data(), 16}));
  }
  return entry;
}

/// Times are whole numbers of a unit that differs between versions of the app.
void setTimes(std::vector<ImageSequenceEntry>& entries) {
  std::vector<double> times;
  for (const ImageSequenceEntry& entry : entries) times.push_back(entry.timestamp_s);
  const bool is_sorted = std::ranges::adjacent_find(times, std::ranges::greater_equal()) == times.end();
  const TimeUnit unit = is_sorted ? unitOfImageTimes(times) : TimeUnit();
  for (ImageSequenceEntry& entry : entries)
    entry.timestamp_s = is_sorted ? entry.timestamp_s * unit.seconds : entry.index / kFrameRateHz;
}

}  // namespace

bool isMultiscanFolder(const std::vector<std::string>& names) {
  const std::string scan = scanName(names);
  return !scan.empty() && std::ranges::find(names, scan + ".jsonl") != names.end();
}

Result<ImageSequence> readMultiscanFolder(const std::filesystem::path& folder,
                                          const std::vector<std::string>& names) {
  const std::string scan = scanName(names);
  const std::filesystem::path lines_file = folder / (scan + ".jsonl"),
                              streams_file = folder / (scan + ".json");
  const auto json = readJson(streams_file);
  if (!json) return fail(json.error());
  const auto text = readTextFile(lines_file);
  if (!text) return fail(text.error());
  const MultiscanStreams streams = streamsOf(*json);
  SCANTROVE_TRY(checkImageSize(
      {static_cast<std::uint32_t>(streams.depth.width), static_cast<std::uint32_t>(streams.depth.height)},
      streams_file.string()));
  ImageSequence sequence;
  sequence.kind = "MultiScan";
  sequence.folder = folder;
  sequence.has_poses = true;
  sequence.is_color_optional = true;
  sequence.camera_origin = lines_file.string();
  const MultiscanImages images(folder, scan, streams);
  UnusableFrames unusable;
  int index = 0;
  for (const std::string_view line : splitLines(*text)) {
    if (trimmed(line).empty()) continue;
    auto entry = multiscanEntry(line, streams.color, index++);
    if (!entry) {
      unusable.add("line " + std::to_string(index) + " of " + lines_file.string() + " has no intrinsics.");
      continue;
    }
    images.addTo(*entry);
    sequence.entries.push_back(std::move(*entry));
  }
  unusable.warn(folderName(folder));
  if (sequence.entries.empty())
    return fail(lines_file.string() + " has no frame with intrinsics.", "Copy the whole folder of the scan.");
  setTimes(sequence.entries);
  return sequence;
}

}  // namespace scantrove
