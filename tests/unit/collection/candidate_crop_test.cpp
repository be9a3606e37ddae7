#include "core/collection/candidate_crop.h"

#include <gtest/gtest.h>

#include <cmath>
#include <opencv2/imgproc.hpp>
#include <vector>

namespace scantrove {
namespace {

const Intrinsics kWorking{290, 290, 159.5F, 119.5F, 320, 240};
const Eigen::Isometry3d kOrigin = Eigen::Isometry3d::Identity();

/// Every pixel encodes its position.
RgbdFrame frameOf(const cv::Size& color, const cv::Size& depth) {
  RgbdFrame frame;
  frame.index = 42;
  frame.meters_per_unit = 0.0002F;
  frame.color.create(color, CV_8UC3);
  for (int y = 0; y < color.height; ++y) {
    for (int x = 0; x < color.width; ++x) {
      frame.color.at<cv::Vec3b>(y, x) = {static_cast<uchar>(x % 256), static_cast<uchar>(y % 256),
                                         static_cast<uchar>(x / 256 + 16 * (y / 256))};
    }
  }
  frame.depth.create(depth, CV_16UC1);
  for (int y = 0; y < depth.height; ++y) {
    for (int x = 0; x < depth.width; ++x) {
      frame.depth.at<std::uint16_t>(y, x) = static_cast<std::uint16_t>(5 * (100 + x + y));
    }
  }
  return frame;
}

cv::Point placeIn(const cv::Mat& color, int x, int y) {
  const cv::Vec3b& pixel = color.at<cv::Vec3b>(y, x);
  return {pixel[0] + 256 * (pixel[2] % 16), pixel[1] + 256 * (pixel[2] / 16)};
}

/// The left half and the bottom row of the box.
Candidate candidateAt(const cv::Rect& box) {
  Candidate candidate;
  candidate.box_px = box;
  candidate.mask = cv::Mat(box.size(), CV_8UC1, cv::Scalar(0));
  candidate.mask(cv::Rect(0, 0, (box.width + 1) / 2, box.height)) = 255;
  candidate.mask.row(box.height - 1) = 255;
  candidate.centroid_world = {1, 2, 3};
  candidate.size_m = {0.3F, 0.2F, 0.1F};
  return candidate;
}

SurfaceInColor registered() { return locateInColor(std::nullopt, {kWorking}); }

TEST(CropView, CropsTheBoxAtFullResolution) {
  const auto view =
      cropView(frameOf({640, 480}, {640, 480}), kOrigin, registered(), candidateAt({10, 20, 30, 40}));
  ASSERT_TRUE(view);
  ASSERT_EQ(view->color.size(), cv::Size(60, 80));
  EXPECT_EQ(placeIn(view->color, 0, 0), cv::Point(20, 40));
  EXPECT_EQ(placeIn(view->color, 59, 79), cv::Point(79, 119));
  ASSERT_EQ(view->mask.size(), view->color.size());
  EXPECT_EQ(view->mask.at<uchar>(0, 0), 255);
  EXPECT_EQ(view->mask.at<uchar>(40, 29), 255);
  EXPECT_EQ(view->mask.at<uchar>(40, 30), 0);
  EXPECT_EQ(view->mask.at<uchar>(79, 58), 255);
  EXPECT_EQ(view->mask.at<uchar>(77, 58), 0);
  ASSERT_EQ(view->depth_mm.size(), view->color.size());
  ASSERT_EQ(view->depth_mm.type(), CV_16UC1);
  EXPECT_EQ(view->depth_mm.at<std::uint16_t>(0, 0), 100 + 20 + 40);  // millimetres
  EXPECT_EQ(view->depth_mm.at<std::uint16_t>(79, 59), 100 + 79 + 119);
  EXPECT_EQ(view->frame_index, 42);
  EXPECT_EQ(view->box_px, cv::Rect(20, 40, 60, 80));
  EXPECT_EQ(view->frame_px, cv::Size(640, 480));
}

TEST(CropView, FollowsColorAndDepth_OfOtherResolutions) {
  const auto view =
      cropView(frameOf({500, 300}, {320, 240}), kOrigin, registered(), candidateAt({7, 9, 11, 13}));
  ASSERT_TRUE(view);
  // 7 * 500 / 320 = 10.9 .. 18 * 500 / 320 = 28.1, and 9 * 300 / 240 = 11.25 .. 27.5, rounded outwards.
  ASSERT_EQ(view->color.size(), cv::Size(29 - 10, 28 - 11));
  EXPECT_EQ(placeIn(view->color, 0, 0), cv::Point(10, 11));
  EXPECT_EQ(view->mask.size(), view->color.size());
  ASSERT_EQ(view->depth_mm.size(), view->color.size());
  EXPECT_EQ(view->depth_mm.at<std::uint16_t>(0, 0), 100 + 6 + 9);  // 10.5 * 320 / 500 = 6.7
  EXPECT_EQ(view->box_px, cv::Rect(7, 9, 11, 13)) << "of the depth image";
  EXPECT_EQ(view->frame_px, cv::Size(320, 240));
}

TEST(CropView, StaysInTheImage_AtItsBorder) {
  const auto view =
      cropView(frameOf({641, 479}, {641, 479}), kOrigin, registered(), candidateAt({300, 220, 20, 20}));
  ASSERT_TRUE(view);
  EXPECT_EQ(view->color.cols, 641 - 600);
  EXPECT_EQ(view->color.rows, 479 - 439);
  EXPECT_EQ(view->mask.size(), view->color.size());
  EXPECT_EQ(view->depth_mm.size(), view->color.size());
}

TEST(CropView, DirectionPointsToTheCamera) {
  Eigen::Isometry3d T_world_camera = kOrigin;
  T_world_camera.translation() = Eigen::Vector3d(1, 2, 1);
  const auto view =
      cropView(frameOf({64, 48}, {64, 48}), T_world_camera, registered(), candidateAt({0, 0, 20, 20}));
  ASSERT_TRUE(view);
  EXPECT_TRUE(view->direction.isApprox(Eigen::Vector3f(0, 0, -1)));
  EXPECT_TRUE(view->T_world_camera.isApprox(T_world_camera));
  EXPECT_EQ(view->size_m, Eigen::Vector3f(0.3F, 0.2F, 0.1F));
}

// ---- colour of a separate camera ----

/// A disc with a rectangle behind its left edge, both upright in front of a wall.
struct Stage {
  static constexpr float kDisc_m = 0.8F, kRectangle_m = 1.2F, kWall_m = 2.0F;
  enum What : uchar { wall, disc, rectangle };

