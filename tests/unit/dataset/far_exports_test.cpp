// Data sets of recordings far from their world's origin: coordinates are the recording's to 0.1 mm, or the
// file states the offset to add.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <filesystem>
#include <sstream>
#include <string>
#include <vector>

#include "tests/unit/dataset/exported.h"
#include "tests/unit/dataset/ply_reader.h"

namespace scantrove::test {
namespace {

constexpr double kTolerance_m = 1e-4;

class FarExportsTest : public testing::TestWithParam<Eigen::Vector3d> {
 protected:
  [[nodiscard]] static Eigen::Vector3d recordingOrigin() { return GetParam(); }
  [[nodiscard]] static Exported nearby(DatasetFormat format) { return Exported(format, smaller); }
  [[nodiscard]] static Exported moved(DatasetFormat format) {
    return Exported(format, [](ScannedScene& scene) {
      smaller(scene);
      scene.origin_m = recordingOrigin();
    });
  }

 private:
  static void smaller(ScannedScene& scene) { scene.frames = 2; }
};

std::vector<Eigen::Vector3d> verticesOf(const PlyFile& ply) {
  std::vector<Eigen::Vector3d> vertices;
  for (std::size_t i = 0; i < ply.size(); ++i)
    vertices.emplace_back(ply.values.at("x")[i], ply.values.at("y")[i], ply.values.at("z")[i]);
  return vertices;
}

std::vector<Eigen::Vector3d> verticesOfObj(const std::string& text) {
  std::vector<Eigen::Vector3d> vertices;
  std::istringstream lines(text);
  for (std::string line; std::getline(lines, line);) {
    std::istringstream words(line);
    std::string kind;
    Eigen::Vector3d vertex;
    if (words >> kind && kind == "v" && words >> vertex.x() >> vertex.y() >> vertex.z())
      vertices.push_back(vertex);
  }
  return vertices;
}

/// The largest distance of `far` from `near` moved by `offset`.
double greatestError(const std::vector<Eigen::Vector3d>& near, const std::vector<Eigen::Vector3d>& far,
                     const Eigen::Vector3d& offset) {
  EXPECT_EQ(near.size(), far.size());
  EXPECT_GT(near.size(), 100U);
  double greatest = 0;
  for (std::size_t i = 0; i < std::min(near.size(), far.size()); ++i)
    greatest = std::max(greatest, (far[i] - near[i] - offset).norm());
  return greatest;
}

Eigen::Vector3d positionIn(const Json& list) {
  return {list.at(0).get<double>(), list.at(1).get<double>(), list.at(2).get<double>()};
}

TEST_P(FarExportsTest, MeshesKeepCoordinatesOfTheRecording) {
  const Exported near = nearby(DatasetFormat::mesh), far = moved(DatasetFormat::mesh);
  ASSERT_EQ(near.files(), far.files());
  for (const std::string& name : near.files()) {
    const std::string ending = std::filesystem::path(name).extension();
    if (ending == ".ply") {
      const PlyFile ply(far.text(name));
      EXPECT_EQ(ply.properties.front(), "double x") << name;
      EXPECT_LT(greatestError(verticesOf(PlyFile(near.text(name))), verticesOf(ply), recordingOrigin()),
                kTolerance_m)
          << name;
    } else if (ending == ".obj") {
      EXPECT_LT(
          greatestError(verticesOfObj(near.text(name)), verticesOfObj(far.text(name)), recordingOrigin()),
          kTolerance_m)
          << name;
    }
  }
}

TEST_P(FarExportsTest, BopCamerasKeepCoordinatesOfTheRecording) {
  const Exported near = nearby(DatasetFormat::bop), far = moved(DatasetFormat::bop);
  const Json cameras = far.json("000001/scene_camera.json");
  ASSERT_EQ(cameras.size(), 2U);
  for (const auto& [frame, camera] : cameras.items()) {
    Eigen::Isometry3d T_camera_world = Eigen::Isometry3d::Identity();
    for (int i = 0; i < 9; ++i)
      T_camera_world.linear()(i / 3, i % 3) =
          camera["cam_R_w2c"].at(static_cast<std::size_t>(i)).get<double>();
    T_camera_world.translation() = positionIn(camera["cam_t_w2c"]) / 1000;
    const Eigen::Isometry3d expected = Eigen::Translation3d(recordingOrigin()) *
                                       far.scene.poseOf(std::stoi(frame)) * far.scene.T_color_depth.inverse();
    EXPECT_LT((T_camera_world.inverse().translation() - expected.translation()).norm(), kTolerance_m)
        << frame;
  }
  // Models have their own frames, and object poses are relative to the camera.
  EXPECT_EQ(far.text("000001/scene_gt.json"), near.text("000001/scene_gt.json"));
  for (const std::string& name : near.files()) {
    if (name.starts_with("models/")) {
      EXPECT_TRUE(far.text(name) == near.text(name)) << name;
    }
  }
}

TEST_P(FarExportsTest, ScannetFilesStateTheOffsetOfTheirFloats) {
  const Exported near = nearby(DatasetFormat::scannet), far = moved(DatasetFormat::scannet);
  ASSERT_EQ(near.files(), far.files());
  std::vector<Eigen::Vector3d> origins;
  for (const std::string& name : near.files()) {
    const std::string ending = std::filesystem::path(name).extension();
    if (ending == ".ply") {
      EXPECT_TRUE(far.text(name) == near.text(name)) << name;
    }
    if (ending != ".txt") continue;
    EXPECT_THAT(near.text(name), testing::Not(testing::HasSubstr("origin")));
    std::istringstream lines(far.text(name));
    for (std::string line; std::getline(lines, line);) {
      if (!line.starts_with("origin = ")) continue;
      std::istringstream numbers(line.substr(9));
      Eigen::Vector3d& origin = origins.emplace_back();
      numbers >> origin.x() >> origin.y() >> origin.z();
    }
  }
  ASSERT_EQ(origins.size(), 1U);
  // The offset is rotated like the surface, by a matrix of floats.
  EXPECT_NEAR(origins[0].norm(), recordingOrigin().norm(), 1e-6 * recordingOrigin().norm());
}

TEST_P(FarExportsTest, LegendsKeepCoordinatesOfTheRecording) {
  const Exported near = nearby(DatasetFormat::mesh), far = moved(DatasetFormat::mesh);
  const Json near_legend = near.json("labels.json"), far_legend = far.json("labels.json");
  ASSERT_EQ(near_legend.size(), far_legend.size());
  for (const auto& [region, entry] : near_legend.items()) {
    const Eigen::Vector3d offset =
        positionIn(far_legend.at(region)["centroid_m"]) - positionIn(entry["centroid_m"]);
    EXPECT_LT((offset - recordingOrigin()).norm(), kTolerance_m) << region;
  }
}

INSTANTIATE_TEST_SUITE_P(Places, FarExportsTest,
                         testing::Values(Eigen::Vector3d(200'000, -30'000, 12),
                                         Eigen::Vector3d(4'100'000, 620'000, 3'800'000)),
                         [](const auto& origin) { return origin.index == 0 ? "At200km" : "At5600km"; });

}  // namespace
}  // namespace scantrove::test
