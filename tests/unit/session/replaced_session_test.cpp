// A new scan replaces an earlier one in one transaction, with its first frame that has a pose.
#include <gmock/gmock.h>

#include <filesystem>
#include <set>

#include "core/database/database_connection.h"
#include "core/session/session_files.h"
#include "core/session/session_store.h"
#include "tests/support/temporary_folder.h"

namespace scantrove::test {
namespace {

namespace fs = std::filesystem;
using testing::HasSubstr;

class ReplacedSessionTest : public testing::Test {
 protected:
  void SetUp() override { ASSERT_TRUE(scan(*created(), 1)); }

  std::unique_ptr<SessionStore> created() const {
    auto store = SessionStore::create(path_);
    EXPECT_TRUE(store) << store.error().message();
    return store ? std::move(*store) : nullptr;
  }

  /// Saves one frame with its images, one map page and one region.
  Result<void> scan(SessionStore& store, int seed, TrackingState state = TrackingState::tracking) const {
    SavedFrame frame;
    frame.source_index = seed;
    frame.state = state;
    SavedKeyFrame key;
    for (auto [file, ending] :
         {std::pair(&key.color_file, ".color.jpg"), std::pair(&key.depth_file, ".depth.png")}) {
      SCANTROVE_TRY(moveInto(*file, store.claimImage("000000", ending)));
      folder_.write("scan/" + file->string(), "image " + std::to_string(seed));
    }
    SCANTROVE_TRY(
        store.writePages(std::vector{SavedPage{{seed, 0, 0}, {1, 2, static_cast<std::uint32_t>(seed)}}}));
    SCANTROVE_TRY(store.saveKeyFrame(frame, key));
    SavedDelta delta;
    delta.metadata["source"] = std::to_string(seed);
    delta.regions = {{RegionId{static_cast<std::uint32_t>(seed)}, {}, {}}};
    return store.save(delta);
  }

  /// The session contains exactly one scan, and its folders only the files of that scan.
  void expectScan(int seed) const {
    const auto store = SessionStore::open(path_);
    ASSERT_TRUE(store) << store.error().message();
    const auto scan = (*store)->load();
    ASSERT_TRUE(scan) << scan.error().message();
    EXPECT_TRUE((*store)->damages().empty()) << (*store)->damages().front();
    ASSERT_EQ(scan->frames.size(), 1U);
    EXPECT_EQ(scan->frames[0].source_index, seed);
    EXPECT_EQ(scan->metadata.at("source"), std::to_string(seed));
    ASSERT_EQ(scan->regions.size(), 1U);
    EXPECT_EQ(scan->regions[0].region.value, static_cast<std::uint32_t>(seed));
    ASSERT_EQ(scan->key_frames.size(), 1U);
    const SavedKeyFrame& key = scan->key_frames[0];
    for (const fs::path& file : {key.color_file, key.depth_file})
      EXPECT_EQ(readText(path_ / file), "image " + std::to_string(seed)) << file;
    ASSERT_EQ(scan->pages.size(), 1U);
    EXPECT_TRUE((*store)->loadPage({seed, 0, 0}));
    EXPECT_EQ(countIn("keyframes"), 2);
    EXPECT_EQ(countIn("map"), 1);
  }

  std::ptrdiff_t countIn(const char* part) const {
    return std::distance(fs::directory_iterator(path_ / part), {});
  }

