#pragma once
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <opencv2/imgproc.hpp>

#include "core/collection/object_collector.h"
#include "core/scan/rated_sets.h"
#include "tests/support/qt_main_thread.h"
#include "tests/support/temporary_folder.h"

namespace scantrove::test {

inline const Intrinsics kWorking{150, 150, 80, 60, 160, 120};
inline const Eigen::Vector3f kSize(0.2F, 0.15F, 0.1F);

/// A thing on a table as discovery finds it: of another look for each seed, at a place of its own.
struct Thing {
  int seed = 0;
  int place = 0;
  RegionId region;
  double change = 0;            ///< how much of another look is mixed in
  bool is_upside_down = false;  ///< of the same colours, and yet of another look

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

/// Shows an ObjectCollector things on a table, with a catalogue that another program has open too.
class ObjectCollectorFixture : public testing::Test {
 protected:
  void SetUp() override {
    moveIn(compute_, ComputeContext::create({}));
    moveIn(database_, ObjectDatabase::open(file()));
    moveIn(person_, ObjectDatabase::open(file()));
    beginScan();
  }
  template <class T>
  static void moveIn(T& target, Result<T> result) {
    ASSERT_TRUE(result) << result.error().message();
    target = std::move(*result);
  }
  [[nodiscard]] std::string file() const { return (folder_ / "catalogue.sqlite").string(); }

  [[nodiscard]] static DetectionParams params() {
    DetectionParams params;
    params.new_view_angle_deg = 20;
    return params;
  }

  void beginScan() {
    collector_.reset();
    CatalogueWriter::Options writer = writer_;
    writer.database = file();
    writer.source = "table";
    moveIn(collector_, ObjectCollector::create(*compute_, *database_, writer, params()));
  }

  /// Waits until all is stored and heard of.
  void settle() { ASSERT_TRUE(collector_->settle(std::chrono::seconds(60))); }

  static SurfaceInColor inColor() {
    return locateInColor(std::nullopt, kWorking, Eigen::Isometry3d::Identity(), {});
  }

  /// One frame that shows `things` from a direction about the vertical; with what is stored of it, unless
  /// the catalogue is not to be waited for.
  FrameObjects look(const std::vector<Thing>& things, double degrees = 0) {
    std::vector<Candidate> candidates;
    for (const Thing& thing : things) candidates.push_back(thing.candidate());
    return lookAt(candidates, things, degrees);
  }
  FrameObjects lookAt(const std::vector<Candidate>& candidates, const std::vector<Thing>& things,
                      double degrees = 0) {
    RgbdFrame frame;
    frame.index = frame_++;
    frame.color = cv::Mat(240, 320, CV_8UC3, cv::Scalar(40, 50, 60));
    frame.depth = cv::Mat(240, 320, CV_16UC1, cv::Scalar(1000));
    for (const Thing& thing : things) thing.paint(frame.color);
    const double angle = degrees * 3.14159265 / 180;
    const Eigen::Isometry3d T_world_camera(
        Eigen::Translation3d(30 * std::sin(angle), 0, -30 * std::cos(angle)));
    if (waits_) settle();
    FrameObjects objects = collector_->collect(frame, T_world_camera, inColor(), candidates);
    if (!waits_) return objects;
    settle();
    addNews(objects);
    return objects;
  }

  void addNews(FrameObjects& objects) {
    FrameObjects news = collector_->followCatalogue();
    std::ranges::move(news.added, std::back_inserter(objects.added));
    std::ranges::move(news.recognized, std::back_inserter(objects.recognized));
    std::ranges::move(news.new_views, std::back_inserter(objects.new_views));
    std::ranges::move(news.merged, std::back_inserter(objects.merged));
    if (news.catalogue_failure) objects.catalogue_failure = news.catalogue_failure;
    for (SeenObject& seen : objects.seen) collector_->objects().describe(seen);  // as snapshots do
  }

  /// So many such frames that what is unknown counts as unknown; all that they gave, seen as in the last.
  FrameObjects study(const std::vector<Thing>& things, double degrees = 0) {
    FrameObjects all;
    for (int i = 0; i <= RecognitionHistory::kAttemptsToGiveUp * RecognitionHistory::kFramesApart; ++i) {
      FrameObjects one = look(things, degrees);
      std::ranges::move(one.added, std::back_inserter(all.added));
      std::ranges::move(one.recognized, std::back_inserter(all.recognized));
      std::ranges::move(one.new_views, std::back_inserter(all.new_views));
      std::ranges::move(one.merged, std::back_inserter(all.merged));
      if (one.catalogue_failure) all.catalogue_failure = one.catalogue_failure;
      all.seen = std::move(one.seen);
    }
    return all;
  }

  /// A frame in which the thing is not found, seen from the origin; all readings are at `z_m`.
  void lookAtPlaceOf(const Thing& thing, float z_m) {
    static_cast<void>(look({}));
    const Eigen::Isometry3d T_world_camera(Eigen::Translation3d(thing.centroid().x(), 0, 0));
    const Intrinsics K{160, 160, 159.5F, 119.5F, 320, 240};
    collector_->checkPlaces({K, T_world_camera, cv::Mat(240, 320, CV_32FC1, cv::Scalar(z_m))}, 0.0015F);
  }

  // The refinement's side.

  void rate(int frame_index, const std::vector<Candidate>& candidates) {
    rated_.add(frame_index, candidates);
  }
  void settleComplete() {
    constexpr float kMin = -0.2F;
    std::vector<CompleteSet> complete;
    for (const RatedSets::Rated& rated : rated_.disjoint(kMin))
      complete.push_back({rated.regions, rated.frame_index});
    collector_->settleComplete(complete, [&](RegionId region) { return rated_.isUnlikely(region, kMin); });
    rated_ = {};
  }

  /// The object as the scan reports it.
  [[nodiscard]] CollectedObject collected(ObjectId id) const {
    const std::vector<CollectedObject> all = collector_->objects().list();
    const auto found = std::ranges::find(all, id, &CollectedObject::id);
    return found == all.end() ? CollectedObject{} : *found;
  }
  std::vector<ObjectRecord> objects() {
    const Result<std::vector<ObjectRecord>> objects = person_->objects();
    EXPECT_TRUE(objects);
    return objects.value_or(std::vector<ObjectRecord>());
  }

  QtMainThread qt_;
  TemporaryFolder folder_;
  std::unique_ptr<ComputeContext> compute_;
  std::unique_ptr<ObjectDatabase> database_;
  std::unique_ptr<ObjectDatabase> person_;  // the window, or another program
  CatalogueWriter::Options writer_{.retry = std::chrono::milliseconds(20)};
  std::unique_ptr<ObjectCollector> collector_;
  RatedSets rated_;
  bool waits_ = true;  // each frame for all to be stored
  int frame_ = 0;

  const Thing mug_{1, 0, RegionId{11}};
  const Thing box_{2, 1, RegionId{12}};
  const Thing cup_{3, 2, RegionId{13}};
};

}  // namespace scantrove::test
