#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <map>
#include <opencv2/imgproc.hpp>
#include <set>

#include "core/fusion/color_projection.h"
#include "core/synthetic/bumpy_shape.h"
#include "core/synthetic/synthetic_source.h"
#include "tests/support/test_scenes.h"

namespace scantrove {
namespace {

using MakeScene = synthetic::SceneRecipe (*)();
constexpr double kDegree = 3.14159265358979 / 180;

SyntheticOptions exactOptions(MakeScene recipe) {
  SyntheticOptions options;
  options.recipe = recipe;
  options.K = options.K.resizedTo(160, 120);
  options.noise = false;
  options.color = false;
  return options;
}

std::unique_ptr<SyntheticSource> open(const SyntheticOptions& options) {
  auto source = makeSyntheticSource(options);
  EXPECT_TRUE(source) << (source ? "" : source.error().message());
  return std::move(*source);
}

RgbdFrame frameAt(SyntheticOptions options, int index) {
  options.start = index;
  FrameRead read = open(options)->next();
  EXPECT_EQ(read.status, FrameRead::Status::frame);
  return read.frame;
}

synthetic::SceneRecipe makeRandomRoom() { return synthetic::makeRandomRoomScene(4); }

synthetic::SceneRecipe makeBumpyRoom() {
  synthetic::SceneRecipe recipe = makeRandomRoom();
  recipe.scene = synthetic::makeBumpy(std::move(recipe.scene), 4);
  return recipe;
}

class EverySceneTest : public testing::TestWithParam<MakeScene> {};
INSTANTIATE_TEST_SUITE_P(Scenes, EverySceneTest,
                         testing::Values(&synthetic::makeTabletopScene, &synthetic::makeRoomScene,
                                         &test::makeLBlockScene, &test::makeChairFloorScene, &makeRandomRoom,
                                         &makeBumpyRoom));

TEST_P(EverySceneTest, DepthAndInstancesMatchTheGeometry) {
  SyntheticOptions options = exactOptions(GetParam());
  options.stride = 49;
  const auto source = open(options);
  const Intrinsics& K = options.K;
  for (FrameRead read = source->next(); read.status == FrameRead::Status::frame; read = source->next()) {
    const Eigen::Isometry3d T = *read.frame.T_world_camera;
    EXPECT_TRUE(T.isApprox(source->pose(read.frame.index), 1e-12));
    for (int v = 0; v < K.height; v += 3) {
      for (int u = 0; u < K.width; u += 3) {
        const Eigen::Vector3d ray((u - double{K.cx}) / K.fx, (v - double{K.cy}) / K.fy, 1);
        const RayHit hit = source->scene().cast(T.translation(), T.linear() * ray);
        ASSERT_EQ(read.frame.instances.at<std::uint16_t>(v, u), hit.instance) << u << " " << v;
        const double z = read.frame.depth.at<std::uint16_t>(v, u) * 0.001;
        ASSERT_NEAR(z, hit.hit() ? hit.distance : 0, 0.00051) << u << " " << v;
        if (hit.hit()) {
          ASSERT_LE(hit.normal.dot(T.linear() * ray), 0);
          ASSERT_NEAR(hit.normal.norm(), 1, 1e-9);
        }
      }
    }
  }
}

TEST_P(EverySceneTest, FramesAgree_WhenTransformedByTheirPoses) {
  SyntheticOptions options = exactOptions(GetParam());
  options.K = options.K.resizedTo(320, 240);
  options.meters_per_unit = 0.0001F;
  const Intrinsics& K = options.K;
  const RgbdFrame a = frameAt(options, 30);
  const RgbdFrame b = frameAt(options, 60);
  const Eigen::Isometry3f T_b_a = (b.T_world_camera->inverse() * *a.T_world_camera).cast<float>();
  int seen = 0;
  int agreeing = 0;
  int same_instance = 0;
  for (int v = 0; v < K.height; ++v) {
    for (int u = 0; u < K.width; ++u) {
      const float z = static_cast<float>(a.depth.at<std::uint16_t>(v, u)) * a.meters_per_unit;
      const Eigen::Vector3f p = T_b_a * K.backProject(static_cast<float>(u), static_cast<float>(v), z);
      const int bu = static_cast<int>(std::floor(K.fx * p.x() / p.z() + K.cx + 0.5F));
      const int bv = static_cast<int>(std::floor(K.fy * p.y() / p.z() + K.cy + 0.5F));
      if (z == 0 || bu < 1 || bv < 1 || bu >= K.width - 1 || bv >= K.height - 1) {
        continue;
      }
      // Depth may change by the slope within half a pixel: compare with the range of the 3 x 3 neighbourhood.
      double low = 0;
      double high = 0;
      cv::minMaxLoc(b.depth(cv::Rect(bu - 1, bv - 1, 3, 3)), &low, &high);
      const double scale = double{b.meters_per_unit};
      if (p.z() > high * scale + 0.005) {
        continue;  // hidden in b
      }
      ++seen;
      agreeing += p.z() > low * scale - 0.002 ? 1 : 0;
      const cv::Mat around = b.instances(cv::Rect(bu - 1, bv - 1, 3, 3));
      same_instance += cv::countNonZero(around == a.instances.at<std::uint16_t>(v, u)) > 0 ? 1 : 0;
    }
  }
  EXPECT_GT(seen, K.pixels() / 3);
  EXPECT_GT(agreeing, 0.998 * seen);
  EXPECT_GT(same_instance, 0.995 * seen);
}

TEST_P(EverySceneTest, CameraMovesAtHandSpeed) {
  SyntheticOptions options = exactOptions(GetParam());
  const auto source = open(options);
  double path_m = 0;
  for (int i = 0; i + 1 < *source->info().frame_count; ++i) {
    const Eigen::Isometry3d step = source->pose(i).inverse() * source->pose(i + 1);
    EXPECT_LT(step.translation().norm() * 30, 0.45) << "m/s at frame " << i;
    EXPECT_LT(Eigen::AngleAxisd(step.linear()).angle() * 30, 32 * kDegree) << "rad/s at frame " << i;
    EXPECT_GT(step.translation().norm() + Eigen::AngleAxisd(step.linear()).angle(), 1e-6)
        << "the camera never stops";
    path_m += step.translation().norm();
  }
  EXPECT_LT(path_m * 30 / *source->info().frame_count, 0.35) << "m/s on average";
  EXPECT_GT(path_m, 0.5);
}

TEST_P(EverySceneTest, NamesMatchTheMasks) {
  const synthetic::SceneRecipe recipe = GetParam()();
  const std::vector<InstanceName>& names = recipe.scene.instances();
  ASSERT_FALSE(names.empty());
  EXPECT_EQ(names.front().name, "floor");
  std::set<std::string> different;
  for (std::size_t i = 0; i < names.size(); ++i) {
    EXPECT_EQ(names[i].id, i + 1);
    different.insert(names[i].name);
  }
  EXPECT_EQ(different.size(), names.size());
}

class DemoSceneTest : public testing::TestWithParam<MakeScene> {};
INSTANTIATE_TEST_SUITE_P(Demos, DemoSceneTest,
                         testing::Values(&synthetic::makeTabletopScene, &synthetic::makeRoomScene));

TEST_P(DemoSceneTest, ShowsAtLeastTwelveObjectsAndSeveralNonConvex) {
  SyntheticOptions options = exactOptions(GetParam());
  options.stride = 25;
  const auto source = open(options);
  std::map<std::uint16_t, int> best_area;
  for (FrameRead read = source->next(); read.status == FrameRead::Status::frame; read = source->next()) {
    std::map<std::uint16_t, int> area;
    for (int v = 0; v < options.K.height; ++v) {
      for (int u = 0; u < options.K.width; ++u) {
        ++area[read.frame.instances.at<std::uint16_t>(v, u)];
      }
    }
    for (const auto& [id, pixels] : area) {
      best_area[id] = std::max(best_area[id], pixels);
    }
  }
  int objects = 0;
  int non_convex = 0;
  for (const InstanceName& instance : source->scene().instances()) {
    const bool visible = best_area[instance.id] >= 500 / 16;  // 500 pixels at 640 x 480
    objects += instance.is_object && visible ? 1 : 0;
    non_convex += instance.is_object && instance.non_convex && visible ? 1 : 0;
  }
  EXPECT_GE(objects, 12);
  EXPECT_GE(non_convex, 5);
}

/// Areas of an instance's connected components, largest first, as fractions of the image.
std::vector<double> piecesOf(const RgbdFrame& frame, std::uint16_t instance) {
  const cv::Mat mask = frame.instances == instance;
  cv::Mat labels;
  cv::Mat statistics;
  cv::Mat centers;
  const int count = cv::connectedComponentsWithStats(mask, labels, statistics, centers, 8);
  std::vector<double> areas;
  for (int i = 1; i < count; ++i) {
    areas.push_back(statistics.at<int>(i, cv::CC_STAT_AREA) / static_cast<double>(mask.total()));
  }
  std::sort(areas.rbegin(), areas.rend());
  return areas;
}

class ChairOnFloorTest : public testing::TestWithParam<MakeScene> {};
INSTANTIATE_TEST_SUITE_P(Scenes, ChairOnFloorTest,
                         testing::Values(&synthetic::makeRoomScene, &test::makeChairFloorScene));

TEST_P(ChairOnFloorTest, SplitsTheFloor_OnlyInFirstFrames) {
  SyntheticOptions options = exactOptions(GetParam());
  options.K = options.K.resizedTo(320, 240);
  for (const int frame : {0, 5, 10}) {
    const std::vector<double> first = piecesOf(frameAt(options, frame), 1);
    ASSERT_GE(first.size(), 3U) << "left, right and between the legs; frame " << frame;
    EXPECT_GT(first[1], 0.05);
    EXPECT_GT(first[2], 0.02);
  }
  const std::vector<double> later = piecesOf(frameAt(options, 110), 1);
  EXPECT_GT(later[0], 0.2);
  EXPECT_TRUE(later.size() == 1 || later[1] < 0.02);
}

TEST(LBlock, ShowsItsConnectingSide_OnlyInLaterFrames) {
  SyntheticOptions options = exactOptions(&test::makeLBlockScene);
  options.stride = 1;
  const auto source = open(options);
  const std::uint16_t block = source->scene().find("L block");
  ASSERT_NE(block, 0);
  const Intrinsics& K = options.K;
  /// Numbers of pixels of the block and of its sides (normal +-y).
  const auto count = [&](int frame) {
    const Eigen::Isometry3d T = source->pose(frame);
    std::pair<int, int> pixels{0, 0};
    for (int v = 0; v < K.height; ++v) {
      for (int u = 0; u < K.width; ++u) {
        const Eigen::Vector3d ray((u - double{K.cx}) / K.fx, (v - double{K.cy}) / K.fy, 1);
        const RayHit hit = source->scene().cast(T.translation(), T.linear() * ray);
        pixels.first += hit.instance == block ? 1 : 0;
        pixels.second += hit.instance == block && std::abs(hit.normal.y()) > 0.95 ? 1 : 0;
      }
    }
    return pixels;
  };
  const auto [first, first_side] = count(0);
  const auto [later, later_side] = count(140);
  EXPECT_GT(first, 800);
  EXPECT_LT(first_side, 0.01 * first);
  EXPECT_GT(later_side, 0.15 * later);
}

TEST(SyntheticSource, ReturnsEqualFramesOnly_WhenSeedsAreEqual) {
  SyntheticOptions options = exactOptions(&synthetic::makeTabletopScene);
  options.noise = true;
  options.color = true;
  const RgbdFrame a = frameAt(options, 7);
  const RgbdFrame b = frameAt(options, 7);
  options.seed = 2;
  const RgbdFrame c = frameAt(options, 7);
  EXPECT_EQ(cv::countNonZero(a.depth != b.depth), 0);
  EXPECT_EQ(cv::norm(a.color, b.color, cv::NORM_INF), 0);
  EXPECT_TRUE(a.T_world_camera->matrix() == b.T_world_camera->matrix());
  EXPECT_GT(cv::countNonZero(a.depth != c.depth), 1000);
  EXPECT_FALSE(a.T_world_camera->matrix() == c.T_world_camera->matrix());
}

// A surface point has the same colour in both cameras.
TEST(SyntheticSource, RendersColorFromItsCamera_WhenItIsSeparate) {
  SyntheticOptions options = exactOptions(&synthetic::makeTabletopScene);
  options.color = true;
  const RgbdFrame straight = frameAt(options, 30);
  EXPECT_FALSE(straight.color_camera);
  options.color_camera = ColorCamera{{270, 270, 160, 128, 320, 256}};
  options.color_camera->T_color_depth = Eigen::Translation3d(-0.08, 0.02, 0.01) *
                                        Eigen::AngleAxisd(0.03, Eigen::Vector3d(1, 2, 3).normalized());
  const RgbdFrame frame = frameAt(options, 30);
  ASSERT_TRUE(frame.color_camera);
  ASSERT_EQ(frame.color.size(), cv::Size(320, 256));
  EXPECT_EQ(cv::countNonZero(frame.depth != straight.depth), 0);
  RenderedView view{options.K};
  std::vector<Eigen::Vector4f>& vertices = view.vertices_world;
  for (int v = 0; v < options.K.height; ++v) {
    for (int u = 0; u < options.K.width; ++u) {
      const float z = static_cast<float>(frame.depth.at<std::uint16_t>(v, u)) * frame.meters_per_unit;
      vertices.emplace_back(Eigen::Vector4f::Zero());
      if (z > 0)
        vertices.back() =
            options.K.backProject(static_cast<float>(u), static_cast<float>(v), z).homogeneous();
    }
  }
  const SurfaceInColor seen = locateInColor(frame.color_camera, view);
  cv::Mat looked_up, shown, off;
  cv::remap(frame.color, looked_up, pixelsOf(seen.places, frame.color.size()), {}, cv::INTER_LINEAR);
  cv::absdiff(looked_up, straight.color, off);
  cv::transform(off, off, cv::Matx13f(1 / 3.F, 1 / 3.F, 1 / 3.F));
  const int visible = cv::countNonZero(seen.hidden == 0);
  EXPECT_GT(visible, 0.8 * static_cast<double>(seen.hidden.total()));
  EXPECT_LT(visible, 0.995 * static_cast<double>(seen.hidden.total()))
      << "from 0.08 m to the side, objects occlude others";
  EXPECT_LT(cv::countNonZero((off > 20) & (seen.hidden == 0)), 0.04 * visible);
  cv::resize(frame.color, shown, straight.color.size(), 0, 0, cv::INTER_AREA);
  cv::absdiff(shown, straight.color, off);
  cv::transform(off, off, cv::Matx13f(1 / 3.F, 1 / 3.F, 1 / 3.F));
  EXPECT_GT(cv::countNonZero(off > 20), 0.12 * static_cast<double>(seen.hidden.total()))
      << "without registration the colours differ";
}

TEST(SyntheticSource, UsesTheSeed_WhenTheNameEndsInANumber) {
  SyntheticOptions options;
  options.recipe = [] { return synthetic::makeRandomTabletopScene(7); };
  options.seed = 7;
  const auto by_name = makeSyntheticSource("tabletop:7", {});
  ASSERT_TRUE(by_name) << by_name.error().message();
  EXPECT_EQ(cv::countNonZero((*by_name)->next().frame.depth != frameAt(options, 0).depth), 0);
}

TEST(SyntheticSource, NoiseKeepsMostReadingsNearTheTruth) {
  SyntheticOptions options = exactOptions(&synthetic::makeTabletopScene);
  options.K = options.K.resizedTo(640, 480);
  const RgbdFrame exact = frameAt(options, 20);
  options.noise = true;
  const RgbdFrame noisy = frameAt(options, 20);
  int readings = 0;
  int close = 0;
  for (int v = 0; v < 480; ++v) {
    for (int u = 0; u < 640; ++u) {
      const double z = noisy.depth.at<std::uint16_t>(v, u) * 0.001;
      const double truth = exact.depth.at<std::uint16_t>(v, u) * 0.001;
      readings += z > 0 ? 1 : 0;
      close += z > 0 && std::abs(z - truth) < 0.01 + 0.012 * truth * truth ? 1 : 0;
    }
  }
  EXPECT_GT(readings, 0.85 * 640 * 480);
  EXPECT_LT(readings, 0.99 * 640 * 480) << "shadows and dropouts have no readings";
  EXPECT_GT(close, 0.98 * readings);
}

TEST(SyntheticSource, DescribesItsFrames) {
  SourceOptions options;
  options.start = 10;
  options.stride = 3;
  options.frames = 2;
  options.depth_scale = 5000;
  options.intrinsics = Intrinsics{600, 610, 300, 200, 0, 0};
  const auto source = makeSyntheticSource("", options);
  ASSERT_TRUE(source);
  const SourceInfo& info = (*source)->info();
  EXPECT_EQ(info.kind, "synthetic");
  EXPECT_EQ(info.name, "tabletop");
  EXPECT_EQ(info.frame_count, 2);
  EXPECT_TRUE(info.has_poses);
  EXPECT_FALSE(info.is_live);
  EXPECT_EQ(info.intrinsics, (Intrinsics{600, 610, 300, 200, 640, 480}));
  const FrameRead first = (*source)->next();
  const FrameRead second = (*source)->next();
  EXPECT_EQ(first.frame.index, 10);
  EXPECT_EQ(second.frame.index, 13);
  EXPECT_NEAR(second.frame.timestamp_s, 13 / 30.0, 1e-9);
  EXPECT_FLOAT_EQ(first.frame.meters_per_unit, 0.0002F);
  EXPECT_EQ(first.frame.color.type(), CV_8UC3);
  EXPECT_EQ(first.frame.depth.type(), CV_16UC1);
  EXPECT_EQ(first.frame.instances.size(), first.frame.depth.size());
  EXPECT_EQ((*source)->next().status, FrameRead::Status::end);
  EXPECT_EQ((*source)->next().status, FrameRead::Status::end);
}

TEST(SyntheticSource, UsesTheScenesLength_WhenNoneIsGiven) {
  EXPECT_EQ((*makeSyntheticSource("tabletop", {}))->info().frame_count, 300);
  EXPECT_EQ((*makeSyntheticSource("room", {}))->info().frame_count, 400);
  SourceOptions options;
  options.stride = 7;
  EXPECT_EQ((*makeSyntheticSource("room:exact", options))->info().frame_count, 58);
  options.frames = 1000;
  EXPECT_EQ((*makeSyntheticSource("room:exact", options))->info().frame_count, 58);
  EXPECT_EQ((*makeSyntheticSource("room:3", {}))->info().frame_count, 300);
  EXPECT_EQ((*makeSyntheticSource("tabletop:3", {}))->info().frame_count, 240);
}

TEST(SyntheticSource, Fails_WhenOptionsAreInvalid) {
  using testing::HasSubstr;
  for (const std::string scene : {"kitchen", "l_block", "room:sharp", "room:3x", "wall:3"}) {
    const auto unknown = makeSyntheticSource(scene, {});
    ASSERT_FALSE(unknown) << scene;
    EXPECT_THAT(unknown.error().message(), HasSubstr("'" + scene + "'"));
    EXPECT_THAT(unknown.error().message(), HasSubstr("tabletop, room"));
  }
  SourceOptions late;
  late.start = 300;
  const auto no_frames = makeSyntheticSource("tabletop", late);
  ASSERT_FALSE(no_frames);
  EXPECT_THAT(no_frames.error().message(), HasSubstr("300 frames"));
  SourceOptions invalid_camera;
  invalid_camera.intrinsics = Intrinsics{0, 525, 320, 240, 640, 480};
  const auto refused = makeSyntheticSource("tabletop", invalid_camera);
  ASSERT_FALSE(refused);
  EXPECT_THAT(refused.error().message(), HasSubstr("fx 0"));
}

}  // namespace
}  // namespace scantrove