  TemporaryFolder folder_;
  const fs::path path_ = folder_ / "scan";
};

TEST_F(ReplacedSessionTest, KeepsTheEarlierScan_UntilAFrameHasAPose) {
  expectScan(1);
  {
    const auto store = created();
    ASSERT_TRUE(scan(*store, 2, TrackingState::lost));
    EXPECT_TRUE(store->load()->frames.empty()) << "the new scan has nothing to show yet";
  }
  expectScan(1);
}

TEST_F(ReplacedSessionTest, HasAllNewFrames_WhenOneHasAPose) {
  {
    const auto store = created();
    SavedDelta metadata;
    metadata.metadata["params"] = "from before the first frame";
    SavedFrame lost;
    lost.number = 7;
    metadata.frames = {lost};
    ASSERT_TRUE(store->save(metadata));
    ASSERT_TRUE(scan(*store, 2));
    EXPECT_EQ(store->load()->frames.size(), 2U);
    EXPECT_EQ(store->load()->metadata.at("params"), "from before the first frame");
  }
  { ASSERT_TRUE(scan(*created(), 3)); }
  expectScan(3);
}

TEST_F(ReplacedSessionTest, KeepsTheEarlierScan_WhenKilledBeforeReplacing) {
  // A copy of the folder at this moment equals the files of a killed program.
  const auto store = created();
  ASSERT_TRUE(scan(*store, 2, TrackingState::lost));
  fs::copy(path_, folder_ / "killed", fs::copy_options::recursive);
  EXPECT_GT(std::distance(fs::directory_iterator(folder_ / "killed" / "keyframes"), {}), 2);
  fs::remove_all(path_);
  fs::rename(folder_ / "killed", path_);
  expectScan(1);
}

TEST_F(ReplacedSessionTest, HasTheNewScan_WhenClosedAfterReplacing) {
  {
    const auto store = created();
    ASSERT_EQ(fs::is_regular_file(path_ / "map" / "000001.bricks"), true);
    ASSERT_TRUE(scan(*store, 2));
  }
  expectScan(2);
}

TEST_F(ReplacedSessionTest, RefusesASecondWriter_FromTheBeginning) {
  const auto store = created();
  const auto second = SessionStore::create(path_);
  ASSERT_FALSE(second);
  EXPECT_THAT(second.error().message(), HasSubstr("in use"));
}

TEST_F(ReplacedSessionTest, KeepsForeignFiles_WhateverTheirNames) {
  const std::set<std::string> mine{"keyframes/holiday.jpg",
                                   "keyframes/000000.color.jpg.bak",
                                   "keyframes/000123.color.png",
                                   "keyframes/000000-2.color.jpg",
                                   "map/notes.txt",
                                   "map/000002.bricks",
                                   "map/000001.bricks.old",
                                   "keyframes/album/000000.color.jpg"};
  EXPECT_EQ(findForeignFile(path_), std::nullopt);
  for (const std::string& name : mine) folder_.write("scan/" + name, "mine");
  EXPECT_TRUE(findForeignFile(path_));
  { ASSERT_TRUE(scan(*created(), 2)); }
  { ASSERT_TRUE(scan(*created(), 3)); }
  for (const std::string& name : mine) EXPECT_EQ(readText(path_ / name), "mine") << name;
  EXPECT_EQ((*SessionStore::open(path_))->load()->frames.at(0).source_index, 3);
}

TEST_F(ReplacedSessionTest, RefusesToReplaceALabeledSession) {
  {
    SavedDelta delta;
    delta.operations = {
        {1, {.kind = OperationKind::reject, .regions = {RegionId{1}}}, {}, OperationLog::State::done}};
    ASSERT_TRUE((*SessionStore::open(path_))->save(delta));
  }
  const auto refused = SessionStore::create(path_);
  ASSERT_FALSE(refused);
  EXPECT_THAT(refused.error().message(), HasSubstr("--resume"));
  expectScan(1);
}

TEST_F(ReplacedSessionTest, KeepsAForeignTable) {
  const std::string file = (path_ / "session.sqlite").string();
  {
    const auto other = DatabaseConnection::open(file);
    ASSERT_TRUE(other && (*other)->execute("CREATE TABLE notes (text TEXT)"));
    ASSERT_TRUE((*other)->execute("INSERT INTO notes VALUES ('of a person')"));
  }
  { ASSERT_TRUE(scan(*created(), 3)); }
  expectScan(3);
  const auto other = DatabaseConnection::open(file);
  ASSERT_TRUE(other);
  Result<QSqlQuery> notes = (*other)->execute("SELECT text FROM notes");
  ASSERT_TRUE(notes && notes->next());
  EXPECT_EQ(notes->value(0).toString(), "of a person");
}

}  // namespace
}  // namespace scantrove::test