  static bool isOnDisc(const Eigen::Vector3f& p) { return std::hypot(p.x() + 0.1F, p.y()) < 0.12F; }
  static bool isOnRectangle(const Eigen::Vector3f& p) {
    return p.x() > -0.5F && p.x() < -0.2F && std::abs(p.y()) < 0.1F;
  }
  /// The surface on the ray from `eye` along (x, y, 1), and its depth.
  static std::pair<What, float> cast(const Eigen::Vector3f& eye, float x, float y) {
    const auto at = [&](float z) -> Eigen::Vector3f {
      return eye + (z - eye.z()) * Eigen::Vector3f(x, y, 1);
    };
    if (isOnDisc(at(kDisc_m))) return {disc, kDisc_m};
    if (isOnRectangle(at(kRectangle_m))) return {rectangle, kRectangle_m};
    return {wall, kWall_m};
  }
};

ColorCamera besideDepth() {
  ColorCamera camera{{1050, 1050, 640, 500, 1280, 1024}};
  camera.T_color_depth.translation() << -0.025, 0.01, 0;
  return camera;
}

struct StagedFrame {
  RgbdFrame frame;
  cv::Mat labels;  ///< Stage::What by colour pixel
  cv::Mat working_labels = cv::Mat(kWorking.height, kWorking.width, CV_8UC1);  ///< likewise
  std::vector<Eigen::Vector4f> vertices;

