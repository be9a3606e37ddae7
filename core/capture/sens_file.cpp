#include "core/capture/sens_file.h"

#include <libdeflate.h>
#include <spdlog/spdlog.h>

#include <algorithm>
#include <array>
#include <bit>
#include <cstring>
#include <fstream>
#include <functional>
#include <opencv2/imgproc.hpp>

#include "core/base/regular_file.h"
#include "core/capture/folder_listing.h"
#include "core/capture/image_sequence.h"
#include "core/capture/pose_files.h"
#include "core/capture/rig_cameras.h"
#include "core/capture/time_unit.h"
#include "core/image/image_file.h"
#include "core/image/image_header.h"

namespace scantrove {
namespace {

static_assert(std::endian::native == std::endian::little, "the file's numbers are little endian");

constexpr std::uint32_t kSensVersion = 4;
constexpr std::uint64_t kLongestSensorName = 1 << 16;
/// Raw colour of the largest image that is read, and more than any compressed image.
constexpr std::uint64_t kMaxSensImageBytes = 3 * kMaxImagePixels;
/// More than four hours; a damaged file of empty frames may claim any number.
constexpr std::size_t kMaxSensFrames = 500'000;
constexpr std::size_t kFrameHeaderBytes = 16 * 4 + 4 * 8;

enum class ColorCoding : std::int32_t { raw = 0, png = 1, jpeg = 2 };
enum class DepthCoding : std::int32_t { raw = 0, zlib = 1, occi = 2 };

/// Bytes of the file at any place. One thread.
class SensBytes {
 public:
  SensBytes(const std::filesystem::path& file, std::uint64_t size)
      : stream_(file, std::ios::binary), size_(size) {}

  [[nodiscard]] std::uint64_t size() const { return size_; }
  /// Whether all of `count` bytes were read.
  bool read(std::uint64_t at, void* to, std::uint64_t count) {
    if (at > size_ || count > size_ - at) return false;
    stream_.clear();
    stream_.seekg(static_cast<std::streamoff>(at));
    stream_.read(static_cast<char*>(to), static_cast<std::streamsize>(count));
    return stream_.good() && stream_.gcount() == static_cast<std::streamsize>(count);
  }

 private:
  std::ifstream stream_;
  std::uint64_t size_;
};

/// Reads values one after another; missing ones are zero.
class SensCursor {
 public:
  SensCursor(SensBytes& bytes, std::uint64_t at) : bytes_(bytes), at_(at) {}

  template <class T>
  [[nodiscard]] T get() {
    T value{};
    is_ok_ = is_ok_ && bytes_.read(at_, &value, sizeof value);
    at_ += sizeof value;
    return is_ok_ ? value : T{};
  }
  [[nodiscard]] Eigen::Matrix4d matrix() {
    const auto values = get<std::array<float, 16>>();
    return Eigen::Map<const Eigen::Matrix<float, 4, 4, Eigen::RowMajor>>(values.data()).cast<double>();
  }
  void skip(std::uint64_t count) {
    is_ok_ = is_ok_ && at_ <= bytes_.size() && count <= bytes_.size() - at_;
    at_ += is_ok_ ? count : 0;
  }
  [[nodiscard]] bool isOk() const { return is_ok_; }
  [[nodiscard]] std::uint64_t at() const { return at_; }

