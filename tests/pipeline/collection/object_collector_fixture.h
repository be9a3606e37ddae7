#pragma once
#include <algorithm>
#include <chrono>
#include <iterator>
#include <memory>
#include <vector>

#include "core/collection/object_collector.h"
#include "tests/pipeline/collection/table_fixture.h"

namespace scantrove::test {

/// Passes frames of items on a table to an ObjectCollector.
class ObjectCollectorFixture : public TableFixture {
 protected:
  void SetUp() override {
    TableFixture::SetUp();
    beginScan();
  }

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

  /// Waits until all results are stored and all changes by others are known.
  void settle() { ASSERT_TRUE(collector_->settle(std::chrono::seconds(60))); }

  /// Collects one frame with `items` from a direction about the vertical. Includes its stored results,
  /// unless waits_ is false.
  FrameObjects showFrame(const std::vector<TableItem>& items, double degrees = 0) {
    std::vector<Candidate> candidates;
    for (const TableItem& item : items) candidates.push_back(item.candidate());
    return showCandidates(candidates, items, degrees);
  }
  FrameObjects showCandidates(const std::vector<Candidate>& candidates, const std::vector<TableItem>& items,
                              double degrees = 0) {
    if (waits_) settle();
    const TestFrame taken = takeFrame(items, degrees);
    FrameObjects objects = collector_->collect(taken.frame, taken.T_world_camera, taken.in_color, candidates);
    if (!waits_) return objects;
    settle();
    addEvents(objects);
    return objects;
  }

  void addEvents(FrameObjects& objects) {
    FrameObjects later = collector_->applyCatalogueChanges();
    std::ranges::move(later.added, std::back_inserter(objects.added));
    std::ranges::move(later.recognized, std::back_inserter(objects.recognized));
    std::ranges::move(later.new_views, std::back_inserter(objects.new_views));
    std::ranges::move(later.merged, std::back_inserter(objects.merged));
    if (later.catalogue_failure) objects.catalogue_failure = later.catalogue_failure;
    for (SeenObject& seen : objects.seen) collector_->objects().describe(seen);  // as snapshots do
  }

  /// Collects enough such frames to decide that an object is unknown; all results together, `seen` as in
  /// the last.
  FrameObjects showFrames(const std::vector<TableItem>& items, double degrees = 0) {
    FrameObjects all;
    for (int i = 0; i <= RecognitionHistory::kAttemptsToGiveUp * RecognitionHistory::kFramesApart; ++i) {
      FrameObjects one = showFrame(items, degrees);
      std::ranges::move(one.added, std::back_inserter(all.added));
      std::ranges::move(one.recognized, std::back_inserter(all.recognized));
      std::ranges::move(one.new_views, std::back_inserter(all.new_views));
      std::ranges::move(one.merged, std::back_inserter(all.merged));
      if (one.catalogue_failure) all.catalogue_failure = one.catalogue_failure;
      all.seen = std::move(one.seen);
    }
    return all;
  }

  /// A frame without the item, taken from the origin; all readings are at `z_m`.
  void showPlaceOf(const TableItem& item, float z_m) {
    static_cast<void>(showFrame({}));
    const Eigen::Isometry3d T_world_camera(Eigen::Translation3d(item.centroid().x(), 0, 0));
    const Intrinsics K{160, 160, 159.5F, 119.5F, 320, 240};
    collector_->checkPlaces({K, T_world_camera, cv::Mat(240, 320, CV_32FC1, cv::Scalar(z_m))}, kDepthNoise_m);
  }

  /// The object in the scan's report.
  [[nodiscard]] CollectedObject collected(ObjectId id) const {
    const std::vector<CollectedObject> all = collector_->objects().list();
    const auto found = std::ranges::find(all, id, &CollectedObject::id);
    return found == all.end() ? CollectedObject{} : *found;
  }

  CatalogueWriter::Options writer_{.retry = std::chrono::milliseconds(20)};
  std::unique_ptr<ObjectCollector> collector_;
  bool waits_ = true;  // after each frame, until all is stored
};

}  // namespace scantrove::test
