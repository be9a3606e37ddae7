#pragma once
#include <gmock/gmock.h>

#include <vector>

#include "tests/pipeline/collection/object_collector_fixture.h"

namespace scantrove::test {

/// A scan that has ended and is looked at again.
class SecondLookFixture : public ObjectCollectorFixture {
 protected:
  /// What the map shows from a frame in the end: the thing's region where its view had it, or in a part of
  /// that only; a surface 1 m ahead.
  static RenderedView mapWith(const Thing& thing, double part) {
    RenderedView map;
    map.K = kWorking;
    map.regions.assign(static_cast<std::size_t>(kWorking.pixels()), RegionId{1});
    map.vertices_world.assign(map.regions.size(), {0, 0, 1, 1});
    const Candidate candidate = thing.candidate();
    for (int v = 0; v < static_cast<int>(part * candidate.mask.rows); ++v) {
      for (int u = 0; u < candidate.mask.cols; ++u) {
        if (candidate.mask.at<unsigned char>(v, u) == 0) continue;
        const cv::Point at = candidate.box_px.tl() + cv::Point(u, v);
        map.regions[static_cast<std::size_t>(at.y * map.K.width + at.x)] = thing.region;
      }
    }
    return map;
  }
  /// All views, whose readings are at 1 m, are held against that map; then frames show `things` from a
  /// direction.
  void lookAgain(RenderedView map, const std::vector<Thing>& things, float surface_m = 1,
                 double degrees = 0) {
    map.vertices_world.assign(map.regions.size(), {0, 0, surface_m, 1});
    collector_->beginRefinement();
    settleComplete();
    for (const int frame : collector_->views().framesOfViews()) {
      ASSERT_EQ(collector_->views().camerasOfViews(frame).size(), 1U);
      EXPECT_EQ(collector_->views().camerasOfViews(frame).front().image_px,
                cv::Size(kWorking.width, kWorking.height));
      collector_->views().compare(frame, map, 0.0015F);
    }
    for (int i = 0; i < 6; ++i) static_cast<void>(look(things, degrees));
    collector_->endRefinement();
    settle();
    static_cast<void>(collector_->followCatalogue());
  }
  std::vector<int> framesOfViews(ObjectId object) {
    std::vector<int> frames;
    const std::vector<ObjectView> views = *person_->views(object);
    for (const ObjectView& view : views) frames.push_back(view.frame_index);
    return frames;
  }
};

}  // namespace scantrove::test
