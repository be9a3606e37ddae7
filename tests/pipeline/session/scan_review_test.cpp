// Review of a scan after its end, and of a saved scan.
#include <gmock/gmock.h>

#include <algorithm>
#include <filesystem>
#include <fstream>
#include <map>
#include <opencv2/core.hpp>

#include "core/session/open_session.h"
#include "tests/pipeline/session/scan_worker_fixture.h"

namespace scantrove::test {
namespace {

constexpr int kFrames = 25;

class ScanReviewTest : public ScanWorkerTest {
 protected:
  ScanRequest reviewed() const {
    ScanRequest requested = request(kFrames);
    requested.output_folder = folder_ / "scan";
    requested.results = false;
    requested.review = true;
    return requested;
  }

  ScanRequest reopened() const {
    ScanRequest requested = reviewed();
    requested.source.clear();
    return requested;
  }

  /// The next snapshot for which `is_requested` holds; null: none comes within a minute.
  template <class Predicate>
  std::shared_ptr<const ScanSnapshot> awaitShown(const Predicate& is_requested) {
    for (int i = 0; i < 1200; ++i) {
      auto snapshot = worker_.snapshots().collect();
      if (snapshot && is_requested(*snapshot)) return snapshot;
      std::this_thread::sleep_for(std::chrono::milliseconds(50));
    }
    return nullptr;
  }

  static RegionId largestIn(const ScanSnapshot& snapshot) {
    std::map<int, int> pixels;
    for (const int region : cv::Mat_<int>(snapshot.regions)) ++pixels[region];
    pixels.erase(0);
    const auto most = std::ranges::max_element(pixels, {}, [](const auto& entry) { return entry.second; });
    return most == pixels.end() ? RegionId{} : RegionId{static_cast<std::uint32_t>(most->first)};
  }

  static int segmentsIn(const ScanSnapshot& snapshot) {
    double most = 0;
    cv::minMaxLoc(snapshot.segments, nullptr, &most);
    return static_cast<int>(most);
  }

