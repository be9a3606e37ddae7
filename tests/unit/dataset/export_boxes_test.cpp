#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <sstream>

#include "tests/unit/dataset/exported.h"

namespace scantrove::test {
namespace {

SCANTROVE_EXPORTED_ONCE(BoxExportTest, DatasetFormat::boxes);

Eigen::MatrixXd numbersIn(const std::string& text, int columns) {
  std::istringstream words(text);
  Eigen::MatrixXd matrix(3, columns);
  for (int i = 0; i < 3 * columns; ++i) words >> matrix(i / columns, i % columns);
  EXPECT_TRUE(words);
  return matrix;
}

const Json& objectNamed(const Json& objects, const std::string& name) {
  for (const Json& object : objects) {
    if (object["name"] == name) return object;
  }
  throw std::runtime_error("no object " + name);
}

/// A box as SUN RGB-D's toolbox reads it, in its frame: x right, y forward, z up.
struct ToolboxBox {
  Eigen::Vector3d centroid, coeffs;
  Eigen::Vector3d first_axis;

  explicit ToolboxBox(const Json& polygon) {
    const auto x = polygon["X"].get<std::vector<double>>(), y = polygon["Z"].get<std::vector<double>>();
    const Eigen::Vector3d v1(x[1] - x[0], y[1] - y[0], 0), v2(x[2] - x[1], y[2] - y[1], 0);
    const double zmax = -polygon["Ymax"].get<double>(), zmin = -polygon["Ymin"].get<double>();
    coeffs = Eigen::Vector3d(v1.norm(), v2.norm(), std::abs(zmax - zmin)) / 2;
    centroid = {(x[0] + x[2]) / 2, (y[0] + y[2]) / 2, (zmin + zmax) / 2};
    first_axis = v1.normalized();
    EXPECT_GT(zmax, zmin);
    EXPECT_NEAR(v1.normalized().dot(v2.normalized()), 0, 1e-9);
  }
};

TEST_F(BoxExportTest, HasTheFiles) {
  std::vector<std::string> expected{"boxes.json", "labels/_classes.json", "labels/scene.json",
                                    "pointclouds/scene.ply"};
  for (const std::string frame : {"000000", "000010", "000020"}) {
    const std::string folder = "sunrgbd/" + frame + "/";
    for (const std::string& name :
         {std::string("annotation3Dfinal/index.json"), "depth/" + frame + ".png",
          "extrinsics/" + frame + ".txt", "image/" + frame + ".jpg", std::string("intrinsics.txt")})
      expected.push_back(folder + name);
  }
  EXPECT_EQ(exported().files(), expected);
  EXPECT_EQ(exported().text("sunrgbd/000010/image/000010.jpg"), readText(exported().scene.fileOf(10)));
}

TEST_F(BoxExportTest, LabelCloudHasBoxesInTheFrameOfItsCloud) {
  const Json labels = exported().json("labels/scene.json");
  EXPECT_EQ(labels["folder"], "pointclouds");
  EXPECT_EQ(labels["filename"], "scene.ply");
  EXPECT_EQ(labels["path"], "pointclouds/scene.ply");
  ASSERT_EQ(labels["objects"].size(), 2U);
  const Json& box = objectNamed(labels["objects"], "box");
  const Eigen::Vector3d size = kBoxHigh - kBoxLow, center = (kBoxHigh + kBoxLow) / 2;
  EXPECT_NEAR(box["dimensions"]["length"].get<double>(), size.x(), 0.01);
  EXPECT_NEAR(box["dimensions"]["width"].get<double>(), size.y(), 0.01);
  EXPECT_NEAR(box["dimensions"]["height"].get<double>(), size.z(), 0.01);
  EXPECT_NEAR(box["centroid"]["z"].get<double>(), center.z(), 0.01) << "z is up";
  EXPECT_EQ(box["rotations"]["x"], 0);
  EXPECT_NEAR(std::remainder(box["rotations"]["z"].get<double>(), 180.0), 0, 1);
  const Json& ball = objectNamed(labels["objects"], "ball");
  EXPECT_NEAR(ball["centroid"]["x"].get<double>(), kBallCenter.x(), 0.01);
  EXPECT_NEAR(ball["dimensions"]["height"].get<double>(), 2 * kBallRadius, 0.01);
  const Json classes = exported().json("labels/_classes.json");
  EXPECT_EQ(classes["format"], "centroid_abs");
  EXPECT_EQ(classes["classes"][0]["name"], "ball");
  EXPECT_EQ(classes["classes"][1]["id"], 2) << "ids as in COCO files, from 1";
}

TEST_F(BoxExportTest, ListsInstances) {
  const Json all = exported().json("boxes.json");
  const Json& box = objectNamed(all["boxes"], kBoxName);
  EXPECT_EQ(box["instance"], kBox);
  EXPECT_EQ(box["class"], "box");
  EXPECT_EQ(box["object"], 3);
  EXPECT_NEAR(all["T_world_scene"][2][2].get<double>(), 1, 1e-3) << "the scene's up is the world's";
}

TEST_F(BoxExportTest, FramesHaveBoxesAsSunRgbdReadsThem) {
  const Eigen::Vector3d world_center = (kBoxHigh + kBoxLow) / 2;
  for (const int frame : {0, 10, 20}) {
    const std::string stem = "0000" + std::string(frame == 0 ? "00" : std::to_string(frame));
    const std::string folder = "sunrgbd/" + stem + "/";
    const Eigen::MatrixXd extrinsics = numbersIn(exported().text(folder + "extrinsics/" + stem + ".txt"), 4);
    const Eigen::Matrix3d R = extrinsics.leftCols<3>();
    EXPECT_NEAR(R.determinant(), 1, 1e-6);
    EXPECT_TRUE(extrinsics.col(3).isZero());
    const Eigen::Isometry3d T_color_world =
        exported().scene.T_color_depth * exported().scene.poseOf(frame).inverse();
    const Eigen::Vector3d down = R * (T_color_world.linear() * -Eigen::Vector3d::UnitZ());
    EXPECT_LT((down - Eigen::Vector3d::UnitY()).norm(), 0.02) << "y points down";
    const Eigen::Vector3d level = R * (T_color_world * world_center);
    const Json annotation = exported().json(folder + "annotation3Dfinal/index.json");
    const ToolboxBox box(objectNamed(annotation["objects"], "box")["polygon"][0]);
    EXPECT_LT((box.centroid - Eigen::Vector3d(level.x(), level.z(), -level.y())).norm(), 0.01) << frame;
    EXPECT_GT(box.centroid.y(), 0.3) << "in front of the camera";
    EXPECT_LT((2 * box.coeffs - Eigen::Vector3d(0.18, 0.16, 0.2)).cwiseAbs().maxCoeff(), 0.01);
    EXPECT_EQ(numbersIn(exported().text(folder + "intrinsics.txt"), 3)(1, 2), 241);
  }
}

TEST_F(BoxExportTest, DepthHasItsBitsTurnedAsInSunRgbd) {
  const cv::Mat stored = exported().image("sunrgbd/000010/depth/000010.png");
  ASSERT_EQ(stored.type(), CV_16UC1);
  const cv::Mat exact =
      Shapes()
          .renderView(exported().scene.K_color,
                      exported().scene.poseOf(10) * exported().scene.T_color_depth.inverse())
          .depth_m;
  std::vector<double> differences;
  for (int y = 0; y < stored.rows; y += 3) {
    for (int x = 0; x < stored.cols; x += 3) {
      const unsigned value = stored.at<std::uint16_t>(y, x);
      const unsigned mm = (value >> 3U | value << 13U) & 0xFFFFU;
      if (mm > 0 && exact.at<float>(y, x) > 0)
        differences.push_back(std::abs(mm / 1000.0 - double{exact.at<float>(y, x)}));
    }
  }
  ASSERT_GT(differences.size(), 1000U);
  const auto middle = differences.begin() + static_cast<std::ptrdiff_t>(differences.size() / 2);
  std::nth_element(differences.begin(), middle, differences.end());
  EXPECT_LT(*middle, 0.004);
}

TEST(BoxExport, LeavesBoxesOut_WithoutSurface) {
  const Exported exported(DatasetFormat::boxes, [](ScannedScene& scene) {
    scene.frames = 1;
    scene.labels[4].name = "ghost";
  });
  EXPECT_EQ(exported.json("labels/scene.json")["objects"].size(), 2U);
  ASSERT_EQ(exported.summary.notes.size(), 1U);
  EXPECT_NE(exported.summary.notes[0].find("ghost"), std::string::npos);
}

}  // namespace
}  // namespace scantrove::test
