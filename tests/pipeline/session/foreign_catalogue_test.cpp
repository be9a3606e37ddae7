// A review with another catalogue than the session's leaves the objects of that catalogue unchanged.
#include <gtest/gtest.h>

#include <filesystem>
#include <opencv2/core.hpp>

#include "core/catalogue/object_database.h"
#include "core/session/open_session.h"
#include "tests/pipeline/session/scan_worker_fixture.h"

namespace scantrove {
namespace {

constexpr int kReviewFrames = 25, kForeignObjects = 40;

class ForeignCatalogueReviewTest : public test::ScanWorkerTest {
 protected:
  ScanRequest reviewed() const {
    ScanRequest requested = request(kReviewFrames);
    requested.output_folder = folder_ / "scan";
    requested.database = catalogue_;
    requested.results = false;
    requested.review = true;
    return requested;
  }
  static ObjectView anyView() {
    ObjectView view;
    view.box_px = {20, 20, 40, 30};
    view.frame_px = {640, 480};
    view.color = cv::Mat(30, 40, CV_8UC3, cv::Scalar(20, 90, 200));
    view.mask = cv::Mat(30, 40, CV_8UC1, cv::Scalar(255));
    view.depth_mm = cv::Mat(30, 40, CV_16UC1, cv::Scalar(1000));
    view.size_m = {0.3F, 0.2F, 0.1F};
    return view;
  }
  void replaceCatalogue() const {
    for (const char* end : {"", "-wal", "-shm"}) std::filesystem::remove(catalogue_ + end);
    const auto database = ObjectDatabase::open(catalogue_);
    ASSERT_TRUE(database) << database.error().message();
    for (int i = 0; i < kForeignObjects; ++i) ASSERT_TRUE((*database)->addObject(anyView()));
  }
  /// "id name views" of the objects that the foreign catalogue had at first.
  std::vector<std::string> foreignObjects() const {
    const auto database = ObjectDatabase::open(catalogue_);
    std::vector<std::string> texts;
    if (!database) return texts;
    const auto objects = (*database)->objects();
    EXPECT_TRUE(objects);
    for (const ObjectRecord& object : *objects) {
      if (object.id.value <= kForeignObjects)
        texts.push_back(std::to_string(object.id.value) + " " + object.name + " " +
                        std::to_string(object.views) + (object.confirmed ? " confirmed" : ""));
    }
    return texts;
  }
  std::unique_ptr<OpenSession> open() {
    auto session = OpenSession::open(folder_ / "scan");
    for (int i = 0; !session && i < 100; ++i) {  // the review closes it after a moment
      std::this_thread::sleep_for(std::chrono::milliseconds(100));
      session = OpenSession::open(folder_ / "scan");
    }
    EXPECT_TRUE(session) << session.error().message();
    return session ? std::move(*session) : nullptr;
  }

  const std::string catalogue_ = folder_ / "scan" / "catalogue.sqlite";
};

TEST_F(ForeignCatalogueReviewTest, ShowsAndChangesNoForeignObject) {
  std::filesystem::create_directories(folder_ / "scan");
  worker_.post(StartScan{reviewed()});
  log_.await<ReviewOpened>();
  worker_.post(CloseScan{});
  RegionId largest;
  {
    const auto session = open();
    ASSERT_NE(session, nullptr);
    std::int64_t most = 0;
    const auto regions = session->regions();
    ASSERT_TRUE(regions);
    for (const RegionSummary& region : *regions) {
      if (region.voxels > most) largest = region.region;
      most = std::max(most, region.voxels);
    }
    // As after an earlier naming.
    ASSERT_TRUE(session->edit({.kind = OperationKind::name, .regions = {largest}, .name = "mug"}));
  }
  replaceCatalogue();
  const std::vector<std::string> before = foreignObjects();
  ASSERT_EQ(before.size(), static_cast<std::size_t>(kForeignObjects));

  ScanRequest again = reviewed();
  again.source.clear();
  worker_.post(StartScan{again});
  log_.await<ReviewOpened>(2);
  const auto snapshot = awaitSnapshot(1);
  ASSERT_NE(snapshot, nullptr);
  ASSERT_NE(snapshot->region_infos, nullptr);
  for (const RegionInfo& info : *snapshot->region_infos) EXPECT_FALSE(info.object) << info.region.value;
  for (const SeenObject& seen : snapshot->objects) EXPECT_FALSE(seen.object);
  worker_.post(EditRegions{Operation{.kind = OperationKind::name, .regions = {largest}, .name = "red mug"}});
  log_.await<Edited>();
  worker_.post(EditRegions{UndoEdit{}});
  log_.await<Edited>(2);
  worker_.post(EditRegions{UndoEdit{}});
  log_.await<Edited>(3);
  worker_.post(CloseScan{});
  const auto session = open();
  ASSERT_NE(session, nullptr);
  EXPECT_EQ(foreignObjects(), before);
}

}  // namespace
}  // namespace scantrove
