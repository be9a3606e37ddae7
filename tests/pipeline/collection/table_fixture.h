#pragma once
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <opencv2/imgproc.hpp>

#include "core/catalogue/object_database.h"
#include "core/collection/observed_frame.h"
#include "core/compute/compute_context.h"
#include "core/fusion/color_projection.h"
#include "core/fusion/rendered_view.h"
#include "tests/support/qt_main_thread.h"
#include "tests/support/temporary_folder.h"

namespace scantrove::test {

inline const Intrinsics kWorking{150, 150, 80, 60, 160, 120};
inline const Eigen::Vector3f kSize(0.2F, 0.15F, 0.1F);

/// An object on a table as a candidate of discovery: each seed has another appearance, each item its own
/// place.
struct TableItem {
  int seed = 0;
  int place = 0;
  RegionId region;
  double change = 0;            ///< fraction of another appearance that is mixed in
  bool is_upside_down = false;  ///< same colours, different appearance

  [[nodiscard]] cv::Rect box() const { return {5 + 50 * place, 30, 40, 50}; }
  [[nodiscard]] Eigen::Vector3f centroid() const { return {0.5F * static_cast<float>(place), 0, 1}; }
  [[nodiscard]] Candidate candidate() const {
    Candidate candidate;
    candidate.regions = {region};
    candidate.outline = 1;
    candidate.is_complete = true;
    candidate.box_px = box();
    candidate.mask = cv::Mat(box().size(), CV_8UC1, cv::Scalar(0));
    cv::ellipse(candidate.mask, {20, 25}, {19, 24}, 0, 0, 360, 255, cv::FILLED);
    candidate.centroid_world = centroid();
    candidate.size_m = kSize;
    return candidate;
  }
  void paint(cv::Mat& color) const {
    cv::RNG random(static_cast<std::uint64_t>(seed) * 7919 + 1);
    cv::Mat patches(4, 4, CV_8UC3), others(4, 4, CV_8UC3), picture;
    random.fill(patches, cv::RNG::UNIFORM, 20, 236);
    random.fill(others, cv::RNG::UNIFORM, 20, 236);
    cv::addWeighted(patches, 1 - change, others, change, 0, patches);
    const cv::Rect in_color(2 * box().x, 2 * box().y, 2 * box().width, 2 * box().height);
    cv::resize(patches, picture, in_color.size(), 0, 0, cv::INTER_CUBIC);
    if (is_upside_down) cv::flip(picture, picture, 0);
    picture.copyTo(color(in_color));
  }
};

/// A frame of items on a table, with its pose.
struct TestFrame {
  RgbdFrame frame;
  Eigen::Isometry3d T_world_camera;
  SurfaceInColor in_color;

  [[nodiscard]] ObservedFrame observed() const { return {frame, T_world_camera, in_color}; }
};

/// Items on a table, and a catalogue that another program has open too.
class TableFixture : public testing::Test {
 protected:
  void SetUp() override {
    moveIn(compute_, ComputeContext::create({}));
    moveIn(database_, ObjectDatabase::open(file()));
    moveIn(person_, ObjectDatabase::open(file()));
  }
  template <class T>
  static void moveIn(T& target, Result<T> result) {
    ASSERT_TRUE(result) << result.error().message();
    target = std::move(*result);
  }
  [[nodiscard]] std::string file() const { return (folder_ / "catalogue.sqlite").string(); }

  /// The next frame: `items` from a direction about the vertical.
  [[nodiscard]] TestFrame takeFrame(const std::vector<TableItem>& items, double degrees = 0) {
    TestFrame taken;
    taken.frame.index = frame_++;
    taken.frame.color = cv::Mat(240, 320, CV_8UC3, cv::Scalar(40, 50, 60));
    taken.frame.depth = cv::Mat(240, 320, CV_16UC1, cv::Scalar(1000));
    for (const TableItem& item : items) item.paint(taken.frame.color);
    const double angle = degrees * 3.14159265 / 180;
    taken.T_world_camera = Eigen::Translation3d(30 * std::sin(angle), 0, -30 * std::cos(angle));
    taken.in_color = inColor();
    return taken;
  }
  static SurfaceInColor inColor() { return locateInColor(std::nullopt, {kWorking}); }

  /// The final map rendered from a frame: the item's region fills its view's mask, or only a part; the
  /// surface is `surface_m` ahead.
  [[nodiscard]] static RenderedView mapWith(const TableItem& item, double part, float surface_m = 1) {
    RenderedView map;
    map.K = kWorking;
    map.regions.assign(static_cast<std::size_t>(kWorking.pixels()), RegionId{1});
    map.vertices_world.assign(map.regions.size(), {0, 0, surface_m, 1});
    const Candidate candidate = item.candidate();
    for (int v = 0; v < static_cast<int>(part * candidate.mask.rows); ++v) {
      for (int u = 0; u < candidate.mask.cols; ++u) {
        if (candidate.mask.at<unsigned char>(v, u) == 0) continue;
        const cv::Point at = candidate.box_px.tl() + cv::Point(u, v);
        map.regions[static_cast<std::size_t>(at.y * map.K.width + at.x)] = item.region;
      }
    }
    return map;
  }

  // The catalogue's content.

  std::vector<ObjectRecord> objects() {
    const Result<std::vector<ObjectRecord>> objects = person_->objects();
    EXPECT_TRUE(objects);
    return objects.value_or(std::vector<ObjectRecord>());
  }
  std::vector<int> framesOfViews(ObjectId object) {
    std::vector<int> frames;
    const std::vector<ObjectView> views = *person_->views().of(object);
    for (const ObjectView& view : views) frames.push_back(view.frame_index);
    return frames;
  }

  static constexpr float kDepthNoise_m = 0.0015F;
  QtMainThread qt_;
  TemporaryFolder folder_;
  std::unique_ptr<ComputeContext> compute_;
  std::unique_ptr<ObjectDatabase> database_;
  std::unique_ptr<ObjectDatabase> person_;  // the window, or another program
  int frame_ = 0;

  const TableItem mug_{1, 0, RegionId{11}};
  const TableItem box_{2, 1, RegionId{12}};
  const TableItem cup_{3, 2, RegionId{13}};
};

}  // namespace scantrove::test