  static Operation naming(RegionId region, const std::string& name) {
    Operation operation;
    operation.regions = {region};
    operation.name = name;
    return operation;
  }
};

TEST_F(ScanReviewTest, EndedScanCanBeEdited) {
  worker_.post(StartScan{reviewed()});
  log_.awaitState(ScanState::finished);
  const auto last = awaitShown([](const ScanSnapshot& s) { return s.state == ScanState::finished; });
  ASSERT_NE(last, nullptr);
  const RegionId region = largestIn(*last);
  // Posted before the session is open again.
  worker_.post(EditRegions{naming(region, "the table")});
  log_.await<Edited>();
  const auto shown = awaitShown([&](const ScanSnapshot& s) {
    const RegionInfo* info = s.region_infos ? find(*s.region_infos, region) : nullptr;
    return info != nullptr && info->note.name == "the table";
  });
  ASSERT_NE(shown, nullptr);
  EXPECT_EQ(shown->state, ScanState::finished);
  worker_.post(EditRegions{UndoEdit{}});
  log_.await<Edited>(2);
  worker_.post(EditRegions{RedoEdit{}});
  log_.await<Edited>(3);
  EXPECT_TRUE(log_.all<EditFailed>().empty());
  worker_.post(CloseScan{});
  auto saved = OpenSession::open(folder_ / "scan");
  for (int i = 0; !saved && i < 100; ++i) {  // the worker closes it after a moment
    std::this_thread::sleep_for(std::chrono::milliseconds(100));
    saved = OpenSession::open(folder_ / "scan");
  }
  ASSERT_TRUE(saved) << saved.error().message();
  EXPECT_EQ((*saved)->noteOf(region).name, "the table");
  EXPECT_FALSE(std::filesystem::exists(folder_ / "scan" / "cloud.ply")) << "only the session is written";
}

TEST_F(ScanReviewTest, RemovedSessionIsWrittenAgain_WithTheEdit) {
  worker_.post(StartScan{reviewed()});
  log_.await<ReviewOpened>();
  const auto last = awaitShown([](const ScanSnapshot& s) { return s.state == ScanState::finished; });
  ASSERT_NE(last, nullptr);
  const RegionId region = largestIn(*last);
  ASSERT_TRUE(std::filesystem::remove(folder_ / "scan" / "session.sqlite"));
  worker_.post(EditRegions{naming(region, "the table")});
  log_.await<MapFailed>();
  log_.await<Edited>();
  EXPECT_THAT(log_.all<MapFailed>().front().error.message(), testing::HasSubstr("written anew"));
  worker_.post(EditRegions{UndoEdit{}});
  log_.await<Edited>(2);
  EXPECT_EQ(log_.all<MapFailed>().size(), 1U) << "reported once";
  worker_.post(EditRegions{RedoEdit{}});
  log_.await<Edited>(3);
  worker_.post(StartScan{reopened()});
  log_.await<ReviewOpened>(2);
  worker_.post(CloseScan{});
  worker_.wait();
  auto saved = OpenSession::open(folder_ / "scan");
  for (int i = 0; !saved && i < 100; ++i) {  // the worker closes it after a moment
    std::this_thread::sleep_for(std::chrono::milliseconds(100));
    saved = OpenSession::open(folder_ / "scan");
  }
  ASSERT_TRUE(saved) << saved.error().message();
  EXPECT_EQ((*saved)->noteOf(region).name, "the table");
}

TEST_F(ScanReviewTest, SavedSessionIsShownEditedAndExported) {
  worker_.post(StartScan{reviewed()});
  log_.await<ReviewOpened>();
  worker_.post(StartScan{reopened()});
  log_.await<ReviewOpened>(2);
  const auto first = awaitShown([](const ScanSnapshot& s) { return s.key_frames && s.shown_key_frame >= 0; });
  ASSERT_NE(first, nullptr);
  ASSERT_GE(first->key_frames->size(), 2U);
  EXPECT_FALSE(first->color.empty());
  EXPECT_FALSE(first->regions.empty());
  EXPECT_GT(first->changed_bricks.size(), 100U) << "the complete map";
  EXPECT_GT(first->trail->size(), 20U);

  worker_.post(ShowKeyFrame{0});
  const auto frame = awaitShown([](const ScanSnapshot& s) { return s.shown_key_frame == 0; });
  ASSERT_NE(frame, nullptr);
  EXPECT_EQ(frame->frame_index, frame->key_frames->front());
  EXPECT_EQ(frame->segments.size(), frame->regions.size());

  const RegionId table = largestIn(*frame);
  const auto shows_table = [table](const ScanSnapshot& s) {
    return std::ranges::any_of(s.objects, [&](const SeenObject& seen) {
      return seen.object && seen.regions.contains(table) && seen.box.area() > 0.05F;
    });
  };
  EXPECT_FALSE(shows_table(*frame)) << "the table is an object already: the test shows nothing";
  worker_.post(EditRegions{naming(table, "table")});
  log_.await<Edited>();
  EXPECT_NE(awaitShown(shows_table), nullptr);
  ExportOptions options;
  options.format = DatasetFormat::masks;
  options.folder = folder_ / "masks";
  worker_.post(PreviewExport{options});
  log_.await<ExportPreviewed>();
  EXPECT_GE(log_.all<ExportPreviewed>().front().preview.regions, 1);
  worker_.post(SampleExport{options, 0});
  log_.await<ExportSampled>();
  const ExportSample sample = log_.all<ExportSampled>().front().sample;
  EXPECT_EQ(sample.frame, frame->frame_index);
  EXPECT_GE(sample.masks, 1);
  EXPECT_FALSE(sample.picture.empty());
  worker_.post(ExportDataset{options});
  log_.await<ExportFinished>();
  EXPECT_TRUE(std::filesystem::exists(folder_ / "masks" / "labels.json"));
  EXPECT_FALSE(log_.all<ExportStepped>().empty());
  EXPECT_TRUE(log_.all<ExportFailed>().empty());
  // A file of somebody else is in the folder now: the export fails, and the review continues.
  const std::filesystem::path note = folder_ / "masks" / "note.txt";
  std::ofstream(note) << "mine";
  worker_.post(ExportDataset{options});
  log_.await<ExportFailed>();
  EXPECT_TRUE(std::filesystem::exists(note));
  worker_.post(EditRegions{UndoEdit{}});
  log_.await<Edited>(2);
  EXPECT_NE(awaitShown([&](const ScanSnapshot& s) { return !shows_table(s); }), nullptr);
}

// Somebody waits for the end of each export, also of one that had not begun.
TEST_F(ScanReviewTest, ExportsAreAnswered_WhenTheScanIsClosed) {
  worker_.post(StartScan{reviewed()});
  log_.await<ReviewOpened>();
  ExportOptions options;
  options.format = DatasetFormat::masks;
  options.folder = folder_ / "masks";
  RenderPicture picture;
  picture.options.file = folder_ / "scan.png";
  worker_.post(ExportDataset{options});
  worker_.post(picture);
  worker_.post(CloseScan{});
  worker_.post(EditRegions{UndoEdit{}});
  log_.await<EditFailed>();  // the scan is closed
  EXPECT_EQ(log_.all<ExportFinished>().size() + log_.all<ExportFailed>().size(), 1U);
  EXPECT_EQ(log_.all<RenderFinished>().size() + log_.all<RenderFailed>().size(), 1U);
}

// Segments of a shown key frame are computed again when k changes; regions and map do not change.
TEST_F(ScanReviewTest, KeyFrameIsSegmentedAgain_WhenParametersChange) {
  ScanRequest requested = reviewed();
  worker_.post(StartScan{requested});
  log_.await<ReviewOpened>();
  const auto first = awaitShown([](const ScanSnapshot& s) { return s.key_frames && s.shown_key_frame >= 0; });
  ASSERT_NE(first, nullptr);
  const int few = segmentsIn(*first);
  EXPECT_GE(few, 3);
  const cv::Mat is_surface = first->depth_fused_m > 0, is_in_segment = first->segments > 0;
  const int all = cv::countNonZero(is_surface);
  EXPECT_GT(cv::countNonZero(is_surface & is_in_segment), all * 9 / 10);

  requested.params.segmentation.k /= 20;
  worker_.post(SetParams{requested.params});
  const auto finer = awaitShown([&](const ScanSnapshot& s) { return segmentsIn(s) > few; });
  ASSERT_NE(finer, nullptr);
  EXPECT_EQ(cv::norm(finer->regions, first->regions, cv::NORM_INF), 0);
  EXPECT_EQ(finer->shown_key_frame, first->shown_key_frame);
  EXPECT_TRUE(finer->changed_bricks.empty());
  EXPECT_TRUE(finer->changed_regions.empty());
  // The next shown key frame uses the new k too.
  worker_.post(ShowKeyFrame{0});
  const auto next = awaitShown([](const ScanSnapshot& s) { return s.shown_key_frame == 0; });
  ASSERT_NE(next, nullptr);
  EXPECT_GT(segmentsIn(*next), few);
}

TEST_F(ScanReviewTest, ReportsAFolderWithoutASession) {
  worker_.post(StartScan{reopened()});
  log_.awaitState(ScanState::failed);
  EXPECT_NE(log_.failure().find("scan"), std::string::npos);
  worker_.post(StartScan{request(3)});
  log_.awaitState(ScanState::finished);
}

TEST_F(ScanReviewTest, RefusesAnExport_DuringAScan) {
  ScanRequest requested = reviewed();
  requested.start_paused = true;
  worker_.post(StartScan{requested});
  log_.awaitState(ScanState::paused);
  worker_.post(ExportDataset{{}});
  log_.await<ExportFailed>();
  worker_.post(StopScan{});
  log_.awaitState(ScanState::finished);
}

}  // namespace
}  // namespace scantrove::test
