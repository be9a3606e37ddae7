#include "app/map_instances.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>
#include <cstdint>
#include <cstring>
#include <map>
#include <nlohmann/json.hpp>
#include <opencv2/imgproc.hpp>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "app/true_objects.h"
#include "core/base/regular_file.h"
#include "core/capture/pose_files.h"
#include "core/exchange/label_image_writer.h"
#include "core/scan/open_source.h"

namespace scantrove {
namespace {

namespace fs = std::filesystem;

constexpr int kFramesPerVote = 10;         // matched frames of which one votes
constexpr double kVisibleWithin_m = 0.03;  // of the depth image
constexpr double kSameTime_s = 0.001;      // trajectories have microseconds

/// Points in the world, and their regions.
struct RegionCloud {
  std::vector<Eigen::Vector3d> points_world;
  std::vector<std::uint32_t> regions;
  std::vector<bool> is_estimated;
};

template <class T>
T valueAt(const char* bytes) {
  T value{};
  std::memcpy(&value, bytes, sizeof value);
  return value;
}

template <class T>
Eigen::Vector3d placeAt(const char* bytes) {
  const auto xyz = valueAt<std::array<T, 3>>(bytes);
  return {xyz[0], xyz[1], xyz[2]};
}

/// The header of a cloud.
struct CloudHeader {
  std::size_t points = 0, begin = 0;  // of the data
  bool has_doubles = false, has_estimated = false;

