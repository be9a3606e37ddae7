#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <numeric>
#include <sstream>

#include "core/capture/foundation_pose_folder.h"
#include "tests/unit/dataset/exported.h"

namespace scantrove::test {
namespace {

SCANTROVE_EXPORTED_ONCE(FoundationPoseExportTest, DatasetFormat::foundationpose);

const std::string kBallFolder = "000040_ball";

/// The folder whose name begins with `prefix`.
std::string folderOf(const Exported& exported, const std::string& prefix) {
  for (const std::string& name : exported.files()) {
    if (name.starts_with(prefix)) return name.substr(0, name.find('/'));
  }
  ADD_FAILURE() << "no folder " << prefix;
  return {};
}

std::vector<double> numbersIn(const std::string& text) {
  std::istringstream words(text);
  std::vector<double> numbers;
  for (double number = 0; words >> number;) numbers.push_back(number);
  return numbers;
}

Eigen::Matrix4d poseIn(const std::string& text) {
  const std::vector<double> numbers = numbersIn(text);
  EXPECT_EQ(numbers.size(), 16U);
  Eigen::Matrix4d T = Eigen::Matrix4d::Identity();
  for (int i = 0; i < 16 && numbers.size() == 16; ++i) T(i / 4, i % 4) = numbers[static_cast<std::size_t>(i)];
  return T;
}

std::vector<Eigen::Vector3d> verticesOf(const std::string& obj) {
  std::vector<Eigen::Vector3d> vertices;
  std::istringstream lines(obj);
  for (std::string line; std::getline(lines, line);) {
    if (!line.starts_with("v ")) continue;
    const auto numbers = numbersIn(line.substr(2));
    EXPECT_EQ(numbers.size(), 6U) << "place and colour";
    vertices.emplace_back(numbers.at(0), numbers.at(1), numbers.at(2));
  }
  return vertices;
}

TEST_F(FoundationPoseExportTest, HasAFolderForEachObject) {
  const std::string box = folderOf(exported(), "000012_");
  for (const std::string& folder : {kBallFolder, box}) {
    for (const char* frame : {"000000", "000010", "000020"}) {
      for (const std::string kind : {"rgb/", "depth/", "masks/"})
        EXPECT_TRUE(std::filesystem::exists(exported().file(folder + "/" + kind + frame + ".png")));
      EXPECT_TRUE(std::filesystem::exists(exported().file(folder + "/ob_in_cam/" + frame + ".txt")));
    }
    EXPECT_TRUE(std::filesystem::exists(exported().file(folder + "/mesh/model.obj")));
  }
  EXPECT_EQ(exported().files().size(), 2U * (3 * 4 + 2) + 1) << "and labels.json";
  EXPECT_EQ(exported().json("labels.json")["12"]["name"], kBoxName);
  EXPECT_EQ(exported().summary.annotations, 6);
  EXPECT_TRUE(exported().summary.notes.empty());
}

TEST_F(FoundationPoseExportTest, OpensAsARecording) {
  for (const std::string& folder : {kBallFolder, folderOf(exported(), "000012_")}) {
    ASSERT_TRUE(isFoundationPoseFolder(exported().file(folder)));
    const auto source = openFoundationPoseFolder(exported().file(folder), {});
    ASSERT_TRUE(source) << source.error().message();
    const Intrinsics& K = (*source)->info().intrinsics;
    EXPECT_FLOAT_EQ(K.fx, 530);
    EXPECT_FLOAT_EQ(K.fy, 531);
    EXPECT_FLOAT_EQ(K.cx, 322);
    EXPECT_FLOAT_EQ(K.cy, 241);
    EXPECT_EQ(K.width, 640);
    int frames = 0;
    for (FrameRead read = (*source)->next(); read.status != FrameRead::Status::end;
         read = (*source)->next()) {
      ASSERT_EQ(read.status, FrameRead::Status::frame) << read.error.message();
      EXPECT_EQ(read.frame.color.size(), cv::Size(640, 480));
      EXPECT_EQ(read.frame.depth.size(), cv::Size(640, 480));
      ++frames;
    }
    EXPECT_EQ(frames, 3);
  }
}

TEST_F(FoundationPoseExportTest, PosesAreThoseOfTheScene) {
  for (const int frame : {0, 10, 20}) {
    const std::string name =
        "/ob_in_cam/0000" + std::string(frame == 0 ? "00" : std::to_string(frame)) + ".txt";
    const Eigen::Matrix4d T = poseIn(exported().text(kBallFolder + name));
    const Eigen::Isometry3d T_color_world =
        exported().scene.T_color_depth * exported().scene.poseOf(frame).inverse();
    EXPECT_LT((T.topRightCorner<3, 1>() - T_color_world * kBallCenter).norm(), 1e-3) << frame;
    EXPECT_LT((T.block<3, 1>(0, 2) - T_color_world.linear().col(2)).norm(), 0.02) << "z is up in " << frame;
    EXPECT_NEAR((T.topLeftCorner<3, 3>().determinant()), 1, 1e-6);
    EXPECT_EQ(T.row(3), Eigen::RowVector4d(0, 0, 0, 1));
  }
}

TEST_F(FoundationPoseExportTest, ModelsAreCentredInMeters) {
  const std::pair<std::string, Eigen::Vector3d> expected[] = {
      {kBallFolder, Eigen::Vector3d::Constant(2 * kBallRadius)},
      {folderOf(exported(), "000012_"), kBoxHigh - kBoxLow}};
  for (const auto& [folder, size] : expected) {
    const auto vertices = verticesOf(exported().text(folder + "/mesh/model.obj"));
    ASSERT_FALSE(vertices.empty());
    Eigen::AlignedBox3d box;
    for (const Eigen::Vector3d& vertex : vertices) box.extend(vertex);
    EXPECT_LT(box.center().norm(), 1e-5);
    EXPECT_LT((box.sizes() - size).cwiseAbs().maxCoeff(), 0.01) << folder;
  }
}

/// The model in its pose lies on the mask's pixels, at the depth image's depth.
TEST_F(FoundationPoseExportTest, ModelsFitMasksAndDepth) {
  const Eigen::Matrix4d T = poseIn(exported().text(kBallFolder + "/ob_in_cam/000010.txt"));
  const cv::Mat mask = exported().image(kBallFolder + "/masks/000010.png");
  const cv::Mat depth = exported().image(kBallFolder + "/depth/000010.png");
  ASSERT_EQ(mask.type(), CV_8UC1);
  ASSERT_EQ(depth.type(), CV_16UC1);
  EXPECT_GE(iou(mask, exported().scene.exactMask(10, kBall)), 0.95);
  const Eigen::Vector3d center = T.topRightCorner<3, 1>();
  std::vector<double> differences;
  int inside = 0, seen = 0;
  for (const Eigen::Vector3d& vertex : verticesOf(exported().text(kBallFolder + "/mesh/model.obj"))) {
    const Eigen::Vector3d p = T.topLeftCorner<3, 3>() * vertex + center;
    if ((p - center).dot(p) > -0.3 * p.norm() * (p - center).norm()) continue;  // faces away, or nearly
    const int u = static_cast<int>(std::lround(530 * p.x() / p.z() + 322)),
              v = static_cast<int>(std::lround(531 * p.y() / p.z() + 241));
    ++seen;
    if (mask.at<std::uint8_t>(v, u) == 0) continue;
    ++inside;
    if (depth.at<std::uint16_t>(v, u) > 0)
      differences.push_back(depth.at<std::uint16_t>(v, u) / 1000.0 - p.z());
  }
  ASSERT_GT(seen, 100);
  EXPECT_GT(inside, 0.97 * seen);
  ASSERT_GT(differences.size(), 50U);
  std::nth_element(differences.begin(), differences.begin() + differences.size() / 2, differences.end());
  EXPECT_NEAR(differences[differences.size() / 2], 0, 0.003) << "m";
}

TEST_F(FoundationPoseExportTest, ImagesAreTheRecordedOnesAsPng) {
  const cv::Mat written = exported().image(kBallFolder + "/rgb/000010.png");
  const auto recorded = readColorImage(exported().scene.fileOf(10));
  ASSERT_TRUE(recorded);
  ASSERT_EQ(written.type(), CV_8UC3);
  EXPECT_EQ(cv::norm(written, *recorded, cv::NORM_INF), 0);
}

TEST(FoundationPoseExport, NamesHaveNoRgb_WhichItsReaderReplaces) {
  const Exported exported(DatasetFormat::foundationpose, [](ScannedScene& scene) {
    scene.frames = 1;
    scene.labels[0].name = "rgb cube rgb";
  });
  EXPECT_TRUE(std::filesystem::exists(exported.file("000040_r_g_b_cube_r_g_b/cam_K.txt")));
}

/// Frames from 20 on have another focal length.
struct RefocusedScene : ScannedScene {
  Result<std::vector<KeyFrameInfo>> keyFrames(bool all_frames) override {
    auto infos = ScannedScene::keyFrames(all_frames);
    for (KeyFrameInfo& info : *infos) {
      if (info.index >= 20) info.K_color.fx += 10;
      if (info.index == 10) info.K_color.fx += 0.2F;  // moves no pixel by one
    }
    return infos;
  }
};

TEST(FoundationPoseExport, HasAFolderForEachCamera_WhenItChanges) {
  RefocusedScene scene;
  const TemporaryFolder home;
  const auto summary = exportDataset(
      scene, {.format = DatasetFormat::foundationpose, .folder = home / "out", .include_unfit = true});
  ASSERT_TRUE(summary) << summary.error().message();
  EXPECT_EQ(Exported::filesIn(home / "out" / kBallFolder / "rgb"),
            (std::vector<std::string>{"000000.png", "000010.png"}));
  EXPECT_EQ(Exported::filesIn(home / "out" / (kBallFolder + "_camera2") / "rgb"),
            std::vector<std::string>{"000020.png"});
  EXPECT_EQ(numbersIn(readText(home / "out" / kBallFolder / "cam_K.txt")).at(0), 530);
  EXPECT_EQ(numbersIn(readText(home / "out" / (kBallFolder + "_camera2") / "cam_K.txt")).at(0), 540);
  ASSERT_EQ(summary->notes.size(), 1U);
  EXPECT_NE(summary->notes[0].find("2 intrinsics"), std::string::npos) << summary->notes[0];
}

TEST(FoundationPoseExport, JoinsRegionsOfAnObject) {
  const Exported exported(DatasetFormat::foundationpose, [](ScannedScene& scene) {
    scene.frames = 1;
    scene.labels[0].object = 3;  // the ball belongs to the object of the box
  });
  const std::string folder = folderOf(exported, "000012_");
  EXPECT_FALSE(std::filesystem::exists(exported.file(kBallFolder)));
  const cv::Mat exact = exported.scene.exactMask(0, kBox) | exported.scene.exactMask(0, kBall);
  EXPECT_GE(iou(exported.image(folder + "/masks/000000.png"), exact), 0.95);
}

}  // namespace
}  // namespace scantrove::test
