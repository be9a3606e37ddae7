#include <gtest/gtest.h>

#include "core/dataset/silhouette.h"
#include "core/texturing/depth_raster.h"
#include "tests/unit/dataset/exported.h"
#include "tests/unit/dataset/ply_reader.h"

namespace scantrove::test {
namespace {

SCANTROVE_EXPORTED_ONCE(BopExportTest, DatasetFormat::bop);

Eigen::Matrix3d matrixOf(const Json& list) {
  Eigen::Matrix3d matrix;
  for (int i = 0; i < 9; ++i) matrix(i / 3, i % 3) = list[static_cast<std::size_t>(i)].get<double>();
  return matrix;
}

Eigen::Vector3d vectorOf(const Json& list) {
  return {list[0].get<double>(), list[1].get<double>(), list[2].get<double>()};
}

std::string sixDigits(int number) {
  std::string digits = std::to_string(number);
  return std::string(6 - digits.size(), '0') + digits;
}

TEST_F(BopExportTest, HasTheFilesOfAScene) {
  std::vector<std::string> expected{"camera.json", "labels.json", "models/models_info.json",
                                    "models/obj_000012.ply", "models/obj_000040.ply"};
  for (const char* name : {"scene_camera", "scene_gt", "scene_gt_info"})
    expected.push_back("000001/" + std::string(name) + ".json");
  for (const char* frame : {"000000", "000010", "000020"}) {
    expected.push_back("000001/rgb/" + std::string(frame) + ".jpg");
    expected.push_back("000001/depth/" + std::string(frame) + ".png");
    for (const char* kind : {"mask", "mask_visib"}) {
      for (const char* instance : {"_000000.png", "_000001.png"})
        expected.push_back("000001/" + std::string(kind) + "/" + frame + instance);
    }
  }
  std::sort(expected.begin(), expected.end());
  EXPECT_EQ(exported().files(), expected);
}

TEST_F(BopExportTest, HasTheCameraOfTheColorImages) {
  const Json cameras = exported().json("000001/scene_camera.json");
  ASSERT_EQ(cameras.size(), 3U);
  const Json& camera = cameras["10"];
  EXPECT_EQ(matrixOf(camera["cam_K"]), (Eigen::Matrix3d() << 530, 0, 322, 0, 531, 241, 0, 0, 1).finished());
  EXPECT_EQ(camera["depth_scale"], 1.0);
  const Eigen::Isometry3d T =
      (exported().scene.poseOf(10) * exported().scene.T_color_depth.inverse()).inverse();
  EXPECT_LT((matrixOf(camera["cam_R_w2c"]) - T.linear()).norm(), 1e-9);
  EXPECT_LT((vectorOf(camera["cam_t_w2c"]) - 1000 * T.translation()).norm(), 1e-6) << "mm";
  EXPECT_EQ(exported().image("000001/depth/000010.png").type(), CV_16UC1);
  EXPECT_EQ(exported().image("000001/depth/000010.png").size(), cv::Size(640, 480));
  EXPECT_EQ(exported().json("camera.json")["width"], 640);
}

TEST(BopExport, CorrectsAnErrorOfThePose) {
  const Eigen::Vector3d error(0.012, -0.008, 0.01);
  const Exported exported(DatasetFormat::bop, [&](ScannedScene& scene) { scene.faults.shift_m = error; });
  const Json camera = exported.json("000001/scene_camera.json")["10"];
  const Eigen::Isometry3d T_world_color =
      Eigen::Translation3d(-error) * exported.scene.poseOf(10) * exported.scene.T_color_depth.inverse();
  const Eigen::Isometry3d T = T_world_color.inverse();
  EXPECT_LT((matrixOf(camera["cam_R_w2c"]) - T.linear()).norm(), 0.01) << "half a degree";
  EXPECT_LT((vectorOf(camera["cam_t_w2c"]) - 1000 * T.translation()).norm(), 4) << "mm, of 17";
}

TEST_F(BopExportTest, HasUprightCenteredModelsInMillimeters) {
  const Json infos = exported().json("models/models_info.json");
  const PlyFile box(exported().text("models/obj_000012.ply"));
  const Json& info = infos["12"];
  EXPECT_NEAR(info["size_z"].get<double>(), 200, 0.1) << "upright";
  EXPECT_NEAR(info["min_z"].get<double>(), -100, 0.1);
  // About z, models keep the world's orientation, so their sides are parallel to its axes.
  EXPECT_NEAR(info["size_x"].get<double>(), 180, 0.5);
  EXPECT_NEAR(info["size_y"].get<double>(), 160, 0.5);
  EXPECT_NEAR(info["diameter"].get<double>(), 1000 * (kBoxHigh - kBoxLow).norm(), 0.1);
  EXPECT_NEAR(infos["40"]["diameter"].get<double>(), 180, 0.1);
  for (const char* axis : {"x", "y", "z"}) {
    const auto [low, high] = std::minmax_element(box.values.at(axis).begin(), box.values.at(axis).end());
    EXPECT_NEAR(*low + *high, 0, 0.01) << axis;
  }
  // bop_toolkit reads float, int and uchar from a binary PLY.
  EXPECT_EQ(box.properties, (std::vector<std::string>{"float x", "float y", "float z", "float nx", "float ny",
                                                      "float nz", "uchar red", "uchar green", "uchar blue"}));
  EXPECT_EQ(box.face_property, "list uchar int vertex_indices");
}

// Models rendered at the poses of scene_gt must match the measured depth.
TEST_F(BopExportTest, PlacesModelsOnTheMeasuredDepth) {
  const Json cameras = exported().json("000001/scene_camera.json"),
             poses = exported().json("000001/scene_gt.json");
  int compared = 0;
  for (const int frame : {0, 10, 20}) {
    const Json& camera = cameras[std::to_string(frame)];
    const Eigen::Matrix3d K = matrixOf(camera["cam_K"]);
    cv::Mat depth_mm;
    exported()
        .image("000001/depth/" + sixDigits(frame) + ".png")
        .convertTo(depth_mm, CV_32F, camera["depth_scale"].get<double>());
    int instance = 0;
    for (const Json& pose : poses[std::to_string(frame)]) {
      const PlyFile model(exported().text("models/obj_" + sixDigits(pose["obj_id"].get<int>()) + ".ply"));
      const Eigen::Matrix3d R = matrixOf(pose["cam_R_m2c"]);
      EXPECT_NEAR(R.determinant(), 1, 1e-9);
      std::vector<Eigen::Vector3f> points;
      for (std::size_t i = 0; i < model.size(); ++i) {
        const Eigen::Vector3d p(model.values.at("x")[i], model.values.at("y")[i], model.values.at("z")[i]);
        points.emplace_back((R * p + vectorOf(pose["cam_t_m2c"])).cast<float>());
      }
      const auto number = [&](int row, int column) { return static_cast<float>(K(row, column)); };
      DepthRaster raster({number(0, 0), number(1, 1), number(0, 2), number(1, 2), 640, 480});
      for (const auto& face : model.faces)
        raster.add(points[static_cast<std::size_t>(face[0])], points[static_cast<std::size_t>(face[1])],
                   points[static_cast<std::size_t>(face[2])]);
      const cv::Mat visible =
          exported().image("000001/mask_visib/" + sixDigits(frame) + "_" + sixDigits(instance++) + ".png");
      int pixels = 0, close = 0;
      for (int v = 0; v < 480; ++v) {
        for (int u = 0; u < 640; ++u) {
          const float measured = depth_mm.at<float>(v, u), rendered = raster.depth().at<float>(v, u);
          if (visible.at<std::uint8_t>(v, u) == 0 || measured == 0 || rendered == 0) continue;
          ++pixels;
          if (std::abs(measured - rendered) < 10) ++close;  // noise: 3 mm at 0.8 m
        }
      }
      EXPECT_GT(pixels, 5000);
      EXPECT_GT(close, 0.97 * pixels) << "object " << pose["obj_id"] << " in frame " << frame;
      ++compared;
    }
  }
  EXPECT_EQ(compared, 6);
}

TEST_F(BopExportTest, HasMasksAndPixelCountsOfTheScene) {
  const Json poses = exported().json("000001/scene_gt.json"),
             infos = exported().json("000001/scene_gt_info.json");
  for (const int frame : {0, 10, 20}) {
    const std::string key = std::to_string(frame);
    ASSERT_EQ(poses[key].size(), infos[key].size());
    for (std::size_t instance = 0; instance < poses[key].size(); ++instance) {
      const auto region = poses[key][instance]["obj_id"].get<std::uint32_t>();
      const Json& info = infos[key][instance];
      const std::string file = "/" + sixDigits(frame) + "_" + sixDigits(static_cast<int>(instance)) + ".png";
      const cv::Mat complete = exported().image("000001/mask" + file),
                    visible = exported().image("000001/mask_visib" + file);
      EXPECT_GE(iou(complete, exported().scene.exactMask(frame, region, true)), 0.95);
      EXPECT_GE(iou(visible, exported().scene.exactMask(frame, region)), 0.95);
      EXPECT_EQ(cv::countNonZero(visible & ~complete), 0);
      EXPECT_EQ(info["px_count_visib"], cv::countNonZero(visible));
      EXPECT_EQ(info["px_count_all"], cv::countNonZero(complete)) << "the object is entirely in the image";
      EXPECT_NEAR(info["visib_fract"].get<double>(),
                  double(cv::countNonZero(visible)) / cv::countNonZero(complete), 1e-9);
      const cv::Rect box = boxOf(visible), complete_box = boxOf(complete);
      EXPECT_EQ(info["bbox_visib"], Json({box.x, box.y, box.width, box.height}));
      EXPECT_EQ(info["bbox_obj"],
                Json({complete_box.x, complete_box.y, complete_box.width, complete_box.height}));
      const cv::Mat depth = exported().image("000001/depth/" + sixDigits(frame) + ".png");
      EXPECT_EQ(info["px_count_valid"], cv::countNonZero((depth > 0) & complete));
    }
  }
}

TEST(BopExport, HasOneInstance_WhenARegionHasTwoPieces) {
  const Exported exported(DatasetFormat::bop, [](ScannedScene& scene) {
    scene.frames = 1;
    scene.divided = kBox;
    scene.labels[0].object = 3;  // the ball belongs to the object of the box
  });
  std::multiset<std::uint32_t> regions;
  const Json poses = exported.json("000001/scene_gt.json");
  for (const Json& pose : poses["0"]) regions.insert(pose["obj_id"].get<std::uint32_t>());
  EXPECT_EQ(regions, (std::multiset<std::uint32_t>{kBox, kBall}));
}

TEST(BopExport, KeepsTheUnitsOfDepth) {
  const Exported fine(DatasetFormat::bop, [](ScannedScene& scene) {
    scene.frames = 1;
    scene.meters_per_unit = 0.0002F;
  });
  const Json camera = fine.json("000001/scene_camera.json")["0"];
  EXPECT_EQ(camera["depth_scale"], 0.2);
  const cv::Mat depth = fine.image("000001/depth/000000.png");
  const double z_mm = depth.at<std::uint16_t>(240, 320) * 0.2;
  const auto exact =
      Shapes().renderView(fine.scene.K_color, fine.scene.poseOf(0) * fine.scene.T_color_depth.inverse());
  EXPECT_NEAR(z_mm, 1000 * exact.depth_m.at<float>(240, 320), 10);
}

}  // namespace
}  // namespace scantrove::test
