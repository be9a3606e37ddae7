// Invalid rows are skipped and named; the rest of the session opens.
#include <gmock/gmock.h>

#include <filesystem>

#include "core/fusion/packed_words.h"
#include "core/fusion/stored_page.h"
#include "core/session/session_restorer.h"
#include "core/session/session_setup.h"
#include "core/session/session_store.h"
#include "core/session/session_writer.h"
#include "tests/support/qt_main_thread.h"
#include "tests/support/temporary_folder.h"

namespace scantrove::test {
namespace {

using testing::AllOf;
using testing::ElementsAre;
using testing::HasSubstr;
using testing::IsEmpty;

SavedDelta validDelta() {
  SavedDelta delta;
  delta.metadata = {{"last_region", "9"}, {"source", "demo"}};
  SavedFrame frame;
  frame.number = 1;
  frame.state = TrackingState::tracking;
  delta.frames = {frame};
  SavedKeyFrame key;
  key.frame = 1;
  key.color_file = "keyframes/000001.color.png";
  key.depth_file = "keyframes/000001.depth.png";
  key.color_width = 640;
  key.color_height = 480;
  key.color_camera = ColorCamera{{525, 525, 319.5F, 239.5F, 640, 480}, Eigen::Isometry3d::Identity()};
  delta.key_frames = {key};
  delta.fragments = {{FragmentId{7}, RegionId{3}, 100, {}}};
  delta.regions = {{RegionId{3}, ObjectId{2}, {"cup", "cup", false, true, false}}};
  delta.recordings = {{1, "demo", 0, 0.5}};
  BorderEvidence evidence;
  evidence.observations = 3;
  delta.borders = {{FragmentId{7}, FragmentId{9}, evidence}};
  delta.estimates = {{{1, -2, 3}, {5 | 2U << 16U, 7, 511 | 8U << 16U, 9}}};
  delta.objectness = SavedObjectness{{RegionId{3}, 1.5F}};
  delta.operations = {{1,
                       {.kind = OperationKind::join, .regions = {RegionId{3}, RegionId{5}}},
                       {.moves = {{FragmentId{9}, RegionId{5}, RegionId{3}}},
                        .constraints = {{FragmentId{7}, FragmentId{9}}},
                        .notes = {}},
                       OperationLog::State::done}};
  return delta;
}

struct Change {
  const char* name;
  QString sql;
  const char* skipped;  ///< rows as the message names them
};

void PrintTo(const Change& change, std::ostream* stream) { *stream << change.name; }

class SavedSessionTest : public testing::Test {
 protected:
  void SetUp() override {
    auto store = SessionStore::create(folder_ / "scan");
    ASSERT_TRUE(store) << store.error().message();
    ASSERT_TRUE((*store)->writePages(std::vector{SavedPage{{1, 2, 3}, std::vector<std::uint32_t>(500, 1)},
                                                 SavedPage{{2, 2, 3}, std::vector<std::uint32_t>(500, 2)}}));
    ASSERT_TRUE((*store)->save(validDelta()));
  }

  void change(const QString& sql) {
    const auto connection = DatabaseConnection::open((folder_ / "scan" / "session.sqlite").string());
    ASSERT_TRUE(connection);
    ASSERT_TRUE((*connection)->execute("PRAGMA foreign_keys = OFF"));
    const auto done = (*connection)->execute(sql);
    ASSERT_TRUE(done) << done.error().message();
  }

