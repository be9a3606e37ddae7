// A named region becomes an object of the catalogue, during a scan and in the saved session.
#include <gmock/gmock.h>

#include <algorithm>
#include <array>
#include <map>

#include "core/catalogue/object_database.h"
#include "core/session/open_session.h"
#include "core/session/session_catalogue.h"
#include "tests/pipeline/session/scan_worker_fixture.h"

namespace scantrove {
namespace {

using test::ScanWorkerTest;
using testing::HasSubstr;

class RegionNamingTest : public ScanWorkerTest {
 protected:
  /// Starts a scan of `frames` frames and pauses after `frame`. Result: regions in view, largest first.
  std::vector<RegionId> scanUntil(int frame, int frames) {
    ScanRequest scan = request(frames);
    scan.output_folder = folder_ / "scan";
    scan.database = (folder_ / "scan" / "catalogue.sqlite").string();
    scan.start_paused = true;
    worker_.post(StartScan{scan});
    for (int i = 0; i < frame; ++i) worker_.post(StepScan{});
    const auto snapshot = awaitSnapshot(frame);
    if (!snapshot) return {};
    std::map<int, int> pixels;
    for (const int region : cv::Mat_<int>(snapshot->regions)) ++pixels[region];
    pixels.erase(0);
    std::vector<std::pair<int, int>> sizes;
    for (const auto& [region, count] : pixels) sizes.emplace_back(-count, region);
    std::ranges::sort(sizes);
    std::vector<RegionId> regions;
    for (const auto& [count, region] : sizes) regions.push_back(RegionId{static_cast<std::uint32_t>(region)});
    return regions;
  }
  void edit(const ScanEdit& edit) {
    const std::size_t before = log_.all<Edited>().size() + log_.all<EditFailed>().size();
    worker_.post(EditRegions{edit});
    for (int i = 0; i < 6000 && log_.all<Edited>().size() + log_.all<EditFailed>().size() == before; ++i)
      std::this_thread::sleep_for(std::chrono::milliseconds(10));
    EXPECT_TRUE(log_.all<EditFailed>().empty());
  }
  static Operation naming(RegionId region, const std::string& name) {
    return {.kind = OperationKind::name, .regions = {region}, .name = name};
  }
  void resumeToEnd() {
    worker_.post(ResumeScan{});
    worker_.wait();
    EXPECT_EQ(worker_.state(), ScanState::finished) << log_.failure();
    EXPECT_TRUE(log_.all<CatalogueFailed>().empty());
  }
  std::vector<ObjectRecord> objects() {
    const auto database = ObjectDatabase::open((folder_ / "scan" / "catalogue.sqlite").string());
    EXPECT_TRUE(database);
    return database ? *(*database)->objects() : std::vector<ObjectRecord>();
  }
  std::vector<ObjectRecord> objectsNamed(const std::string& name) {
    std::vector<ObjectRecord> named = objects();
    std::erase_if(named, [&](const ObjectRecord& object) { return object.name != name; });
    return named;
  }
  std::unique_ptr<OpenSession> open() {
    auto session = OpenSession::open(folder_ / "scan");
    EXPECT_TRUE(session) << session.error().message();
    return session ? std::move(*session) : nullptr;
  }
};

TEST_F(RegionNamingTest, AddsObjects_DuringTheScan) {
  const std::vector<RegionId> regions = scanUntil(12, 30);
  ASSERT_GE(regions.size(), 6U);
  edit(naming(regions[3], "mug"));
  edit(naming(regions[4], "box"));
  edit(naming(regions[5], "wall"));
  edit(Operation{.kind = OperationKind::background, .regions = {regions[5]}});
  edit(Operation{.kind = OperationKind::object, .regions = {regions[2]}});
  resumeToEnd();
  const std::vector<ObjectRecord> mugs = objectsNamed("mug");
  ASSERT_EQ(mugs.size(), 1U);
  EXPECT_TRUE(mugs[0].confirmed);
  EXPECT_EQ(mugs[0].named_by, NamedBy::user);
  EXPECT_GE(mugs[0].views, 1);
  EXPECT_EQ(objectsNamed("box").size(), 1U);
  EXPECT_TRUE(objectsNamed("wall").empty()) << "background";
  EXPECT_TRUE(std::ranges::any_of(log_.all<ObjectNamed>(), [&](const ObjectNamed& named) {
    return named.object == mugs[0].id && named.name == "mug";
  }));
  const auto session = open();
  ASSERT_TRUE(session);
  EXPECT_EQ(session->objectOf(regions[3]), mugs[0].id);
  EXPECT_TRUE(session->objectOf(regions[2])) << "an object without a given name";
  EXPECT_EQ(catalogueFileOf(*session), folder_ / "scan" / "catalogue.sqlite");
  // Operations of the scan are undone later, also in the catalogue.
  for (int i = 0; i < 4; ++i) {
    const auto undone = session->undo();
    ASSERT_TRUE(undone);
    EXPECT_TRUE(applyToCatalogue(*session)) << i;
  }
  EXPECT_TRUE(objectsNamed("box").empty());
  EXPECT_EQ(objectsNamed("mug").size(), 1U);
}

TEST_F(RegionNamingTest, UndoRemovesTheName) {
  const std::vector<RegionId> regions = scanUntil(12, 24);
  ASSERT_GE(regions.size(), 5U);
  edit(naming(regions[3], "first"));
  for (int i = 0; i < 4; ++i) worker_.post(StepScan{});
  ASSERT_TRUE(awaitSnapshot(16));
  edit(naming(regions[3], "second"));
  edit(naming(regions[4], "not yet seen"));
  edit(UndoEdit{});
  edit(UndoEdit{});
  resumeToEnd();
  EXPECT_EQ(objectsNamed("first").size(), 1U);
  EXPECT_TRUE(objectsNamed("second").empty());
  EXPECT_TRUE(objectsNamed("not yet seen").empty());
}

TEST_F(RegionNamingTest, UndoRemovesTheObject_AfterTheScanResumed) {
  const std::vector<RegionId> regions = scanUntil(12, 16);
  ASSERT_GE(regions.size(), 2U);
  // The largest regions are no objects without an edit.
  edit(naming(regions[0], "mug"));
  edit(Operation{.kind = OperationKind::object, .regions = {regions[1]}});
  resumeToEnd();
  ASSERT_EQ(objectsNamed("mug").size(), 1U);
  ObjectId promoted;
  {
    const auto session = open();
    ASSERT_TRUE(session);
    promoted = session->objectOf(regions[1]);
  }
  ASSERT_TRUE(promoted);
  ScanRequest further = request(4);
  further.output_folder = folder_ / "scan";
  further.database.clear();
  further.resume = true;
  further.start_paused = true;
  worker_.post(StartScan{further});
  log_.awaitState(ScanState::paused, 2);
  edit(UndoEdit{});
  edit(UndoEdit{});
  resumeToEnd();
  EXPECT_TRUE(objectsNamed("mug").empty());
  for (const ObjectRecord& object : objects()) EXPECT_NE(object.id, promoted);
  const auto session = open();
  ASSERT_TRUE(session);
  EXPECT_NE(session->objectOf(regions[1]), promoted);
}

TEST_F(RegionNamingTest, AddsTheObject_WhenTheScanStopsAtOnce) {
  const std::vector<RegionId> regions = scanUntil(12, 200);
  ASSERT_GE(regions.size(), 5U);
  edit(naming(regions[3], "named last"));
  worker_.post(StopScan{});
  worker_.wait();
  ASSERT_EQ(objectsNamed("named last").size(), 1U);
  const auto session = open();
  ASSERT_TRUE(session);
  EXPECT_EQ(session->objectOf(regions[3]), objectsNamed("named last")[0].id);
}

TEST_F(RegionNamingTest, AddsAndRemovesAnObject_InASavedSession) {
  const std::vector<RegionId> regions = scanUntil(12, 20);
  ASSERT_GE(regions.size(), 5U);
  resumeToEnd();
  const std::size_t before = objects().size();
  {
    const auto session = open();
    ASSERT_TRUE(session);
    const auto named = session->edit(naming(regions[3], "mug"));
    ASSERT_TRUE(named);
    const Result<void> applied = applyToCatalogue(*session);
    ASSERT_TRUE(applied) << applied.error().message();
    EXPECT_TRUE(session->objectOf(regions[3]));
  }
  ASSERT_EQ(objectsNamed("mug").size(), 1U);
  EXPECT_TRUE(objectsNamed("mug")[0].confirmed);
  {
    const auto session = open();
    ASSERT_TRUE(session);
    EXPECT_EQ(session->objectOf(regions[3]), objectsNamed("mug")[0].id) << "the session stores the object";
    const auto undone = session->undo();
    ASSERT_TRUE(undone);
    ASSERT_TRUE(applyToCatalogue(*session));
  }
  EXPECT_EQ(objects().size(), before);
  EXPECT_TRUE(objectsNamed("mug").empty());
}

TEST_F(RegionNamingTest, UndoAndRedoKeepAMergeByAnotherProgram) {
  const std::vector<RegionId> regions = scanUntil(12, 20);
  ASSERT_GE(regions.size(), 1U);
  resumeToEnd();
  const std::string file = (folder_ / "scan" / "catalogue.sqlite").string();
  const auto session = open();
  ASSERT_TRUE(session);
  ASSERT_TRUE(session->edit(naming(regions[0], "cup")));
  ASSERT_TRUE(applyToCatalogue(*session));
  const ObjectId cup = session->objectOf(regions[0]);
  // Another program names the first object mug and merges the cup into it.
  const ObjectRecord mug = objects().front();
  ASSERT_NE(mug.id, cup);
  const auto other = ObjectDatabase::open(file);
  ASSERT_TRUE(other);
  ASSERT_TRUE((*other)->rename(mug.id, "mug"));
  ASSERT_TRUE((*other)->setConfirmed(std::array{mug.id}, true));
  ASSERT_TRUE((*other)->merge(std::array{mug.id, cup}));
  const std::size_t views = (*other)->views().of(mug.id)->size();

  ASSERT_TRUE(session->undo());
  const Result<void> undone = applyToCatalogue(*session);
  ASSERT_FALSE(undone) << "the undo reports that the merge stays";
  EXPECT_THAT(undone.error().message(), HasSubstr("others"));
  EXPECT_FALSE(session->objectOf(regions[0])) << "as before the naming";
  EXPECT_EQ(objectsNamed("mug").size(), 1U);

  ASSERT_TRUE(session->redo());
  EXPECT_TRUE(applyToCatalogue(*session));
  EXPECT_EQ((*other)->mergeRoot(session->objectOf(regions[0])).value_or(ObjectId{}), mug.id);
  EXPECT_EQ(objectsNamed("mug").size(), 1U) << "the merged object keeps its name";
  EXPECT_TRUE(objectsNamed("cup").empty());
  EXPECT_EQ((*other)->views().of(mug.id)->size(), views);
}

TEST_F(RegionNamingTest, UndoKeepsTheObject_WhenAnotherProgramMergedItsOwnIntoIt) {
  const std::vector<RegionId> regions = scanUntil(12, 20);
  ASSERT_GE(regions.size(), 1U);
  resumeToEnd();
  const auto session = open();
  ASSERT_TRUE(session);
  ASSERT_TRUE(session->edit(naming(regions[0], "cup")));
  ASSERT_TRUE(applyToCatalogue(*session));
  const ObjectId cup = session->objectOf(regions[0]);
  const ObjectRecord found = objects().front();
  const auto other = ObjectDatabase::open((folder_ / "scan" / "catalogue.sqlite").string());
  ASSERT_TRUE(other);
  const auto merge = (*other)->merge(std::array{found.id, cup});
  ASSERT_TRUE(merge);
  ASSERT_EQ(merge->into, cup) << "the object named by a user remains";
  ASSERT_TRUE(session->undo());
  EXPECT_TRUE(applyToCatalogue(*session));
  EXPECT_EQ((*other)->mergeRoot(found.id).value_or(ObjectId{}), cup)
      << "the other program's object is not hidden";
  EXPECT_TRUE(objectsNamed("cup").empty());
}

TEST_F(RegionNamingTest, ReportsAMissingCatalogue) {
  const std::vector<RegionId> regions = scanUntil(8, 10);
  ASSERT_GE(regions.size(), 4U);
  resumeToEnd();
  std::filesystem::rename(folder_ / "scan" / "catalogue.sqlite", folder_ / "elsewhere.sqlite");
  const auto session = open();
  ASSERT_TRUE(session);
  ASSERT_TRUE(session->edit(naming(regions[3], "mug")));
  const Result<void> applied = applyToCatalogue(*session);
  ASSERT_FALSE(applied);
  EXPECT_THAT(applied.error().message(), HasSubstr("catalogue.sqlite"));
  EXPECT_FALSE(std::filesystem::exists(folder_ / "scan" / "catalogue.sqlite")) << "no catalogue is made";
}

}  // namespace
}  // namespace scantrove