  StagedFrame() {
    frame.color_camera = besideDepth();
    const Intrinsics& K = frame.color_camera->K;
    const Eigen::Vector3f eye = -frame.color_camera->T_color_depth.translation().cast<float>();
    labels.create(K.height, K.width, CV_8UC1);
    for (int v = 0; v < K.height; ++v) {
      for (int u = 0; u < K.width; ++u) {
        const Eigen::Vector3f ray = K.backProject(static_cast<float>(u), static_cast<float>(v), 1);
        labels.at<uchar>(v, u) = Stage::cast(eye, ray.x(), ray.y()).first;
      }
    }
    cv::merge(std::vector<cv::Mat>(3, labels), frame.color);
    frame.depth.create(480, 640, CV_16UC1);
    const Intrinsics depth_K = kWorking.resizedTo(640, 480);
    for (int v = 0; v < 480; ++v) {
      for (int u = 0; u < 640; ++u) {
        const Eigen::Vector3f ray = depth_K.backProject(static_cast<float>(u), static_cast<float>(v), 1);
        const float z = Stage::cast(Eigen::Vector3f::Zero(), ray.x(), ray.y()).second;
        frame.depth.at<std::uint16_t>(v, u) = static_cast<std::uint16_t>(std::lround(z * 1000));
      }
    }
    for (int v = 0; v < kWorking.height; ++v) {
      for (int u = 0; u < kWorking.width; ++u) {
        const Eigen::Vector3f ray = kWorking.backProject(static_cast<float>(u), static_cast<float>(v), 1);
        const auto [what, z] = Stage::cast(Eigen::Vector3f::Zero(), ray.x(), ray.y());
        working_labels.at<uchar>(v, u) = what;
        vertices.push_back((ray * z).homogeneous());
      }
    }
  }
  [[nodiscard]] Candidate candidate(Stage::What what) const {
    Candidate candidate;
    const cv::Mat mask = working_labels == what;
    candidate.box_px = cv::boundingRect(mask);
    candidate.mask = mask(candidate.box_px).clone();
    return candidate;
  }
  [[nodiscard]] SurfaceInColor inColor(const Eigen::Isometry3d& T_world_camera) const {
    RenderedView view{kWorking, T_world_camera};
    for (const Eigen::Vector4f& v : vertices)
      view.vertices_world.push_back(T_world_camera.matrix().cast<float>() * v);
    return locateInColor(frame.color_camera, view);
  }
};

/// Pixels in only one of both, as a fraction of the truth's.
double difference(const cv::Mat& mask, const cv::Mat& truth) {
  return static_cast<double>(cv::countNonZero(mask != truth)) / cv::countNonZero(truth);
}

TEST(CropView, CropsTheRightPixels_OfALargerColorImage) {
  const StagedFrame stage;
  RgbdFrame frame = frameOf({1280, 1024}, {640, 480});
  frame.color_camera = besideDepth();
  const Candidate disc = stage.candidate(Stage::disc);
  const auto view = cropView(frame, kOrigin, stage.inColor(kOrigin), disc);
  ASSERT_TRUE(view);
  // The disc spans -0.22 .. 0.02 and -0.12 .. 0.12 of the depth camera at 0.8 m; its image with pixels of
  // 2.8 mm reaches the border to half a pixel.
  const cv::Point first = placeIn(view->color, 0, 0);
  const double half_pixel = 0.5 * 1050 / 290 + 1;
  EXPECT_NEAR(first.x, 1050 * (-0.22 - 0.025) / 0.8 + 640, half_pixel);
  EXPECT_NEAR(first.y, 1050 * (-0.12 + 0.01) / 0.8 + 500, half_pixel);
  EXPECT_NEAR(view->color.cols, 1050 * 0.24 / 0.8, 2 * half_pixel);
  EXPECT_NEAR(view->color.rows, 1050 * 0.24 / 0.8, 2 * half_pixel);
  EXPECT_EQ(placeIn(view->color, view->color.cols - 1, view->color.rows - 1),
            first + cv::Point(view->color.cols - 1, view->color.rows - 1));
  EXPECT_EQ(view->box_px,
            cv::Rect(2 * disc.box_px.x, 2 * disc.box_px.y, 2 * disc.box_px.width, 2 * disc.box_px.height));
  EXPECT_EQ(view->frame_px, cv::Size(640, 480));
}

TEST(CropView, MaskHasTheOutlineOfTheColorImage) {
  const StagedFrame stage;
  Eigen::Isometry3d T_world_camera = kOrigin;
  T_world_camera.translation() << 3, -2, 1;
  T_world_camera.linear() = Eigen::AngleAxisd(0.7, Eigen::Vector3d(1, 2, 3).normalized()).toRotationMatrix();
  const auto view =
      cropView(stage.frame, T_world_camera, stage.inColor(T_world_camera), stage.candidate(Stage::disc));
  ASSERT_TRUE(view);
  std::vector<cv::Mat> channels;
  cv::split(view->color, channels);
  // The outline of 990 pixels with an error of half a pixel everywhere would be 0.7 % of the disc's area.
  EXPECT_LT(difference(view->mask, channels[0] == Stage::disc), 0.01);
  // Depth is registered to colour, to half a working pixel at the outline.
  EXPECT_LT(cv::countNonZero((view->mask == 255) & (view->depth_mm != 800)),
            0.01 * cv::countNonZero(view->mask));
}

TEST(CropView, MaskExcludesOcclusion_OfTheColorCamera) {
  const StagedFrame stage;
  const Candidate rectangle = stage.candidate(Stage::rectangle);
  const auto view = cropView(stage.frame, kOrigin, stage.inColor(kOrigin), rectangle);
  ASSERT_TRUE(view);
  std::vector<cv::Mat> channels;
  cv::split(view->color, channels);
  const cv::Mat truth = channels[0] == Stage::rectangle;
  // 0.025 m * 1050 px * (1 / 0.8 m - 1 / 1.2 m) = 11 pixels along the disc's edge: 6 % of the rectangle.
  EXPECT_LT(cv::countNonZero(view->mask & (channels[0] == Stage::disc)), 0.01 * cv::countNonZero(truth));
  EXPECT_LT(difference(view->mask, truth), 0.04);
  EXPECT_EQ(view->depth_mm.size(), view->color.size());
}

TEST(CropView, GivesNoView_WhenTheColorImageDoesNotShowTheObject) {
  StagedFrame stage;
  stage.frame.color_camera->K.cx = -300;
  EXPECT_FALSE(cropView(stage.frame, kOrigin, stage.inColor(kOrigin), stage.candidate(Stage::disc)));
}

TEST(BoxInColor, SurroundsTheObject) {
  const StagedFrame stage;
  const cv::Rect2f box = boxInColor(stage.inColor(kOrigin), stage.candidate(Stage::disc));
  const double half_pixel = 1.0 / 320;
  EXPECT_NEAR(box.x, (1050 * (-0.22 - 0.025) / 0.8 + 640) / 1280, half_pixel);
  EXPECT_NEAR(box.y, (1050 * (-0.12 + 0.01) / 0.8 + 500) / 1024, half_pixel);
  EXPECT_NEAR(box.width, 1050 * 0.24 / 0.8 / 1280, 2 * half_pixel);
  EXPECT_NEAR(box.height, 1050 * 0.24 / 0.8 / 1024, 2 * half_pixel);
  const cv::Rect2f even = boxInColor(registered(), candidateAt({32, 24, 64, 120}));
  EXPECT_NEAR(even.x, 0.1, 1e-6);
  EXPECT_NEAR(even.y, 0.1, 1e-6);
  EXPECT_NEAR(even.width, 0.2, 1e-6);
  EXPECT_NEAR(even.height, 0.5, 1e-6);
}

}  // namespace
}  // namespace scantrove