 private:
  SensBytes& bytes_;
  std::uint64_t at_;
  bool is_ok_ = true;
};

struct SensHeader {
  RigCamera color, depth;
  ColorCoding color_coding = ColorCoding::raw;
  DepthCoding depth_coding = DepthCoding::raw;
  float units_per_meter = 0;
  std::uint64_t frames = 0;
  std::uint64_t data_at = 0;  ///< first frame
};

struct SensFrame {
  Eigen::Matrix4d T_world_camera;
  std::uint64_t depth_time = 0;
  std::uint64_t color_at = 0, color_bytes = 0, depth_at = 0, depth_bytes = 0;
};

/// The open file, shared by the decoders of its frames.
struct SensRecording {
  std::filesystem::path file;
  SensBytes bytes;
  SensHeader header;
};

RigCamera sizedCamera(RigCamera camera, std::uint32_t width, std::uint32_t height) {
  camera.width = static_cast<int>(width);
  camera.height = static_cast<int>(height);
  return camera;
}

Result<SensHeader> readSensHeader(SensBytes& bytes, const std::string& name) {
  SensCursor cursor(bytes, 0);
  const auto version = cursor.get<std::uint32_t>();
  if (!cursor.isOk() || version != kSensVersion) {
    return fail(name + " is no .sens file of version 4.",
                "Give a .sens file of ScanNet or BundleFusion, or images that were extracted from it.");
  }
  const auto name_length = cursor.get<std::uint64_t>();
  cursor.skip(std::min(name_length, kLongestSensorName));
  SensHeader header;
  header.color.projection = cursor.matrix();
  header.color.T_rig_camera = cursor.matrix();
  header.depth.projection = cursor.matrix();
  header.depth.T_rig_camera = cursor.matrix();
  header.color_coding = static_cast<ColorCoding>(cursor.get<std::int32_t>());
  header.depth_coding = static_cast<DepthCoding>(cursor.get<std::int32_t>());
  const auto color_width = cursor.get<std::uint32_t>(), color_height = cursor.get<std::uint32_t>();
  const auto depth_width = cursor.get<std::uint32_t>(), depth_height = cursor.get<std::uint32_t>();
  header.units_per_meter = cursor.get<float>();
  header.frames = cursor.get<std::uint64_t>();
  header.data_at = cursor.at();
  if (!cursor.isOk() || name_length > kLongestSensorName)
    return fail(name + " is damaged: its header is incomplete.", "Download or copy it again.");
  SCANTROVE_TRY(checkImageSize({depth_width, depth_height}, name));
  if (color_width > 0) SCANTROVE_TRY(checkImageSize({color_width, color_height}, name));
  header.depth = sizedCamera(header.depth, depth_width, depth_height);
  header.color = sizedCamera(header.color, color_width, color_height);
  return header;
}

Result<void> checkCodings(const SensHeader& header, const std::string& name) {
  if (header.depth_coding != DepthCoding::raw && header.depth_coding != DepthCoding::zlib) {
    const bool is_occi = header.depth_coding == DepthCoding::occi;
    return fail(name + ": its depth is compressed by " +
                    (is_occi ? "OCCI" : "method " + std::to_string(static_cast<int>(header.depth_coding))) +
                    ", which cannot be read.",
                "Extract its images with ScanNet's SensReader and open that folder.");
  }
  const auto color = static_cast<std::int32_t>(header.color_coding);
  if (header.color.width > 0 && (color < 0 || color > static_cast<std::int32_t>(ColorCoding::jpeg))) {
    return fail(
        name + ": its colour is compressed by method " + std::to_string(color) + ", which cannot be read.",
        "Extract its images with ScanNet's SensReader and open that folder.");
  }
  return {};
}

/// The frames that are complete in the file.
std::vector<SensFrame> readSensIndex(SensBytes& bytes, const SensHeader& header) {
  std::vector<SensFrame> frames;
  std::uint64_t at = header.data_at;
  const std::uint64_t count = std::min<std::uint64_t>(header.frames, kMaxSensFrames);
  while (frames.size() < count && bytes.size() - std::min(at, bytes.size()) >= kFrameHeaderBytes) {
    SensCursor cursor(bytes, at);
    SensFrame frame;
    frame.T_world_camera = cursor.matrix();
    // times and sizes of colour and depth
    const auto [color_time, depth_time, color_bytes, depth_bytes] =
        cursor.get<std::array<std::uint64_t, 4>>();
    frame.depth_time = depth_time;
    frame.color_bytes = color_bytes;
    frame.depth_bytes = depth_bytes;
    frame.color_at = cursor.at();
    cursor.skip(frame.color_bytes);
    frame.depth_at = cursor.at();
    cursor.skip(frame.depth_bytes);
    if (!cursor.isOk()) break;
    at = cursor.at();
    frames.push_back(frame);
  }
  return frames;
}

Result<std::vector<std::uint8_t>> readSensBytes(SensRecording& recording, std::uint64_t at,
                                                std::uint64_t count, const std::string& name) {
  if (count == 0 || count > kMaxSensImageBytes)
    return fail(name + " is damaged: it has " + std::to_string(count) + " bytes.");
  std::vector<std::uint8_t> bytes(static_cast<std::size_t>(count));
  if (!recording.bytes.read(at, bytes.data(), count))
    return fail("Cannot read " + name + ".", "Was a drive unplugged?");
  return bytes;
}

Result<cv::Mat> decodeSensColor(SensRecording& recording, const SensFrame& frame, const std::string& name) {
  auto bytes = readSensBytes(recording, frame.color_at, frame.color_bytes, name);
  if (!bytes) return fail(bytes.error());
  if (recording.header.color_coding != ColorCoding::raw) return decodeColorImage(*bytes, name);
  const RigCamera& camera = recording.header.color;
  const cv::Size size(camera.width, camera.height);
  if (bytes->size() != 3 * static_cast<std::size_t>(size.area()))
    return fail(name + " is damaged: it has " + std::to_string(bytes->size()) + " bytes.");
  cv::Mat bgr;
  cv::cvtColor(cv::Mat(size, CV_8UC3, bytes->data()), bgr, cv::COLOR_RGB2BGR);
  return bgr;
}

Result<cv::Mat> decodeSensDepth(SensRecording& recording, const SensFrame& frame, const std::string& name) {
  const auto bytes = readSensBytes(recording, frame.depth_at, frame.depth_bytes, name);
  if (!bytes) return fail(bytes.error());
  const RigCamera& camera = recording.header.depth;
  cv::Mat depth(camera.height, camera.width, CV_16UC1);
  const std::size_t expected = depth.total() * depth.elemSize();
  bool is_complete = false;
  if (recording.header.depth_coding == DepthCoding::zlib) {
    const std::unique_ptr<libdeflate_decompressor, decltype(&libdeflate_free_decompressor)> inflater(
        libdeflate_alloc_decompressor(), &libdeflate_free_decompressor);
    is_complete = inflater && libdeflate_zlib_decompress(inflater.get(), bytes->data(), bytes->size(),
                                                         depth.data, expected, nullptr) == LIBDEFLATE_SUCCESS;
  } else if (bytes->size() == expected) {
    std::memcpy(depth.data, bytes->data(), expected);
    is_complete = true;
  }
  if (!is_complete) return fail(name + " is damaged.");
  depth.setTo(0, depth == UINT16_MAX);
  return depth;
}

/// Times in seconds, or none if they do not increase.
std::vector<double> secondsOf(const std::vector<SensFrame>& frames, const std::string& source) {
  std::vector<double> times;
  for (const SensFrame& frame : frames) times.push_back(static_cast<double>(frame.depth_time));
  if (times.size() < 2 || std::ranges::adjacent_find(times, std::greater_equal<>()) != times.end()) return {};
  const TimeUnit unit = unitOfImageTimes(times);
  spdlog::debug("{}: its times are {}.", source, unit.name);
  for (double& time : times) time *= unit.seconds;
  return times;
}

ImageSequenceEntry sensEntry(const std::shared_ptr<SensRecording>& recording, const SensFrame& frame,
                             int index) {
  const std::string name = "image " + std::to_string(index) + " of " + recording->file.string();
  ImageSequenceEntry entry;
  entry.index = index;
  entry.timestamp_s = index / kFrameRateHz;
  entry.T_world_camera = rigidMotion(frame.T_world_camera);
  entry.decode_depth = [recording, frame, name] {
    return decodeSensDepth(*recording, frame, "The depth " + name);
  };
  if (recording->header.color.width > 0) {
    entry.decode_color = [recording, frame, name] {
      return decodeSensColor(*recording, frame, "The colour " + name);
    };
  }
  return entry;
}

}  // namespace

Result<std::unique_ptr<FrameSource>> openSensFile(const std::filesystem::path& file,
                                                  const SourceOptions& options) {
  SCANTROVE_TRY(checkRegularFile(file));
  std::error_code error;
  const std::uintmax_t size = std::filesystem::file_size(file, error);
  if (error) return fail("Cannot read " + file.string() + ": " + error.message() + ".");
  const auto recording = std::make_shared<SensRecording>(SensRecording{file, SensBytes(file, size), {}});
  SCANTROVE_TRY(moveInto(recording->header, readSensHeader(recording->bytes, file.string())));
  const SensHeader& header = recording->header;
  SCANTROVE_TRY(checkCodings(header, file.string()));
  const std::vector<SensFrame> frames = readSensIndex(recording->bytes, header);
  if (frames.empty()) return fail(file.string() + " holds no complete frame.", "Download or copy it again.");
  if (frames.size() < header.frames) {
    spdlog::warn("{}: using {} of {} frames; the file ends there, or is longer than can be read.",
                 folderName(file), frames.size(), header.frames);
  }
  ImageSequence sequence;
  sequence.kind = ".sens file";
  sequence.folder = file;
  sequence.has_color = header.color.width > 0;
  sequence.camera = rigModel(header.depth, sequence.has_color ? std::optional(header.color) : std::nullopt);
  sequence.camera_origin = file.string();
  sequence.units_per_meter = static_cast<double>(header.units_per_meter);
  const std::vector<double> times = secondsOf(frames, folderName(file));
  for (const SensFrame& frame : frames) {
    const std::size_t i = sequence.entries.size();
    ImageSequenceEntry& entry =
        sequence.entries.emplace_back(sensEntry(recording, frame, static_cast<int>(i)));
    if (!times.empty()) entry.timestamp_s = times[i];
    sequence.has_poses = sequence.has_poses || entry.T_world_camera;
  }
  return openImageSequence(std::move(sequence), options);
}

}  // namespace scantrove
