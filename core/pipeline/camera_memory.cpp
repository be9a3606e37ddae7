#include "core/pipeline/camera_memory.h"

#include <array>
#include <cmath>
#include <cstddef>
#include <limits>
#include <utility>

#include "core/base/byte_stream.h"

namespace scantrove {
namespace {

/// Without and with the motion of a device that tracks itself.
constexpr std::uint32_t kVersion = 2, kVersionWithDevice = 3;
/// Side length in pixels that no camera's image reaches.
constexpr int kLargestSide = 1 << 16;
constexpr int kDescriptorBytes = 32;  ///< of a landmark: 256 bits

void put(ByteWriter& to, bool flag) { to.put(static_cast<std::uint32_t>(flag)); }

bool getFlag(ByteReader& from) { return from.get<std::uint32_t>() != 0; }

void put(ByteWriter& to, const Eigen::Isometry3d& T) {
  to.putAll(std::span<const double>(T.data(), static_cast<std::size_t>(T.matrix().size())));
}

Eigen::Isometry3d getPose(ByteReader& from) {
  Eigen::Isometry3d T = Eigen::Isometry3d::Identity();
  from.getAll(std::span<double>(T.data(), static_cast<std::size_t>(T.matrix().size())));
  constexpr double kTolerance = 1e-3;
  const Eigen::Matrix3d R = T.linear();
  const bool is_rigid = T.matrix().allFinite() && R.determinant() > 0 &&
                        (R.transpose() * R).isIdentity(kTolerance) &&
                        T.matrix().row(3) == Eigen::RowVector4d(0, 0, 0, 1);
  if (!is_rigid) from.refuse();
  return T;
}

/// An empty image may have an empty camera.
Intrinsics getCamera(ByteReader& from, bool may_be_empty = false) {
  const auto K = from.get<Intrinsics>();
  const auto isSide = [](int side) { return side > 0 && side < kLargestSide; };
  const bool is_usable = std::isfinite(K.fx) && std::isfinite(K.fy) && std::isfinite(K.cx) &&
                         std::isfinite(K.cy) && K.fx > 0 && K.fy > 0 && isSide(K.width) && isSide(K.height);
  const bool is_empty = K.width == 0 && K.height == 0;
  if (!is_usable && !(may_be_empty && is_empty)) from.refuse();
  return K;
}

std::size_t bytesOfRow(const cv::Mat& image) {
  return static_cast<std::size_t>(image.cols) * image.elemSize();
}

void put(ByteWriter& to, const cv::Mat& image) {
  to.put(image.rows);
  to.put(image.cols);
  to.put(image.type());
  for (int row = 0; row < image.rows; ++row)
    to.putAll(std::span<const unsigned char>(image.ptr(row), bytesOfRow(image)));
}

bool isOf(const Intrinsics& K, const cv::Mat& image) {
  return image.empty() || (image.cols == K.width && image.rows == K.height);
}

/// Empty, or of `type`; otherwise the reader fails.
cv::Mat getImage(ByteReader& from, int type) {
  const int rows = from.get<int>(), cols = from.get<int>(), stored_type = from.get<int>();
  if (rows == 0 || cols == 0) return {};
  const bool is_image =
      rows > 0 && cols > 0 && rows < kLargestSide && cols < kLargestSide && stored_type == type;
  if (!is_image || from.bytesLeft() / static_cast<std::size_t>(cols) < static_cast<std::size_t>(rows)) {
    from.refuse();
    return {};
  }
  cv::Mat image(rows, cols, type);
  for (int row = 0; row < rows; ++row)
    from.getAll(std::span<unsigned char>(image.ptr(row), bytesOfRow(image)));
  return image;
}

void put(ByteWriter& to, const KeyFrame& place) {
  put(to, place.T_world_camera);
  to.putList(std::span<const cv::Point3f>(place.landmarks.points_world));
  put(to, place.landmarks.descriptors);
  put(to, place.thumbnail);
}

void put(ByteWriter& to, const SeenSurfaces::View& view) {
  put(to, view.T_world_camera);
  to.put(view.surface.intrinsics());
  put(to, view.surface.units());
  put(to, view.is_revisitable);
}

KeyFrame getKeyFrame(ByteReader& from) {
  KeyFrame place;
  place.T_world_camera = getPose(from);
  place.landmarks.points_world = from.getList<cv::Point3f>();
  place.landmarks.descriptors = getImage(from, CV_8UC1);
  place.thumbnail = getImage(from, CV_32FC1);
  const cv::Mat& descriptors = place.landmarks.descriptors;
  if (place.landmarks.points_world.size() != static_cast<std::size_t>(descriptors.rows) ||
      (!descriptors.empty() && descriptors.cols != kDescriptorBytes))
    from.refuse();
  return place;
}

SeenSurfaces::View getView(ByteReader& from) {
  SeenSurfaces::View view;
  view.T_world_camera = getPose(from);
  const Intrinsics K = getCamera(from);
  view.surface = StoredSurface(K, getImage(from, CV_16UC1));
  view.is_revisitable = getFlag(from);
  if (view.surface.empty() || !isOf(K, view.surface.units())) from.refuse();
  return view;
}

void put(ByteWriter& to, const PoseTracker::Memory& tracker) {
  put(to, tracker.last);
  put(to, tracker.before_last.has_value());
  if (tracker.before_last) put(to, *tracker.before_last);
  put(to, tracker.is_lost);
  put(to, tracker.last_view.image);
  to.put(tracker.last_view.K);
  put(to, tracker.last_view.T_color_depth);
  to.put(static_cast<std::uint64_t>(tracker.places.size()));
  for (const KeyFrame& place : tracker.places) put(to, place);
  to.put(static_cast<std::uint64_t>(tracker.surfaces.size()));
  for (const SeenSurfaces::View& view : tracker.surfaces) put(to, view);
}

PoseTracker::Memory getTracker(ByteReader& from) {
  PoseTracker::Memory tracker;
  tracker.last = getPose(from);
  if (getFlag(from)) tracker.before_last = getPose(from);
  tracker.is_lost = getFlag(from);
  tracker.last_view.image = getImage(from, CV_8UC1);
  tracker.last_view.K = getCamera(from, tracker.last_view.image.empty());
  tracker.last_view.T_color_depth = getPose(from);
  if (!isOf(tracker.last_view.K, tracker.last_view.image)) from.refuse();
  const auto places = from.get<std::uint64_t>();
  for (std::uint64_t i = 0; i < places && from.ok(); ++i) tracker.places.push_back(getKeyFrame(from));
  const auto surfaces = from.get<std::uint64_t>();
  for (std::uint64_t i = 0; i < surfaces && from.ok(); ++i) tracker.surfaces.push_back(getView(from));
  return tracker;
}

void put(ByteWriter& to, const DeviceMotion::Motion& motion) {
  put(to, motion.motion);
  to.put(motion.duration_s);
}

void put(ByteWriter& to, const DeviceMotion::Memory& device) {
  put(to, device.T_device_camera);
  to.put(device.time_s);
  put(to, device.T_world_device);
  put(to, device.motion);
  put(to, device.jump);
  to.put(device.drift.angle_rad);
  to.put(device.drift.distance_m);
}

/// From `smallest` on; otherwise the reader fails.
double getNumber(ByteReader& from, double smallest) {
  const auto value = from.get<double>();
  if (!std::isfinite(value) || value < smallest) from.refuse();
  return value;
}

DeviceMotion::Motion getMotion(ByteReader& from) {
  DeviceMotion::Motion motion;
  motion.motion = getPose(from);
  motion.duration_s = getNumber(from, 0);
  return motion;
}

DeviceMotion::Memory getDevice(ByteReader& from) {
  DeviceMotion::Memory device;
  device.T_device_camera = getPose(from);
  device.time_s = getNumber(from, std::numeric_limits<double>::lowest());
  device.T_world_device = getPose(from);
  device.motion = getMotion(from);
  device.jump = getMotion(from);
  device.drift.angle_rad = getNumber(from, 0);
  device.drift.distance_m = getNumber(from, 0);
  return device;
}

void put(ByteWriter& to, const FreeSpace::Memory& free_space) {
  to.put(free_space.views);
  to.put(static_cast<std::uint64_t>(free_space.witnesses.size()));
  for (const FreeSpace::Witness& witness : free_space.witnesses) {
    to.put(witness.K);
    put(to, witness.T_camera_world);
    put(to, witness.nearest_m);
  }
}

FreeSpace::Memory getFreeSpace(ByteReader& from) {
  FreeSpace::Memory free_space;
  free_space.views = from.get<int>();
  const auto witnesses = from.get<std::uint64_t>();
  for (std::uint64_t i = 0; i < witnesses && from.ok(); ++i) {
    FreeSpace::Witness witness;
    witness.K = getCamera(from);
    witness.T_camera_world = getPose(from);
    witness.nearest_m = getImage(from, CV_32FC1);
    if (!isOf(witness.K, witness.nearest_m)) from.refuse();
    free_space.witnesses.push_back(std::move(witness));
  }
  return free_space;
}

void put(ByteWriter& to, const AppearedObjects::Memory& appeared_objects) {
  to.put(appeared_objects.frame);
  to.putList(std::span<const AppearedObjects::Cell>(appeared_objects.cells));
}

AppearedObjects::Memory getAppearedObjects(ByteReader& from) {
  AppearedObjects::Memory appeared_objects;
  appeared_objects.frame = from.get<int>();
  appeared_objects.cells = from.getList<AppearedObjects::Cell>();
  return appeared_objects;
}

using Float4 = std::array<float, 4>;
static_assert(sizeof(Float4) == sizeof(Eigen::Vector4f));

void put(ByteWriter& to, const std::vector<Eigen::Vector4f>& image) {
  to.putList(std::span(reinterpret_cast<const Float4*>(image.data()), image.size()));
}

std::vector<Eigen::Vector4f> getVectors(ByteReader& from) {
  std::vector<Eigen::Vector4f> image;
  for (const Float4& values : from.getList<Float4>()) image.emplace_back(values.data());
  return image;
}

}  // namespace

std::vector<std::uint32_t> toWords(const CameraMemory& memory) {
  const bool has_device = memory.tracker && memory.tracker->device;
  ByteWriter to;
  to.put(has_device ? kVersionWithDevice : kVersion);
  put(to, memory.tracker.has_value());
  if (memory.tracker) put(to, *memory.tracker);
  put(to, memory.free_space);
  put(to, memory.appeared_objects);
  to.put(memory.color_turns);
  to.put(memory.view.K);
  put(to, memory.view.T_world_camera);
  for (const auto* maps :
       {&memory.view.vertices_world, &memory.view.normals_world, &memory.reference_normals_world})
    put(to, *maps);
  if (has_device) put(to, *memory.tracker->device);
  return to.take();
}

std::optional<CameraMemory> cameraMemoryFrom(std::span<const std::uint32_t> words) {
  ByteReader from(words);
  const auto version = from.get<std::uint32_t>();
  if (version != kVersion && version != kVersionWithDevice) return std::nullopt;
  CameraMemory memory;
  if (getFlag(from)) memory.tracker = getTracker(from);
  memory.free_space = getFreeSpace(from);
  memory.appeared_objects = getAppearedObjects(from);
  memory.color_turns = from.get<ColorIntegrator::Turns>();
  memory.view.K = getCamera(from);
  memory.view.T_world_camera = getPose(from);
  for (auto* maps :
       {&memory.view.vertices_world, &memory.view.normals_world, &memory.reference_normals_world})
    *maps = getVectors(from);
  if (version == kVersionWithDevice) {
    if (!memory.tracker) return std::nullopt;
    memory.tracker->device = getDevice(from);
  }
  const auto pixels =
      static_cast<std::size_t>(memory.view.K.width) * static_cast<std::size_t>(memory.view.K.height);
  const bool is_complete = from.isAtEnd() && memory.view.vertices_world.size() == pixels &&
                           memory.view.normals_world.size() == pixels &&
                           (!memory.tracker || memory.reference_normals_world.size() == pixels);
  return is_complete ? std::optional(std::move(memory)) : std::nullopt;
}

}  // namespace scantrove