  [[nodiscard]] std::size_t placeBytes() const { return 3 * (has_doubles ? sizeof(double) : sizeof(float)); }
  [[nodiscard]] std::size_t stride() const {
    return placeBytes() + 3 + sizeof(std::uint32_t) + (has_estimated ? 1 : 0);
  }
};

/// Reads the header of writePly(): `float|double x y z, uchar red green blue, uint label, uchar estimated`.
/// Clouds of earlier versions end at `label`. None: another one.
std::optional<CloudHeader> headerOf(const std::string& bytes) {
  constexpr std::string_view kEnd = "end_header\n";
  constexpr std::string_view kVertices = "element vertex ";
  const std::size_t end = bytes.find(kEnd);
  if (end == std::string::npos) return std::nullopt;
  CloudHeader header;
  header.begin = end + kEnd.size();
  std::string layout;
  for (std::size_t at = 0; at < end;) {
    const std::size_t line_end = bytes.find('\n', at);
    const std::string_view line(bytes.data() + at, line_end - at);
    at = line_end + 1;
    if (line.starts_with("comment ")) continue;
    if (!line.starts_with(kVertices)) {
      layout.append(line).push_back('\n');
      continue;
    }
    const char* const last = line.data() + line.size();
    const auto [parsed, failure] = std::from_chars(line.data() + kVertices.size(), last, header.points);
    if (failure != std::errc{} || parsed != last) return std::nullopt;
  }
  const auto layoutOf = [](const std::string& type) {
    return "ply\nformat binary_little_endian 1.0\nproperty " + type + " x\nproperty " + type +
           " y\nproperty " + type +
           " z\nproperty uchar red\nproperty uchar green\nproperty uchar blue\nproperty uint label\n";
  };
  constexpr std::string_view kEstimated = "property uchar estimated\n";
  header.has_estimated = layout.ends_with(kEstimated);
  if (header.has_estimated) layout.resize(layout.size() - kEstimated.size());
  header.has_doubles = layout == layoutOf("double");
  return header.has_doubles || layout == layoutOf("float") ? std::optional(header) : std::nullopt;
}

Result<RegionCloud> readRegionCloud(const fs::path& file, EstimatedPoints estimated) {
  const Result<std::string> bytes = readFile(file);
  if (!bytes) return fail(bytes.error());
  const std::optional<CloudHeader> header = headerOf(*bytes);
  const std::size_t data_bytes = header ? bytes->size() - header->begin : 0;
  if (!header || data_bytes / header->stride() != header->points || data_bytes % header->stride() != 0)
    return fail(file.string() + " is not the labelled cloud of a scan.", "Run the scan again.");
  RegionCloud cloud;
  const char* const end = bytes->data() + bytes->size();
  for (const char* point = bytes->data() + header->begin; point < end; point += header->stride()) {
    const char* const label = point + header->placeBytes() + 3;
    const bool is_estimated = header->has_estimated && label[sizeof(std::uint32_t)] != 0;
    if (is_estimated && estimated == EstimatedPoints::left_out) continue;
    cloud.points_world.push_back(header->has_doubles ? placeAt<double>(point) : placeAt<float>(point));
    cloud.regions.push_back(valueAt<std::uint32_t>(label));
    cloud.is_estimated.push_back(is_estimated);
  }
  return cloud;
}

/// The objectness of the regions in labels.json, by region; empty: the scan has no such file, or rated none.
Result<std::map<std::uint32_t, double>> readRatings(const fs::path& file) {
  std::map<std::uint32_t, double> ratings;
  std::error_code ignored;
  if (!fs::exists(file, ignored)) return ratings;
  const Result<std::string> text = readFile(file);
  if (!text) return fail(text.error());
  try {
    const nlohmann::json labels = nlohmann::json::parse(*text);
    for (const auto& [region, entry] : labels.items()) {
      std::uint32_t number = 0;
      const auto parsed = std::from_chars(region.data(), region.data() + region.size(), number);
      const auto objectness = entry.find("objectness");
      if (parsed.ec == std::errc{} && objectness != entry.end()) ratings[number] = objectness->get<double>();
    }
  } catch (const nlohmann::json::exception& exception) {
    return fail(file.string() + " is not the label map of a scan: " + exception.what() + ".",
                "Run the scan again.");
  }
  return ratings;
}

/// The confidence of all regions of a scan with ratings: those that are not rated come last.
std::map<std::uint32_t, double> confidenceOf(const std::vector<std::uint32_t>& regions,
                                             std::map<std::uint32_t, double> ratings) {
  constexpr double kUnrated = -1e6;  // below any log-odds
  if (ratings.empty()) return ratings;
  for (const std::uint32_t region : regions) ratings.try_emplace(region, kUnrated);
  return ratings;
}

/// The pose of that time; null: the scan has none. `trajectory` is ordered by time.
const StampedPose* poseAt(double time_s, const Trajectory& trajectory) {
  const auto found =
      std::lower_bound(trajectory.begin(), trajectory.end(), time_s - kSameTime_s,
                       [](const StampedPose& pose, double time) { return pose.timestamp_s < time; });
  return found != trajectory.end() && found->timestamp_s <= time_s + kSameTime_s ? &*found : nullptr;
}

/// How many frames show the point as part of each instance.
class InstanceVotes {
 public:
  void add(std::uint16_t instance) {
    const auto found = std::find_if(counts_.begin(), counts_.end(),
                                    [&](const auto& count) { return count.first == instance; });
    if (found == counts_.end()) return counts_.push_back({instance, 1});
    ++found->second;
  }
  /// 0 without votes; the first one seen if several have equally many.
  [[nodiscard]] std::uint16_t winner() const {
    const auto most = std::max_element(counts_.begin(), counts_.end(),
                                       [](const auto& a, const auto& b) { return a.second < b.second; });
    return most == counts_.end() ? std::uint16_t{0} : most->first;
  }

