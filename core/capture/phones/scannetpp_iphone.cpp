#include "core/capture/phones/scannetpp_iphone.h"

#include <lz4.h>

#include <algorithm>
#include <cstring>
#include <string_view>
#include <utility>
#include <vector>

#include "core/base/stamped_pose.h"
#include "core/base/text.h"
#include "core/capture/containers/random_access_file.h"
#include "core/capture/deflated_frames.h"
#include "core/capture/folder_listing.h"
#include "core/capture/phones/device_files.h"
#include "core/capture/phones/device_metadata.h"
#include "core/capture/video_frames.h"
#include "core/image/metric_depth.h"

namespace scantrove {

namespace {

constexpr int kScannetppWidth = 1920, kScannetppHeight = 1440;
/// Depth images in depth.bin.
constexpr int kLidarWidth = 256, kLidarHeight = 192;
constexpr std::size_t kMillimeterBytes = std::size_t{kLidarWidth} * kLidarHeight * 2,
                      kFloatBytes = 2 * kMillimeterBytes;
constexpr float kScannetppUnit_m = 0.001F;
constexpr std::string_view kFrameKey = "frame_";

cv::Mat millimetersFrom(const std::string& bytes) {
  cv::Mat depth(kLidarHeight, kLidarWidth, bytes.size() == kFloatBytes ? CV_32FC1 : CV_16UC1);
  std::memcpy(depth.data, bytes.data(), bytes.size());
  return bytes.size() == kFloatBytes ? toDepthUnits(depth, kScannetppUnit_m) : depth;
}

/// depth.bin. Either blocks, each a size of four bytes and then a compressed frame (LZ4: millimetres of two
/// bytes; DEFLATE: metres as float), or one DEFLATE stream of all frames (metres as float).
class DepthFile {
 public:
  explicit DepthFile(const std::filesystem::path& path)
      : file_(RandomAccessFile::open(path)), stream_(path, kFloatBytes) {
    if (file_) findBlocks();
  }

  [[nodiscard]] Result<cv::Mat> frame(int position) {
    if (!file_) return fail(file_.error());
    if (blocks_.empty()) return stream_.frame(position).map(millimetersFrom);
    const std::string name = file_->path().string();
    if (position >= static_cast<int>(blocks_.size())) return fail(name + " ends before this frame.");
    const auto [begin, size] = blocks_[static_cast<std::size_t>(position)];
    const auto bytes = file_->read(begin, size);
    if (!bytes) return fail(bytes.error());
    const std::string_view block(reinterpret_cast<const char*>(bytes->data()), bytes->size());
    std::string frame(kMillimeterBytes, '\0');
    const int got = LZ4_decompress_safe(block.data(), frame.data(), static_cast<int>(size),
                                        static_cast<int>(frame.size()));
    if (got == static_cast<int>(kMillimeterBytes)) return millimetersFrom(frame);
    return inflateBytes(block, kFloatBytes, name).map(millimetersFrom);
  }

 private:
  struct Block {
    std::uint64_t begin = 0;
    std::uint32_t size = 0;
  };

  /// Leaves `blocks_` empty unless blocks of plausible sizes fill the file exactly.
  void findBlocks() {
    constexpr std::uint32_t kMaxBlockBytes = 2 * kFloatBytes;
    constexpr std::size_t kMostBlocks = 1'000'000;  // four hours
    std::vector<Block> blocks;
    for (std::uint64_t at = 0; at < file_->size();) {
      const auto start = file_->peek(at, sizeof(std::uint32_t));
      if (!start) return;
      ByteCursor cursor(*start);
      const auto bytes = cursor.get<std::uint32_t>();
      at += sizeof bytes;
      if (!cursor.isOk() || bytes == 0 || bytes > kMaxBlockBytes || bytes > file_->size() - at) return;
      if (blocks.size() == kMostBlocks) return;
      blocks.push_back({at, bytes});
      at += bytes;
    }
    blocks_ = std::move(blocks);
  }

