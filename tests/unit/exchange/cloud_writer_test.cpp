#include "core/exchange/cloud_writer.h"

#include <gtest/gtest.h>
#include <pcl/io/pcd_io.h>
#include <pcl/io/ply_io.h>
#include <sys/resource.h>

#include <csignal>
#include <cstring>
#include <random>

#include "tests/support/poses.h"
#include "tests/support/temporary_folder.h"
#include "tests/unit/dataset/ply_reader.h"

namespace scantrove {
namespace {

using test::TemporaryFolder;
using PclCloud = pcl::PointCloud<pcl::PointXYZRGBL>;

LabeledCloud somePoints(std::size_t count = 1000) {
  std::mt19937 random(7);
  std::uniform_real_distribution<float> coordinate(-3, 3);
  LabeledCloud points(count);
  for (LabeledPoint& p : points) {
    p = {coordinate(random),
         coordinate(random),
         coordinate(random),
         static_cast<std::uint8_t>(random()),
         static_cast<std::uint8_t>(random()),
         static_cast<std::uint8_t>(random()),
         static_cast<std::uint32_t>(random())};
  }
  points[0].label = 0;
  points[1].label = 70000;
  points[2].label = 0xFFFFFFFFU;
  return points;
}

LabeledCloud fromPcl(const PclCloud& cloud) {
  LabeledCloud points;
  for (const auto& p : cloud) points.push_back({p.x, p.y, p.z, p.r, p.g, p.b, p.label});
  return points;
}

TEST(CloudWriter, ReadsBackEqual_WhenWrittenAsPcd) {
  const TemporaryFolder folder;
  const auto points = somePoints();
  ASSERT_TRUE(writePcd(folder / "cloud.pcd", points));
  PclCloud cloud;
  ASSERT_EQ(pcl::io::loadPCDFile((folder / "cloud.pcd").string(), cloud), 0);
  EXPECT_EQ(fromPcl(cloud), points);
  const std::string header = test::readText(folder / "cloud.pcd").substr(0, 300);
  EXPECT_NE(header.find("FIELDS x y z rgba label estimated\n"), std::string::npos);
  EXPECT_NE(header.find("DATA binary\n"), std::string::npos);
}

TEST(CloudWriter, WritesTheViewpointToPcd) {
  const TemporaryFolder folder;
  const Eigen::Isometry3d viewpoint = test::pose(10, -20, 30, 1, -2, 0.5);
  const LabeledCloud points = somePoints();
  const auto file = folder.write(
      "cloud.pcd", encodePcd(std::vector<LabeledPoint>(points.begin(), points.end()), viewpoint));
  PclCloud cloud;
  ASSERT_EQ(pcl::io::loadPCDFile(file.string(), cloud), 0);
  EXPECT_EQ(fromPcl(cloud), points);
  EXPECT_LT((cloud.sensor_origin_.head<3>().cast<double>() - viewpoint.translation()).norm(), 1e-5);
  EXPECT_LT((cloud.sensor_orientation_.toRotationMatrix().cast<double>() - viewpoint.linear()).norm(), 1e-5);
}

TEST(CloudWriter, ReadsBackEqual_WhenWrittenAsPly) {
  const TemporaryFolder folder;
  const auto points = somePoints();
  ASSERT_TRUE(writePly(folder / "cloud.ply", points));
  PclCloud cloud;
  ASSERT_EQ(pcl::io::loadPLYFile((folder / "cloud.ply").string(), cloud), 0);
  EXPECT_EQ(fromPcl(cloud), points);
}

TEST(CloudWriter, MarksEstimatedPoints) {
  const TemporaryFolder folder;
  LabeledCloud points = somePoints(5);
  points[1].estimated = points[4].estimated = 1;
  ASSERT_TRUE(writePcd(folder / "cloud.pcd", points));
  ASSERT_TRUE(writePly(folder / "cloud.ply", points));
  pcl::PCLPointCloud2 pcd;
  ASSERT_EQ(pcl::io::loadPCDFile((folder / "cloud.pcd").string(), pcd), 0);
  ASSERT_EQ(pcd.fields.back().name, "estimated");
  ASSERT_EQ(pcd.fields.back().datatype, pcl::PCLPointField::UINT8);
  const test::PlyFile ply(test::readText(folder / "cloud.ply"));
  EXPECT_EQ(ply.properties.back(), "uchar estimated");
  for (std::size_t i = 0; i < points.size(); ++i) {
    EXPECT_EQ(pcd.data[i * pcd.point_step + pcd.fields.back().offset], points[i].estimated) << i;
    EXPECT_EQ(ply.values.at("estimated")[i], points[i].estimated) << i;
    EXPECT_EQ(ply.values.at("label")[i], points[i].label) << i;
  }
}

double coordinateIn(const pcl::PCLPointCloud2& cloud, std::size_t point, std::size_t axis) {
  double coordinate = 0;
  std::memcpy(&coordinate, &cloud.data[point * cloud.point_step + cloud.fields[axis].offset],
              sizeof coordinate);
  return coordinate;
}

TEST(CloudWriter, WritesDoubles_WhenTheOriginIsFarAway) {
  const TemporaryFolder folder;
  const auto points = somePoints();
  const Eigen::Vector3d origin(5600000, -4, 0);
  ASSERT_TRUE(writePcd(folder / "cloud.pcd", points, origin));
  ASSERT_TRUE(writePly(folder / "cloud.ply", points, origin));
  pcl::PCLPointCloud2 pcd, ply;
  ASSERT_EQ(pcl::io::loadPCDFile((folder / "cloud.pcd").string(), pcd), 0);
  ASSERT_EQ(pcl::io::loadPLYFile((folder / "cloud.ply").string(), ply), 0);
  for (const pcl::PCLPointCloud2& cloud : {pcd, ply}) {
    ASSERT_EQ(cloud.width * cloud.height, points.size());
    for (std::size_t axis = 0; axis < 3; ++axis)
      ASSERT_EQ(cloud.fields[axis].datatype, pcl::PCLPointField::FLOAT64);
    for (std::size_t i = 0; i < points.size(); ++i) {
      ASSERT_NEAR(coordinateIn(cloud, i, 0) - origin.x(), points[i].x, 1e-8);
      ASSERT_NEAR(coordinateIn(cloud, i, 1) - origin.y(), points[i].y, 1e-8);
      ASSERT_NEAR(coordinateIn(cloud, i, 2) - origin.z(), points[i].z, 1e-8);
    }
  }
}

TEST(CloudWriter, ReadsBackEqual_WhenWrittenInManyPieces) {
  const TemporaryFolder folder;
  const LabeledCloud points = somePoints(40000);
  ASSERT_TRUE(writePcd(folder / "cloud.pcd", points));
  ASSERT_TRUE(writePly(folder / "cloud.ply", points));
  PclCloud pcd, ply;
  ASSERT_EQ(pcl::io::loadPCDFile((folder / "cloud.pcd").string(), pcd), 0);
  ASSERT_EQ(pcl::io::loadPLYFile((folder / "cloud.ply").string(), ply), 0);
  EXPECT_EQ(fromPcl(pcd), points);
  EXPECT_EQ(fromPcl(ply), points);
}

TEST(CloudWriter, WritesAFileWithoutPoints_WhenTheCloudIsEmpty) {
  const TemporaryFolder folder;
  ASSERT_TRUE(writePcd(folder / "cloud.pcd", {}));
  ASSERT_TRUE(writePly(folder / "cloud.ply", {}));
  pcl::PCLPointCloud2 cloud;
  pcl::PCDReader().readHeader((folder / "cloud.pcd").string(), cloud);
  EXPECT_EQ(cloud.width * cloud.height, 0U);
  EXPECT_EQ(cloud.fields.size(), 6U);
  EXPECT_NE(test::readText(folder / "cloud.ply").find("element vertex 0\n"), std::string::npos);
}

TEST(CloudWriter, NamesThePathAndLeavesNothing_WhenWritingFails) {
  const TemporaryFolder folder;
  const auto file = folder.write("file", "x");
  for (const auto& result :
       {writePcd(file / "cloud.pcd", somePoints()), writePly(file / "cloud.ply", somePoints())}) {
    ASSERT_FALSE(result);
    EXPECT_NE(result.error().what.find((file / "cloud.").string()), std::string::npos);
  }
  EXPECT_EQ(test::readText(file), "x");
}

TEST(CloudWriter, ReportsTheSystemsReason_WhenTheDiskIsFull) {
  const TemporaryFolder folder;
  rlimit before{};
  ASSERT_EQ(getrlimit(RLIMIT_FSIZE, &before), 0);
  std::signal(SIGXFSZ, SIG_IGN);
  const rlimit small{1000, before.rlim_max};  // simulates a full disk
  ASSERT_EQ(setrlimit(RLIMIT_FSIZE, &small), 0);
  const auto pcd = writePcd(folder / "cloud.pcd", somePoints());
  const auto ply = writePly(folder / "cloud.ply", somePoints());
  setrlimit(RLIMIT_FSIZE, &before);
  std::signal(SIGXFSZ, SIG_DFL);
  for (const auto& result : {pcd, ply}) {
    ASSERT_FALSE(result);
    EXPECT_NE(result.error().what.find((folder / "cloud.p").string()), std::string::npos);
    EXPECT_NE(result.error().what.find("File too large"), std::string::npos);
  }
  EXPECT_TRUE(std::filesystem::is_empty(folder.path()));
}

}  // namespace
}  // namespace scantrove