 private:
  std::vector<std::pair<std::uint16_t, int>> counts_;
};

/// Adds a vote to each point that the frame shows.
void voteWith(const RgbdFrame& frame, const Intrinsics& K, const Eigen::Isometry3d& T_world_camera,
              const cv::Mat& instances, const RegionCloud& cloud, std::vector<InstanceVotes>& votes) {
  const Eigen::Isometry3d T_camera_world = T_world_camera.inverse();
  for (std::size_t i = 0; i < cloud.points_world.size(); ++i) {
    const Eigen::Vector3d p_camera = T_camera_world * cloud.points_world[i];
    if (!(p_camera.z() > 0)) continue;
    const double u = std::floor(double{K.fx} * p_camera.x() / p_camera.z() + double{K.cx} + 0.5);
    const double v = std::floor(double{K.fy} * p_camera.y() / p_camera.z() + double{K.cy} + 0.5);
    if (!(u >= 0 && v >= 0 && u < frame.depth.cols && v < frame.depth.rows)) continue;
    const cv::Point pixel(static_cast<int>(u), static_cast<int>(v));
    const int depth = frame.depth.at<std::uint16_t>(pixel);
    const double depth_m = depth * double{frame.meters_per_unit};
    const bool is_visible =
        depth == 0 ? cloud.is_estimated[i] : std::abs(depth_m - p_camera.z()) <= kVisibleWithin_m;
    if (!is_visible) continue;
    votes[i].add(instances.at<std::uint16_t>(pixel));
  }
}

/// False: no frame has depth, truth and a pose.
Result<bool> collectVotes(FrameSource& source, const NumberedImages& images, const Trajectory& trajectory,
                          const RegionCloud& cloud, std::vector<InstanceVotes>& votes) {
  int matched = 0;
  for (FrameRead read = source.next(); read.status != FrameRead::Status::end; read = source.next()) {
    if (read.status == FrameRead::Status::failed) return fail(read.error);
    if (read.status != FrameRead::Status::frame || read.frame.depth.empty()) continue;
    const auto image = images.find(read.frame.index);
    const StampedPose* pose = poseAt(read.frame.timestamp_s, trajectory);
    if (image == images.end() || pose == nullptr || matched++ % kFramesPerVote != 0) continue;
    auto instances = readLabelImage(image->second);
    if (!instances) return fail(instances.error());
    if (instances->size() != read.frame.depth.size()) {
      cv::resize(*instances, *instances, read.frame.depth.size(), 0, 0, cv::INTER_NEAREST_EXACT);
    }
    const Intrinsics K = read.frame.intrinsics.value_or(source.info().intrinsics);
    voteWith(read.frame, K, pose->T_world_camera, *instances, cloud, votes);
  }
  return matched > 0;
}

}  // namespace

Result<std::optional<PointInstances>> readMapInstances(const fs::path& scan, const fs::path& truth,
                                                       EstimatedPoints estimated) {
  std::error_code ignored;
  if (!fs::exists(scan / "cloud.ply", ignored)) return std::nullopt;
  const auto source = openSource(truth.string(), {});
  if (!source) return std::nullopt;  // label images alone
  TrueScene scene;
  const Result<bool> is_listed = readInstanceList(truth / "instances.json", scene);
  if (!is_listed) return fail(is_listed.error());
  const auto images = numberedImages(truth);
  if (!images) return fail(images.error());
  const auto trajectory = readTumTrajectory(scan / "trajectory.txt");
  if (!trajectory) return fail(trajectory.error());
  Result<RegionCloud> cloud = readRegionCloud(scan / "cloud.ply", estimated);
  if (!cloud) return fail(cloud.error());
  std::vector<InstanceVotes> votes(cloud->regions.size());
  const Result<bool> has_votes = collectVotes(**source, *images, *trajectory, *cloud, votes);
  if (!has_votes) return fail(has_votes.error());
  if (!*has_votes) return std::nullopt;
  auto ratings = readRatings(scan / "labels.json");
  if (!ratings) return fail(ratings.error());
  PointInstances instances;
  instances.confidence = confidenceOf(cloud->regions, std::move(*ratings));
  instances.predicted = std::move(cloud->regions);
  instances.truth.reserve(votes.size());
  for (const InstanceVotes& of_point : votes) {
    const std::uint16_t winner = of_point.winner();
    const bool is_object = !*is_listed || scene.objects.contains(winner);
    instances.truth.push_back(is_object ? winner : std::uint16_t{0});
  }
  return instances;
}

}  // namespace scantrove
