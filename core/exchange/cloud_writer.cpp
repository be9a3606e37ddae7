#include "core/exchange/cloud_writer.h"

#include <pcl/io/pcd_io.h>
#include <pcl/point_cloud.h>
#include <pcl/point_types.h>

#include <bit>
#include <cstring>
#include <string>

#include "core/exchange/atomic_file.h"

namespace scantrove {
namespace {

static_assert(std::endian::native == std::endian::little, "the PLY is written as it lies in memory");

template <class T>
char* put(char* out, const T& value) {
  std::memcpy(out, &value, sizeof value);
  return out + sizeof value;
}

pcl::PointCloud<pcl::PointXYZRGBL> toPcl(std::span<const LabeledPoint> points) {
  pcl::PointCloud<pcl::PointXYZRGBL> cloud;
  cloud.reserve(points.size());
  for (const LabeledPoint& p : points)
    cloud.push_back(pcl::PointXYZRGBL(p.x, p.y, p.z, p.r, p.g, p.b, p.label));
  return cloud;
}

/// PCL refuses clouds without points.
std::string emptyPcd() {
  return "# .PCD v0.7 - Point Cloud Data file format\nVERSION 0.7\nFIELDS x y z rgba label\nSIZE 4 4 4 4 4\n"
         "TYPE F F F U U\nCOUNT 1 1 1 1 1\nWIDTH 0\nHEIGHT 1\nVIEWPOINT 0 0 0 1 0 0 0\nPOINTS 0\nDATA "
         "binary\n";
}

}  // namespace

Result<void> writePcd(const std::filesystem::path& path, std::span<const LabeledPoint> points) {
  if (points.empty()) return writeFileAtomically(path, emptyPcd());
  return writeFileAtomically(path, [&](const std::filesystem::path& beside) -> Result<void> {
    try {
      if (pcl::PCDWriter().writeBinary(beside.string(), toPcl(points)) != 0)
        return fail("the point cloud was not saved");
    } catch (const pcl::PCLException& error) {
      return fail(error.what());
    }
    return {};
  });
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
