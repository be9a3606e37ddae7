#include "core/exchange/cloud_writer.h"

#include <pcl/PCLPointCloud2.h>
#include <pcl/io/pcd_io.h>

#include <algorithm>
#include <array>
#include <bit>
#include <cstring>
#include <string>
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

void putPcd(const LabeledPoint& p, std::string& bytes) {
  const std::uint32_t rgba = 0xFF000000U | std::uint32_t{p.r} << 16 | std::uint32_t{p.g} << 8 | p.b;
  put(bytes, p.x, p.y, p.z, rgba, p.label);
}

void putPly(const LabeledPoint& p, std::string& bytes) { put(bytes, p.x, p.y, p.z, p.r, p.g, p.b, p.label); }

/// A cloud of a large scan has as many bytes as its map: they are made a piece at a time.
Result<void> write(const std::filesystem::path& path, std::string header, const LabeledCloud& points,
                   void (*put)(const LabeledPoint&, std::string&)) {
  constexpr std::ptrdiff_t kPointsOfAPiece = 16384;
  std::string bytes = std::move(header);
  auto point = points.begin();
  bool is_header = true;
  return writeFileAtomically(path, [&]() -> std::string_view {
    if (std::exchange(is_header, false)) return bytes;
    bytes.clear();
    for (const auto end = point + std::min(kPointsOfAPiece, points.end() - point); point != end; ++point)
      put(*point, bytes);
    return bytes;
  });
}

/// As PCL writes it, for points of `x y z rgba label` without gaps.
std::string pcdHeader(std::size_t points, const Eigen::Isometry3d& T_world_viewpoint) {
  pcl::PCLPointCloud2 cloud;
  for (const auto& [name, type] : {std::pair{"x", pcl::PCLPointField::FLOAT32},
                                   {"y", pcl::PCLPointField::FLOAT32},
                                   {"z", pcl::PCLPointField::FLOAT32},
                                   {"rgba", pcl::PCLPointField::UINT32},
                                   {"label", pcl::PCLPointField::UINT32}}) {
    pcl::PCLPointField field;
    field.name = name;
    field.datatype = static_cast<std::uint8_t>(type);
    field.count = 1;
    field.offset = static_cast<std::uint32_t>(cloud.fields.size() * sizeof(float));
    cloud.fields.push_back(field);
  }
  cloud.width = static_cast<std::uint32_t>(points);
  cloud.height = 1;
  cloud.point_step = static_cast<std::uint32_t>(cloud.fields.size() * sizeof(float));
  Eigen::Vector4f origin = Eigen::Vector4f::Zero();
  origin.head<3>() = T_world_viewpoint.translation().cast<float>();
  const Eigen::Quaterniond orientation(T_world_viewpoint.linear());
  return pcl::PCDWriter().generateHeaderBinary(cloud, origin, orientation.normalized().cast<float>()) +
         "DATA binary\n";
}

}  // namespace

std::string encodePcd(std::span<const LabeledPoint> points, const Eigen::Isometry3d& T_world_viewpoint) {
  std::string bytes = pcdHeader(points.size(), T_world_viewpoint);
  constexpr std::size_t kPointBytes = 3 * sizeof(float) + 2 * sizeof(std::uint32_t);
  bytes.reserve(bytes.size() + points.size() * kPointBytes);
  for (const LabeledPoint& point : points) putPcd(point, bytes);
  return bytes;
}

Result<void> writePcd(const std::filesystem::path& path, const LabeledCloud& points) {
  return write(path, pcdHeader(points.size(), Eigen::Isometry3d::Identity()), points, putPcd);
}

Result<void> writePly(const std::filesystem::path& path, const LabeledCloud& points) {
  const std::string header =
      "ply\nformat binary_little_endian 1.0\ncomment labelled cloud: metres, label = region id\nelement "
      "vertex " +
      std::to_string(points.size()) +
      "\nproperty float x\nproperty float y\nproperty float z\nproperty uchar red\nproperty uchar green\n"
      "property uchar blue\nproperty uint label\nend_header\n";
  return write(path, header, points, putPly);
}

}  // namespace scantrove