  TemporaryFolder folder_;
};

class DamagedRowTest : public SavedSessionTest, public testing::WithParamInterface<Change> {};

TEST_F(SavedSessionTest, ReportsNoDamage_WhenRowsAreValid) {
  const auto store = SessionStore::open(folder_ / "scan");
  ASSERT_TRUE(store) << store.error().message();
  const auto scan = (*store)->load();
  ASSERT_TRUE(scan);
  EXPECT_THAT((*store)->damages(), IsEmpty());
  EXPECT_EQ(scan->frames.size() + scan->key_frames.size() + scan->fragments.size() + scan->regions.size() +
                scan->borders.size() + scan->operations.size() + scan->pages.size() +
                scan->recordings.size() + scan->estimates.size() + scan->objectness.size(),
            11U);
}

TEST_P(DamagedRowTest, SkipsAndNamesTheRow) {
  change(GetParam().sql);
  const auto store = SessionStore::open(folder_ / "scan");
  ASSERT_TRUE(store) << store.error().message();
  const auto scan = (*store)->load();
  ASSERT_TRUE(scan) << scan.error().message();
  EXPECT_THAT((*store)->damages(), ElementsAre(HasSubstr(std::string("1 ") + GetParam().skipped)));
  EXPECT_EQ(scan->frames.size() + scan->key_frames.size() + scan->fragments.size() + scan->regions.size() +
                scan->borders.size() + scan->operations.size() + scan->pages.size() +
                scan->recordings.size() + scan->estimates.size() + scan->objectness.size() +
                scan->metadata.size(),
            12U);
}

TEST(DamagedRows, SkipsAFrame_WhenItsCameraIsImpossible) {
  const TemporaryFolder folder;
  {
    const auto store = SessionStore::create(folder.path() / "scan");
    ASSERT_TRUE(store) << store.error().message();
    SavedDelta delta;
    for (const float focal : {210.0F, 0.0F, -210.0F}) {
      SavedFrame frame;
      frame.number = static_cast<int>(delta.frames.size());
      frame.intrinsics = Intrinsics{focal, 210, 127.5F, 95.5F, 256, 192};
      delta.frames.push_back(frame);
    }
    ASSERT_TRUE((*store)->save(delta));
  }
  const auto store = SessionStore::open(folder.path() / "scan");
  ASSERT_TRUE(store) << store.error().message();
  const Result<SavedScan> scan = (*store)->load();
  ASSERT_TRUE(scan) << scan.error().message();
  ASSERT_EQ(scan->frames.size(), 1U);
  EXPECT_EQ(scan->frames[0].intrinsics, (Intrinsics{210, 210, 127.5F, 95.5F, 256, 192}));
  ASSERT_EQ((*store)->damages().size(), 1U);
  EXPECT_THAT((*store)->damages()[0], HasSubstr("2 frames"));
}

TEST(DamagedRows, CamerasOfAnotherImageSizeAreLeftOut) {
  const QtMainThread qt;
  const TemporaryFolder folder;
  {
    const auto store = SessionStore::create(folder / "scan");
    ASSERT_TRUE(store) << store.error().message();
    SavedDelta delta;
    delta.metadata = metadataOf({"demo", Intrinsics{212, 212, 127.5F, 95.5F, 256, 192}, ScanParams{}, ""});
    for (const int width : {256, 320}) {
      SavedFrame frame;
      frame.number = static_cast<int>(delta.frames.size());
      frame.intrinsics = Intrinsics{210, 210, 127.5F, 95.5F, width, 192};
      delta.frames.push_back(frame);
    }
    ASSERT_TRUE((*store)->save(delta));
  }
  const auto session = SessionWriter::start(folder / "scan", SessionWriter::Way::open);
  ASSERT_TRUE(session) << session.error().message();
  std::vector<std::string> damages;
  const Result<SavedScan> scan = loadScan(**session, damages);
  ASSERT_TRUE(scan) << scan.error().message();
  ASSERT_EQ(scan->frames.size(), 2U);
  EXPECT_TRUE(scan->frames[0].intrinsics);
  EXPECT_FALSE(scan->frames[1].intrinsics);
  EXPECT_THAT(damages, ElementsAre(HasSubstr("cameras of 1 frames")));
}

QString operation(const char* regions, const char* moves, const char* constraints) {
  return QString(R"(UPDATE operations SET operation = '{"kind": "join", "regions": %1}', )"
                 R"(effect = '{"moves": %2, "said": %3, "notes": []}')")
      .arg(regions, moves, constraints);
}

INSTANTIATE_TEST_SUITE_P(
    Tables, DamagedRowTest,
    testing::Values(
        Change{"border of nothing", "UPDATE borders SET a = 0", "borders"},
        Change{"border with itself", "UPDATE borders SET a = b", "borders"},
        Change{"border turned round", "UPDATE borders SET a = 10", "borders"},
        Change{"border beyond 24 bits", "UPDATE borders SET b = 16777216", "borders"},
        Change{"border of 2^32", "UPDATE borders SET b = 4294967303", "borders"},
        Change{"constraint unknown", "UPDATE borders SET said = -1", "borders"},
        Change{"order at the end", "UPDATE borders SET said_order = 2147483647", "borders"},
        Change{"evidence of 1e38", "UPDATE borders SET evidence = x'9699967e' || substr(evidence, 5)",
               "borders"},
        Change{"operation without list", operation("{\"a\": 3}", "[]", "[]"), "operations"},
        Change{"operation of -1", operation("[-1]", "[]", "[]"), "operations"},
        Change{"operation of 2^32", operation("[4294967299]", "[]", "[]"), "operations"},
        Change{"move of nothing", operation("[3]", "[[0, 3, 5]]", "[]"), "operations"},
        Change{"move beyond 24 bits", operation("[3]", "[[16777216, 3, 5]]", "[]"), "operations"},
        Change{"constraint with itself", operation("[3]", "[]", "[[7, 7, 0, 1]]"), "operations"},
        Change{"constraint with nothing", operation("[3]", "[]", "[[0, 7, 0, 1]]"), "operations"},
        Change{"constraint of unknown kind", operation("[3]", "[]", "[[7, 9, 0, 3]]"), "operations"},
        Change{"operation 0", "UPDATE operations SET number = 0", "operations"},
        Change{"operation of 2^31", "UPDATE operations SET number = 2147483648", "operations"},
        Change{"fragment -1", "UPDATE fragments SET fragment = -1", "fragments"},
        Change{"fragment beyond 24 bits", "UPDATE fragments SET fragment = 16777216", "fragments"},
        Change{"fragment of no region", "UPDATE fragments SET region = 0", "fragments"},
        Change{"fragment of the last region", "UPDATE fragments SET region = 4294967295", "fragments"},
        Change{"more support than pixels", "UPDATE fragments SET support_pixels = 7", "fragments"},
        Change{"carried by fewer than none", "UPDATE fragments SET carried_pixels = -1", "fragments"},
        Change{"seen without end", "UPDATE fragments SET seen_pixels = 9e999", "fragments"},
        Change{"seen from a half", "UPDATE fragments SET seen_from = x'0102'", "fragments"},
        Change{"region 0", "UPDATE regions SET region = 0", "regions"},
        Change{"object of text", "UPDATE regions SET object = 'cup'", "regions"},
        Change{"estimates cut off", "UPDATE estimates SET cells = substr(cells, 1, 15)", "estimated labels"},
        Change{"estimates of a half cell", "UPDATE estimates SET cells = substr(cells, 1, 12)",
               "estimated labels"},
        Change{"estimates of cell 512", "UPDATE estimates SET cells = x'0002010007000000'",
               "estimated labels"},
        Change{"estimates of no frame", "UPDATE estimates SET cells = x'0500000007000000'",
               "estimated labels"},
        Change{"estimates of nine frames", "UPDATE estimates SET cells = x'0500090007000000'",
               "estimated labels"},
        Change{"estimates of a cell twice",
               "UPDATE estimates SET cells = x'05000100070000000500010007000000'", "estimated labels"},
        Change{"estimates far away", "UPDATE estimates SET y = 4294967290", "estimated labels"},
        Change{"rating of no region", "UPDATE objectness SET region = 0", "ratings"},
        Change{"rating of text", "UPDATE objectness SET log_odds = 'likely'", "ratings"},
        Change{"rating of infinity", "UPDATE objectness SET log_odds = 9e999", "ratings"},
        Change{"rating of -1e9", "UPDATE objectness SET log_odds = -1e9", "ratings"},
        Change{"frame of 2^32", "UPDATE frames SET number = 4294967297", "frames"},
        Change{"frame -7", "UPDATE frames SET number = -7", "frames"},
        Change{"state unknown", "UPDATE frames SET state = 'banana'", "frames"},
        Change{"time of infinity", "UPDATE frames SET time_s = 9e999", "frames"},
        Change{"far away", "UPDATE frames SET tx = 1e300", "frames"},
        Change{"no place", "UPDATE frames SET ty = NULL", "frames"},
        Change{"quaternion of 1e300", "UPDATE frames SET qx = 1e300, qy = 1e300", "frames"},
        Change{"quaternion of 5", "UPDATE frames SET qw = 5", "frames"},
        Change{"quaternion of 0", "UPDATE frames SET qw = 0", "frames"},
        Change{"quaternion of text", "UPDATE frames SET qw = 'one'", "frames"},
        Change{"unit of 0", "UPDATE key_frames SET metres_per_unit = 0", "key frames"},
        Change{"unit of 1e30", "UPDATE key_frames SET metres_per_unit = 1e30", "key frames"},
        Change{"focal length of 1e-30", "UPDATE key_frames SET color = replace(color, '525.0', '1e-30')",
               "key frames"},
        Change{"colour of no size", "UPDATE key_frames SET color = replace(color, '640', '-640')",
               "key frames"},
        Change{"page beyond bricks", "UPDATE pages SET x = 4294967290 WHERE x = 1", "parts of the map"},
        Change{"page in file 2^63", "UPDATE pages SET file = 9223372036854775807 WHERE x = 1",
               "parts of the map"},
        Change{"page in file -5", "UPDATE pages SET file = -5 WHERE x = 1", "parts of the map"},
        Change{"page at -10", "UPDATE pages SET offset = -10 WHERE x = 1", "parts of the map"},
        Change{"page of nothing", "UPDATE pages SET bytes = 0 WHERE x = 1", "parts of the map"},
        Change{"page of 2^32", "UPDATE pages SET bytes = 4294967296 WHERE x = 1", "parts of the map"},
        Change{"page unpacked to 2^32", "UPDATE pages SET unpacked_bytes = 4294967296 WHERE x = 1",
               "parts of the map"}));

// A scan could have written each of these rows; only the checksum differs.
INSTANTIATE_TEST_SUITE_P(
    Plausible, DamagedRowTest,
    testing::Values(Change{"pose moved by 10 cm", "UPDATE frames SET tx = 0.1", "frames"},
                    Change{"frame turned round", "UPDATE frames SET qx = 1, qw = 0", "frames"},
                    Change{"frame lost", "UPDATE frames SET state = 'lost'", "frames"},
                    Change{"frame of another time", "UPDATE frames SET time_s = 7", "frames"},
                    Change{"another image", "UPDATE key_frames SET depth_file = 'keyframes/000002.depth.png'",
                           "key frames"},
                    Change{"another unit", "UPDATE key_frames SET metres_per_unit = 0.002", "key frames"},
                    Change{"another checksum", "UPDATE key_frames SET row_check = row_check + 1",
                           "key frames"},
                    Change{"fragment of another region", "UPDATE fragments SET region = 4", "fragments"},
                    Change{"another name", "UPDATE regions SET name = 'cap'", "regions"},
                    Change{"another object", "UPDATE regions SET object = 3", "regions"},
                    Change{"no object", "UPDATE regions SET object = 0", "regions"},
                    Change{"constraint", "UPDATE borders SET said = 1", "borders"},
                    Change{"border of others", "UPDATE borders SET b = 8", "borders"},
                    Change{"estimates elsewhere", "UPDATE estimates SET z = 4", "estimated labels"},
                    Change{"another rating", "UPDATE objectness SET log_odds = 1.25", "ratings"},
                    Change{"rating of another region", "UPDATE objectness SET region = 4", "ratings"},
                    Change{"undone", "UPDATE operations SET state = 'undone'", "operations"},
                    Change{"another recording", "UPDATE recordings SET index_shift = 7", "recordings"},
                    Change{"moved page", "UPDATE pages SET x = 5 WHERE x = 1", "parts of the map"}));

struct Deletion {
  const char* name;
  QString sql;
  const char* missing;  ///< rows as the message names them
};

void PrintTo(const Deletion& deletion, std::ostream* stream) { *stream << deletion.name; }

class DeletedRowTest : public SavedSessionTest, public testing::WithParamInterface<Deletion> {};

TEST_P(DeletedRowTest, ReportsTheMissingRow) {
  change(GetParam().sql);
  const auto store = SessionStore::open(folder_ / "scan");
  ASSERT_TRUE(store) << store.error().message();
  const auto scan = (*store)->load();
  ASSERT_TRUE(scan) << scan.error().message();
  EXPECT_THAT((*store)->damages(), ElementsAre(HasSubstr(GetParam().missing)));
}

INSTANTIATE_TEST_SUITE_P(
    Tables, DeletedRowTest,
    testing::Values(
        Deletion{"frame", "DELETE FROM frames", "1 frames"},
        Deletion{"key frame", "DELETE FROM key_frames", "1 key frames"},
        Deletion{"fragment", "DELETE FROM fragments", "1 fragments"},
        Deletion{"region", "DELETE FROM regions", "1 regions"},
        Deletion{"recording", "DELETE FROM recordings", "1 recordings"},
        Deletion{"rating", "DELETE FROM objectness", "1 ratings"},
        Deletion{"border", "DELETE FROM borders", "1 borders"},
        Deletion{"operation", "DELETE FROM operations", "1 operations"},
        Deletion{"page", "DELETE FROM pages WHERE x = 1", "1 parts of the map"},
        Deletion{"frame instead of another", "UPDATE frames SET number = 2, row_check = NULL",
                 "frames of the session"},
        Deletion{
            "border more",
            "INSERT INTO borders SELECT a, b + 1, evidence, said, by_person, said_order, NULL FROM borders",
            "borders of the session"}));

TEST_F(SavedSessionTest, RestoresMetadataFromItsCopy_WhenDamagedOrDeleted) {
  for (const char* sql : {"UPDATE facts SET value = 'attic' WHERE name = 'source'",
                          "UPDATE facts SET value = '4294967295' WHERE name = 'last_region'",
                          "DELETE FROM facts WHERE name = 'source'"}) {
    change(sql);
    const auto store = SessionStore::open(folder_ / "scan");
    ASSERT_TRUE(store) << store.error().message();
    const auto scan = (*store)->load();
    ASSERT_TRUE(scan) << scan.error().message();
    EXPECT_EQ(scan->metadata, validDelta().metadata) << sql;
    EXPECT_THAT((*store)->damages(), ElementsAre(AllOf(HasSubstr("facts"), HasSubstr("copies")))) << sql;
    ASSERT_TRUE((*store)->save(validDelta()));
  }
}

TEST_F(SavedSessionTest, ReportsNoDamage_WhenAnOlderSessionHasNoChecksums) {
  for (const char* table : {"facts", "fact_copies", "frames", "key_frames", "fragments", "regions", "borders",
                            "operations", "pages"})
    change(QString("UPDATE %1 SET row_check = NULL").arg(table));
  change("DELETE FROM table_sums");
  const auto store = SessionStore::open(folder_ / "scan");
  ASSERT_TRUE((*store)->load());
  EXPECT_THAT((*store)->damages(), IsEmpty());
}

TEST_F(SavedSessionTest, LoadPageFails_WhenItsOffsetExceedsTheFile) {
  change("UPDATE pages SET offset = 4294967290, row_check = NULL WHERE x = 1");
  const auto store = SessionStore::open(folder_ / "scan");
  ASSERT_TRUE(store) << store.error().message();
  const auto page = (*store)->loadPage({1, 2, 3});
  ASSERT_FALSE(page);
  EXPECT_THAT(page.error().message(), HasSubstr("000001.bricks"));
  EXPECT_TRUE((*store)->loadPage({2, 2, 3}));
}

TEST(RecordFile, ReadFails_WhenOffsetAndSizeOverflow) {
  const TemporaryFolder folder;
  auto file = RecordFile::create(folder / "records");
  ASSERT_TRUE(file);
  ASSERT_TRUE(file->append(packWords(std::vector<std::uint32_t>(500, 1))));
  const auto read = file->read(~std::uint64_t{0} - 4, 10);
  ASSERT_FALSE(read);
  EXPECT_THAT(read.error().message(), HasSubstr("shorter"));
}

TEST_F(SavedSessionTest, ReplacesADamagedOperation_WhenItsNumberIsSavedAgain) {
  change("UPDATE operations SET operation = '{'");
  {
    const auto store = SessionStore::open(folder_ / "scan");
    ASSERT_TRUE(store);
    ASSERT_TRUE((*store)->save(validDelta()));
  }
  const auto store = SessionStore::open(folder_ / "scan");
  const auto scan = (*store)->load();
  ASSERT_TRUE(scan);
  ASSERT_EQ(scan->operations.size(), 1U);
  EXPECT_EQ(scan->operations[0].operation, validDelta().operations[0].operation);
}

TEST(StoredPage, IsRefused_WhenAnEmptyCellNamesASlot) {
  StoredPage page;
  page.cells.fill(PAGE_EMPTY_CUBE(0));
  std::vector<std::uint32_t> words = page.toWords();
  EXPECT_TRUE(StoredPage::fromWords(words));
  words[5] = 0;
  EXPECT_FALSE(StoredPage::fromWords(words));
}

}  // namespace
}  // namespace scantrove::test
