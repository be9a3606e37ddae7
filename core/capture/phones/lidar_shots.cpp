#include "core/capture/phones/lidar_shots.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "core/base/stamped_pose.h"
#include "core/base/text.h"
#include "core/capture/phones/device_files.h"
#include "core/image/metric_depth.h"

namespace scantrove {

namespace {

constexpr std::array<std::string_view, 2> kDepthEnds{"_depth.tiff", "_depth.tif"};
constexpr std::array<const char*, 4> kImageEnds{"_image.jpg", "_image.jpeg", "_image.png", "_image.JPG"};
/// The wide camera of phones with LiDAR: 1,450 - 1,600 pixels of focal length at 1920 x 1440.
constexpr Intrinsics kTypicalWideCamera{1500, 1500, 959.5F, 719.5F, 1920, 1440};

/// NAME of NAME_depth.tiff.
std::optional<std::string> shotName(const std::string& file) {
  for (const std::string_view end : kDepthEnds) {
    if (file.size() > end.size() && file.ends_with(end)) return file.substr(0, file.size() - end.size());
  }
  return std::nullopt;
}

std::filesystem::path imageOf(const std::filesystem::path& folder, const std::string& name) {
  for (const char* const end : kImageEnds) {
    if (auto file = fileIfPresent(folder / (name + end)); !file.empty()) return file;
  }
  return {};
}

/// Names are often times since 1970.
double timeOfShot(const std::string& name, int index) {
  const auto numbers = parseNumbers(name);
  const bool is_time = numbers && numbers->size() == 1 && std::isfinite(numbers->front());
  return is_time ? numbers->front() : index / kFrameRateHz;
}

}  // namespace

bool isLidarShotsFolder(const std::filesystem::path& folder, const std::vector<std::string>& names) {
  const auto shot =
      std::ranges::find_if(names, [](const std::string& file) { return shotName(file).has_value(); });
  return shot != names.end() && readMetricDepth(folder / *shot).has_value();
}

Result<ImageSequence> readLidarShotsFolder(const std::filesystem::path& folder,
                                           const std::vector<std::string>& names) {
  ImageSequence sequence;
  sequence.kind = "LiDAR shots";
  sequence.folder = folder;
  sequence.is_color_optional = true;
  sequence.camera.K = kTypicalWideCamera;
  sequence.camera_origin = "default";
  const auto camera = findIntrinsics(folder);
  if (!camera) return fail(camera.error());
  if (*camera) {
    sequence.camera = **camera;
    sequence.camera_origin = "from the file in " + folder.string();
  }
  for (const std::string& file : names) {
    const auto name = shotName(file);
    if (!name) continue;
    ImageSequenceEntry entry;
    entry.index = static_cast<int>(sequence.entries.size());
    entry.timestamp_s = timeOfShot(*name, entry.index);
    entry.depth = folder / file;
    entry.color = imageOf(folder, *name);
    sequence.entries.push_back(std::move(entry));
  }
  return sequence;
}

}  // namespace scantrove