  Result<RandomAccessFile> file_;
  std::vector<Block> blocks_;
  DeflatedFrames stream_;
};

/// The folder with pose_intrinsic_imu.json; empty if there is none.
std::filesystem::path recordingFolder(const std::filesystem::path& folder) {
  for (const std::filesystem::path& place : {folder, folder / "iphone"}) {
    const bool has_depth = !fileIfPresent(place / "depth.bin").empty() || isFolder(place / "depth");
    if (has_depth && !fileIfPresent(place / "pose_intrinsic_imu.json").empty()) return place;
  }
  return {};
}

class ScannetppImages {
 public:
  explicit ScannetppImages(std::filesystem::path folder) : folder_(std::move(folder)) {
    if (const auto file = fileIfPresent(folder_ / "depth.bin"); !isFolder(folder_ / "depth"))
      depth_ = std::make_shared<DepthFile>(file);
    if (const auto file = fileIfPresent(folder_ / "rgb.mkv"); !file.empty() && !isFolder(folder_ / "rgb"))
      video_ = std::make_shared<VideoFrames>(file);
  }

  /// `name`: such as "frame_000012".
  void addTo(ImageSequenceEntry& entry, const std::string& name) const {
    const int position = entry.index;
    if (depth_) {
      entry.decode_depth = [depth = depth_, position] { return depth->frame(position); };
    } else {
      entry.depth = fileIfPresent(folder_ / "depth" / (name + ".png"));
    }
    if (video_) {
      entry.decode_color = [video = video_, position] { return video->frame(position); };
    } else {
      entry.color = fileIfPresent(folder_ / "rgb" / (name + ".jpg"));
    }
  }

 private:
  std::filesystem::path folder_;
  std::shared_ptr<DepthFile> depth_;
  std::shared_ptr<VideoFrames> video_;
};

std::optional<ImageSequenceEntry> scannetppEntry(const std::string& name, const nlohmann::json& frame) {
  if (!name.starts_with(kFrameKey)) return std::nullopt;
  const auto number = parseFrameNumber(std::string_view(name).substr(kFrameKey.size()));
  const auto matrix = numbersOf(frame, "intrinsic", 9);
  if (!number || !matrix) return std::nullopt;
  ImageSequenceEntry entry;
  entry.index = *number;
  entry.timestamp_s = numberOf(frame, "timestamp").value_or(*number / kFrameRateHz);
  entry.intrinsics = intrinsicsFromRows(*matrix, kScannetppWidth, kScannetppHeight);
  if (const auto pose = numbersOf(frame, "aligned_pose", 16)) entry.T_world_camera = poseFromRows(*pose);
  return entry;
}

}  // namespace

bool isScannetppFolder(const std::filesystem::path& folder) { return !recordingFolder(folder).empty(); }

Result<ImageSequence> readScannetppFolder(const std::filesystem::path& folder) {
  const std::filesystem::path place = recordingFolder(folder);
  const std::filesystem::path file = place / "pose_intrinsic_imu.json";
  const auto json = readJson(file);
  if (!json) return fail(json.error());
  ImageSequence sequence;
  sequence.kind = "ScanNet++ iPhone";
  sequence.folder = folder;
  sequence.has_poses = true;
  sequence.is_color_optional = true;
  sequence.camera_origin = file.string();
  const ScannetppImages images(place);
  UnusableFrames unusable;
  if (json->is_object()) {
    for (const auto& [name, frame] : json->items()) {
      auto entry = scannetppEntry(name, frame);
      if (!entry) {
        unusable.add(name + " has no intrinsics.");
        continue;
      }
      images.addTo(*entry, name);
      sequence.entries.push_back(std::move(*entry));
    }
  }
  unusable.warn(folderName(folder));
  std::ranges::stable_sort(sequence.entries, {}, &ImageSequenceEntry::index);
  if (sequence.entries.empty())
    return fail(file.string() + " has no frame (frame_000000 ...) with intrinsics.",
                "Download the file again.");
  return sequence;
}

}  // namespace scantrove
