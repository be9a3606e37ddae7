#pragma once
#include <chrono>
#include <memory>
#include <optional>
#include <utility>
#include <vector>

#include "core/collection/identity_resolver.h"
#include "core/collection/object_tracks.h"
#include "core/collection/user_requests.h"
#include "core/collection/view_keeper.h"
#include "tests/pipeline/collection/table_fixture.h"

namespace scantrove::test {

/// The parts of an ObjectCollector, to be called separately, and the catalogue that they write to. The
/// parts identify objects by keys; idOf() gives the database id once stored.
class PartsFixture : public TableFixture {
 protected:
  void SetUp() override {
    TableFixture::SetUp();
    Result<Detector> detector = Detector::create(*compute_);
    ASSERT_TRUE(detector) << detector.error().message();
    catalogue_.emplace(std::move(*detector));
    const Result<CataloguePosition> position = catalogue_->load(*database_);
    ASSERT_TRUE(position) << position.error().message();
    CatalogueWriter::Options options;
    options.database = file();
    options.source = "table";
    moveIn(writer_, CatalogueWriter::start(options, *position));
    tracks_.emplace(*catalogue_);
    requests_.emplace(*catalogue_, *writer_, *tracks_);
    identities_.emplace(*catalogue_, *writer_, *tracks_, *requests_);
    views_.emplace(*catalogue_, *writer_, *tracks_, *requests_, *identities_);
    DetectionParams params;
    params.new_view_angle_deg = 20;
    views_->setParams(params);
  }

  /// Adds an object for the item with a view from that direction. Result: its key.
  ObjectId add(const TableItem& item, double degrees = 0) {
    const TestFrame taken = takeFrame({item}, degrees);
    const ObjectId object = views_->addObject(item.candidate(), taken.observed());
    EXPECT_TRUE(object);
    tracks_->observe(object, item.candidate(), taken.frame.index);
    tracks_->viewsOf(object).keep(taken.observed().directionOf(item.candidate()));
    return object;
  }
  /// Adds another view of the object.
  void addView(ObjectId object, const TableItem& item, const Candidate& candidate, double degrees) {
    views_->addView(object, candidate, takeFrame({item}, degrees).observed());
  }
  /// Compares all views with that map.
  void compareWith(const RenderedView& map) {
    for (const int frame : views_->framesOfViews()) views_->compare(frame, map, kDepthNoise_m);
  }
  /// Removes outdated views, and waits until that is stored.
  void removeOutdated() {
    views_->removeOutdated();
    store();
  }
  /// Waits until all results are stored, and reads the changes by others.
  void store() {
    writer_->requestChanges();
    ASSERT_TRUE(writer_->settle(std::chrono::seconds(60)));
    for (const CatalogueEvent& event : writer_->drainEvents()) catalogue_->apply(event);
  }
  [[nodiscard]] ObjectId idOf(ObjectId key) const { return catalogue_->idOf(key); }
  [[nodiscard]] ObjectId rootOf(RegionId region) const {
    return catalogue_->mergeRootOf(tracks_->objectOf(region));
  }

  std::optional<CatalogueMirror> catalogue_;
  std::unique_ptr<CatalogueWriter> writer_;
  std::optional<ObjectTracks> tracks_;
  std::optional<UserRequests> requests_;
  std::optional<IdentityResolver> identities_;
  std::optional<ViewKeeper> views_;
};

}  // namespace scantrove::test
