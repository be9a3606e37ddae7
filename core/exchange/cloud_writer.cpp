#include "core/exchange/cloud_writer.h"

#include <pcl/PCLPointCloud2.h>
#include <pcl/io/pcd_io.h>

#include <algorithm>
#include <array>
#include <bit>
#include <cstring>
#include <string>
#include <tuple>
#include <utility>

#include "core/exchange/atomic_file.h"

namespace scantrove {
namespace {

static_assert(std::endian::native == std::endian::little, "points are written as they lie in memory");

template <class... T>
void put(std::string& bytes, const T&... values) {
  const auto append = [&bytes](const auto& value) {
    std::array<char, sizeof value> raw{};
    std::memcpy(raw.data(), &value, raw.size());
    bytes.append(raw.data(), raw.size());
  };
  (append(values), ...);
}

/// Single precision cannot represent points far from the world's origin.
bool needsDoubles(const Eigen::Vector3d& origin_world) { return !origin_world.isZero(0); }

void putPlace(const LabeledPoint& p, const Eigen::Vector3d& origin_world, std::string& bytes) {
  if (!needsDoubles(origin_world)) return put(bytes, p.x, p.y, p.z);
  put(bytes, p.x + origin_world.x(), p.y + origin_world.y(), p.z + origin_world.z());
}

void putPcd(const LabeledPoint& p, const Eigen::Vector3d& origin_world, std::string& bytes) {
  putPlace(p, origin_world, bytes);
  const std::uint32_t rgba = 0xFF000000U | std::uint32_t{p.r} << 16 | std::uint32_t{p.g} << 8 | p.b;
  put(bytes, rgba, p.label, p.estimated);
}

void putPly(const LabeledPoint& p, const Eigen::Vector3d& origin_world, std::string& bytes) {
  putPlace(p, origin_world, bytes);
  put(bytes, p.r, p.g, p.b, p.label, p.estimated);
}

/// Encodes a cloud piece by piece, since a large scan's cloud is as large as its map.
Result<void> write(const std::filesystem::path& path, std::string header, const LabeledCloud& points,
                   const Eigen::Vector3d& origin_world,
                   void (*put)(const LabeledPoint&, const Eigen::Vector3d&, std::string&)) {
  constexpr std::ptrdiff_t kPointsOfAPiece = 16384;
  std::string bytes = std::move(header);
  auto point = points.begin();
  bool is_header = true;
  return writeFileAtomically(path, [&]() -> std::string_view {
    if (std::exchange(is_header, false)) return bytes;
    bytes.clear();
    for (const auto end = point + std::min(kPointsOfAPiece, points.end() - point); point != end; ++point)
      put(*point, origin_world, bytes);
    return bytes;
  });
}

/// PCL's header for points of `x y z rgba label estimated` without padding.
std::string pcdHeader(std::size_t points, const Eigen::Isometry3d& T_world_viewpoint, bool has_doubles,
                      const std::string& comment) {
  pcl::PCLPointCloud2 cloud;
  const auto place = has_doubles ? pcl::PCLPointField::FLOAT64 : pcl::PCLPointField::FLOAT32;
  const std::uint32_t place_bytes = has_doubles ? 8 : 4;
  for (const auto& [name, type, bytes] : {std::tuple{"x", place, place_bytes},
                                          {"y", place, place_bytes},
                                          {"z", place, place_bytes},
                                          {"rgba", pcl::PCLPointField::UINT32, 4U},
                                          {"label", pcl::PCLPointField::UINT32, 4U},
                                          {"estimated", pcl::PCLPointField::UINT8, 1U}}) {
    pcl::PCLPointField field;
    field.name = name;
    field.datatype = static_cast<std::uint8_t>(type);
    field.count = 1;
    field.offset = cloud.point_step;
    cloud.point_step += bytes;
    cloud.fields.push_back(field);
  }
  cloud.width = static_cast<std::uint32_t>(points);
  cloud.height = 1;
  Eigen::Vector4f origin = Eigen::Vector4f::Zero();
  origin.head<3>() = T_world_viewpoint.translation().cast<float>();
  const Eigen::Quaterniond orientation(T_world_viewpoint.linear());
  std::string header =
      pcl::PCDWriter().generateHeaderBinary(cloud, origin, orientation.normalized().cast<float>());
  header.insert(header.find('\n') + 1, "# " + comment + '\n');  // the first line identifies the format
  return header + "DATA binary\n";
}

}  // namespace

std::string encodePcd(std::span<const LabeledPoint> points, const Eigen::Isometry3d& T_world_viewpoint,
                      const Eigen::Vector3d& origin_world) {
  std::string bytes = pcdHeader(points.size(), T_world_viewpoint, needsDoubles(origin_world), kCloudComment);
  constexpr std::size_t kMaxPointBytes = 3 * sizeof(double) + 2 * sizeof(std::uint32_t) + 1;
  bytes.reserve(bytes.size() + points.size() * kMaxPointBytes);
  for (const LabeledPoint& point : points) putPcd(point, origin_world, bytes);
  return bytes;
}

Result<void> writePcd(const std::filesystem::path& path, const LabeledCloud& points,
                      const Eigen::Vector3d& origin_world, const std::string& comment) {
  const Eigen::Isometry3d viewpoint = Eigen::Isometry3d::Identity();
  return write(path, pcdHeader(points.size(), viewpoint, needsDoubles(origin_world), comment), points,
               origin_world, putPcd);
}

Result<void> writePly(const std::filesystem::path& path, const LabeledCloud& points,
                      const Eigen::Vector3d& origin_world, const std::string& comment) {
  std::string header = "ply\nformat binary_little_endian 1.0\ncomment " + comment + "\nelement vertex " +
                       std::to_string(points.size()) + "\n";
  const std::string type = needsDoubles(origin_world) ? "double" : "float";
  for (const char* axis : {"x", "y", "z"}) header += "property " + type + " " + axis + "\n";
  header +=
      "property uchar red\nproperty uchar green\nproperty uchar blue\nproperty uint label\n"
      "property uchar estimated\nend_header\n";
  return write(path, header, points, origin_world, putPly);
}

}  // namespace scantrove
