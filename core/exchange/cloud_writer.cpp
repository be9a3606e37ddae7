#include "core/exchange/cloud_writer.h"

#include <pcl/PCLPointCloud2.h>
#include <pcl/io/pcd_io.h>

#include <bit>
#include <cstring>
#include <string>

#include "core/exchange/atomic_file.h"

namespace scantrove {
namespace {

static_assert(std::endian::native == std::endian::little, "points are written as they lie in memory");

template <class T>
char* put(char* out, const T& value) {
  std::memcpy(out, &value, sizeof value);
  return out + sizeof value;
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
  const std::string header = pcdHeader(points.size(), T_world_viewpoint);
  constexpr std::size_t kPointBytes = 3 * sizeof(float) + 2 * sizeof(std::uint32_t);
  std::string bytes(header.size() + points.size() * kPointBytes, '\0');
  char* out = std::copy(header.begin(), header.end(), bytes.data());
  for (const LabeledPoint& p : points) {
    const std::uint32_t rgba = 0xFF000000U | std::uint32_t{p.r} << 16 | std::uint32_t{p.g} << 8 | p.b;
    out = put(put(put(put(put(out, p.x), p.y), p.z), rgba), p.label);
  }
  return bytes;
}

Result<void> writePcd(const std::filesystem::path& path, std::span<const LabeledPoint> points) {
  return writeFileAtomically(path, encodePcd(points));
}

Result<void> writePly(const std::filesystem::path& path, std::span<const LabeledPoint> points) {
  const std::string header =
      "ply\nformat binary_little_endian 1.0\ncomment labelled cloud: metres, label = region id\nelement "
      "vertex " +
      std::to_string(points.size()) +
      "\nproperty float x\nproperty float y\nproperty float z\nproperty uchar red\nproperty uchar green\n"
      "property uchar blue\nproperty uint label\nend_header\n";
  constexpr std::size_t kPointBytes = 3 * sizeof(float) + 3 + sizeof(std::uint32_t);
  std::string bytes(header.size() + points.size() * kPointBytes, '\0');
  char* out = std::copy(header.begin(), header.end(), bytes.data());
  for (const LabeledPoint& p : points) {
    out = put(put(put(out, p.x), p.y), p.z);
    out = put(put(put(put(out, p.r), p.g), p.b), p.label);
  }
  return writeFileAtomically(path, bytes);
}

}  // namespace scantrove
