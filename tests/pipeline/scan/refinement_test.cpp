#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <filesystem>
#include <functional>
#include <nlohmann/json.hpp>
#include <numeric>
#include <opencv2/core.hpp>

#include "core/catalogue/object_database.h"
#include "core/refinement/refinement_memory.h"
#include "core/session/open_session.h"
#include "core/session/refinement_state.h"
#include "core/session/session_store.h"
#include "tests/support/scan_runner.h"
#include "tests/support/temporary_folder.h"

namespace scantrove {
namespace {

using test::runScan;
using test::ScanEnding;

constexpr int kFew = 12;  // frames, where a refinement only has to exist

ScanRequest requestIn(const test::TemporaryFolder& folder, int frames = 40) {
  ScanRequest request;
  request.source = "demo:tabletop:7";
  request.source_options.frames = frames;
  request.output_folder = folder / "out";
  request.database = (folder / "catalogue.sqlite").string();
  return request;
}

TEST(Refinement, ReportsItsProgress) {
  const test::TemporaryFolder folder;
  const ScanEnding ending = runScan(requestIn(folder));
  ASSERT_TRUE(ending.report) << ending.error;
  ASSERT_FALSE(ending.refinement.empty());
  const RefinementStepped first = ending.refinement.front();
  EXPECT_EQ(first.done, 0);
  EXPECT_EQ(first.keyFrame(), 1);
  int last_done = 0, last_key_frame = 1;
  for (const RefinementStepped& step : ending.refinement) {
    EXPECT_EQ(step.steps, first.steps) << "the total is constant";
    EXPECT_EQ(step.key_frames, first.key_frames);
    EXPECT_GE(step.done, last_done);
    EXPECT_GE(step.keyFrame(), last_key_frame);
    EXPECT_LT(step.done, step.steps);
    last_done = step.done;
    last_key_frame = step.keyFrame();
  }
  EXPECT_GT(last_done, first.steps * 2 / 3);
  EXPECT_LE(last_key_frame, first.key_frames);
  EXPECT_EQ(ending.report->refinement.key_frames, first.key_frames);
  EXPECT_GT(ending.report->refinement.seconds, 0);
  EXPECT_FALSE(ending.report->refinement.skipped);
}

TEST(Refinement, IsSkipped_WhenRequested) {
  const test::TemporaryFolder folder;
  ScanRequest request = requestIn(folder, kFew);
  request.skip_refinement = true;
  const ScanEnding ending = runScan(std::move(request));
  ASSERT_TRUE(ending.report) << ending.error;
  EXPECT_TRUE(ending.refinement.empty());
  EXPECT_GT(ending.report->refinement.key_frames, 0);
  EXPECT_TRUE(ending.report->refinement.skipped);
}

/// Results of a scan: the cloud, its labels, and the objects with their views.
struct Results {
  std::string cloud, labels;
  std::vector<std::string> objects;  ///< "name: frame frame ..."
  std::vector<int> mask_px;          ///< of all views
  bool can_be_refined = false;
};

Results resultsIn(const test::TemporaryFolder& folder) {
  Results results;
  results.cloud = test::readText(folder / "out/cloud.ply");
  results.labels = test::readText(folder / "out/labels.json");
  const auto database = ObjectDatabase::open((folder / "catalogue.sqlite").string());
  if (!database) return results;
  const auto objects = (*database)->objects();
  for (const ObjectRecord& object : *objects) {
    std::string text = object.name + ":";
    const auto views = (*database)->views().of(object.id);
    for (const ObjectView& view : *views) {
      text += " " + std::to_string(view.frame_index);
      results.mask_px.push_back(cv::countNonZero(view.mask));
    }
    results.objects.push_back(std::move(text));
  }
  const auto session = SessionStore::open(folder / "out");
  if (!session) return results;
  const auto scan = (*session)->load();
  results.can_be_refined = canBeRefined(scan->metadata);
  return results;
}

ScanRequest requestToRefine(const test::TemporaryFolder& folder) {
  ScanRequest request;
  request.refine_session = true;
  request.output_folder = folder / "out";
  return request;
}

/// Runs `request` and skips the refinement after `step` steps.
ScanReport runUntilStep(ScanRequest request, int step) {
  const test::QtMainThread qt;
  ScanReport report;
  ScanWorker* running = nullptr;
  ScanWorker worker([&](const ScanEvent& event) {
    const auto* stepped = std::get_if<RefinementStepped>(&event);
    if (stepped != nullptr && stepped->done >= step) running->post(SkipRefinement{});
    if (const auto* finished = std::get_if<ScanFinished>(&event)) report = finished->report;
  });
  running = &worker;
  worker.post(StartScan{std::move(request)});
  worker.wait();
  return report;
}

/// Two label maps with the same regions, objects and names; objectness differs by little.
void expectSameRegions(const std::string& a, const std::string& b) {
  auto first = nlohmann::json::parse(a), second = nlohmann::json::parse(b);
  for (auto& [region, entry] : first.items()) {
    ASSERT_TRUE(second.contains(region)) << region;
    ASSERT_EQ(entry.contains("objectness"), second[region].contains("objectness")) << region;
    if (!entry.contains("objectness")) continue;
    constexpr double kLittle = 0.2;  // log-odds
    EXPECT_NEAR(entry["objectness"].get<double>(), second[region]["objectness"].get<double>(), kLittle);
    entry.erase("objectness");
    second[region].erase("objectness");
  }
  EXPECT_EQ(first, second);
}

class LaterRefinementTest : public testing::Test {
 protected:
  static void SetUpTestSuite() {
    const test::TemporaryFolder folder;
    const ScanEnding ending = runScan(requestIn(folder));
    ASSERT_TRUE(ending.report) << ending.error;
    steps_ = ending.refinement.front().steps;
    direct_ = resultsIn(folder);
    ASSERT_FALSE(direct_.objects.empty());
    ASSERT_FALSE(direct_.can_be_refined);
  }
  static void expectAsDirect(const test::TemporaryFolder& folder) {
    const Results results = resultsIn(folder);
    EXPECT_THAT(results.objects, testing::ElementsAreArray(direct_.objects));
    // Labels of a few voxels at borders may differ, and what is measured of their regions.
    ASSERT_EQ(results.mask_px.size(), direct_.mask_px.size());
    for (std::size_t i = 0; i < results.mask_px.size(); ++i)
      EXPECT_NEAR(results.mask_px[i], direct_.mask_px[i], 0.02 * direct_.mask_px[i]) << i;
    expectSameRegions(results.labels, direct_.labels);
    ASSERT_EQ(results.cloud.size(), direct_.cloud.size());
    const auto equal = std::inner_product(results.cloud.begin(), results.cloud.end(), direct_.cloud.begin(),
                                          std::size_t{0}, std::plus<>(), std::equal_to<>());
    EXPECT_LT(results.cloud.size() - equal, results.cloud.size() / 2000);
    EXPECT_FALSE(results.can_be_refined);
  }
  static int steps_;
  static Results direct_;
};
int LaterRefinementTest::steps_ = 0;
Results LaterRefinementTest::direct_;

TEST_F(LaterRefinementTest, GivesTheSameResults_AsAtOnce) {
  const test::TemporaryFolder folder;
  ScanRequest request = requestIn(folder);
  request.skip_refinement = true;
  ASSERT_TRUE(runScan(std::move(request)).report);
  const Results skipped = resultsIn(folder);
  EXPECT_TRUE(skipped.can_be_refined);
  EXPECT_NE(skipped.cloud, direct_.cloud) << "refinement changes nothing: the test shows nothing";
  const ScanEnding ending = runScan(requestToRefine(folder));
  ASSERT_TRUE(ending.report) << ending.error;
  EXPECT_FALSE(ending.report->refinement.skipped);
  expectAsDirect(folder);
  const auto report = nlohmann::json::parse(test::readText(folder / "out/report.json"));
  EXPECT_EQ(report["refinement"]["skipped"], false);
  EXPECT_GT(report["fps"], 0) << "the frame rate of the scan";
  EXPECT_EQ(report["objects"].size(), direct_.objects.size());
}

TEST_F(LaterRefinementTest, ContinuesWhereItStopped) {
  const test::TemporaryFolder folder;
  // Stops in the first pass, then in the pass that collects objects.
  EXPECT_TRUE(runUntilStep(requestIn(folder), steps_ / 6).refinement.skipped);
  EXPECT_TRUE(resultsIn(folder).can_be_refined);
  EXPECT_TRUE(runUntilStep(requestToRefine(folder), steps_ * 6 / 10).refinement.skipped);
  EXPECT_TRUE(resultsIn(folder).can_be_refined);
  const ScanEnding ending = runScan(requestToRefine(folder));
  ASSERT_TRUE(ending.report) << ending.error;
  EXPECT_GT(ending.refinement.front().done, steps_ / 2);
  expectAsDirect(folder);
}

TEST(LaterRefinement, KeepsEditsMadeBefore) {
  const test::TemporaryFolder folder;
  ScanRequest request = requestIn(folder, kFew);
  request.skip_refinement = true;
  ASSERT_TRUE(runScan(std::move(request)).report);
  RegionId edited;
  {
    const test::QtMainThread qt;
    auto session = OpenSession::open(folder / "out");
    ASSERT_TRUE(session) << session.error().message();
    EXPECT_TRUE((*session)->canBeRefined());
    const auto regions = (*session)->regions();
    edited = std::ranges::max_element(*regions, {}, &RegionSummary::voxels)->region;
    Operation operation;
    operation.kind = OperationKind::background;
    operation.regions = {edited};
    ASSERT_TRUE((*session)->edit(operation));
  }
  ASSERT_TRUE(runScan(requestToRefine(folder)).report);
  const test::QtMainThread qt;
  const auto session = OpenSession::open(folder / "out");
  ASSERT_TRUE(session) << session.error().message();
  EXPECT_TRUE((*session)->noteOf(edited).background);
  EXPECT_EQ((*session)->history().entries().size(), 1U);
}

TEST(LaterRefinement, RefusesAMissingOrForeignCatalogue) {
  const test::TemporaryFolder folder;
  ScanRequest request = requestIn(folder, kFew);
  request.skip_refinement = true;
  ASSERT_TRUE(runScan(std::move(request)).report);
  const test::QtMainThread qt;
  std::filesystem::remove(folder / "catalogue.sqlite");
  EXPECT_THAT(runScan(requestToRefine(folder)).error, testing::HasSubstr("is not there"));
  EXPECT_FALSE(std::filesystem::exists(folder / "catalogue.sqlite")) << "no catalogue is made";
  ASSERT_TRUE(ObjectDatabase::open((folder / "catalogue.sqlite").string()));
  EXPECT_THAT(runScan(requestToRefine(folder)).error, testing::HasSubstr("catalogue"));
  EXPECT_TRUE(resultsIn(folder).can_be_refined);
}

TEST(Refinement, EndsAtTheNextFrame_WhenSkippedDuringIt) {
  const test::TemporaryFolder folder;
  const test::QtMainThread qt;
  std::atomic<int> steps = 0;
  std::optional<ScanReport> report;
  std::vector<ScanState> states;
  ScanWorker* running = nullptr;
  ScanWorker worker([&](const ScanEvent& event) {
    if (const auto* state = std::get_if<StateChanged>(&event)) states.push_back(state->state);
    if (std::holds_alternative<RefinementStepped>(event) && ++steps == 2) running->post(SkipRefinement{});
    if (const auto* finished = std::get_if<ScanFinished>(&event)) report = finished->report;
  });
  running = &worker;
  worker.post(StartScan{requestIn(folder)});
  worker.wait();
  ASSERT_TRUE(report);
  EXPECT_TRUE(report->refinement.skipped);
  EXPECT_EQ(steps, 2);
  EXPECT_THAT(states, testing::ElementsAre(ScanState::starting, ScanState::scanning, ScanState::finishing,
                                           ScanState::refining, ScanState::finishing, ScanState::finished));
}

TEST(Refinement, IsOmitted_WithoutASession) {
  const test::TemporaryFolder folder;
  ScanRequest request = requestIn(folder, kFew);
  request.session = false;
  const ScanEnding ending = runScan(std::move(request));
  ASSERT_TRUE(ending.report) << ending.error;
  EXPECT_TRUE(ending.refinement.empty());
  EXPECT_EQ(ending.report->refinement.key_frames, 0);
}

TEST(Refinement, IsSkipped_WhenTheProgramIsClosed) {
  const test::TemporaryFolder folder;
  const test::QtMainThread qt;
  std::atomic<int> steps = 0;
  std::atomic<bool> has_finished = false;
  ScanWorker worker([&](const ScanEvent& event) {
    if (std::holds_alternative<RefinementStepped>(event)) ++steps;
    if (std::holds_alternative<ScanFinished>(event)) has_finished = true;
  });
  ScanRequest request = requestIn(folder);
  request.start_paused = true;
  worker.post(StartScan{std::move(request)});
  for (int i = 0; i < 3; ++i) worker.post(StepScan{});
  int read = 0;
  while (read < 3) {
    if (const auto snapshot = worker.snapshots().collect()) read = snapshot->frames.read;
    std::this_thread::sleep_for(std::chrono::milliseconds(5));
  }
  worker.post(CloseScan{});
  worker.wait();
  EXPECT_TRUE(has_finished) << "the scan finishes with its other results";
  EXPECT_EQ(steps, 0);
}

}  // namespace
}  // namespace scantrove
