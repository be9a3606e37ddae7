#include "core/session/session_store.h"

#include <gmock/gmock.h>

#include <filesystem>
#include <fstream>

#include "tests/support/temporary_folder.h"

namespace scantrove::test {
namespace {

using testing::HasSubstr;

SavedDelta someDelta(int seed) {
  SavedDelta delta;
  delta.metadata["source"] = "demo:\"\xC3\xA4\n";
  SavedFrame frame;
  frame.number = seed;
  frame.source_index = 500 + seed;
  frame.time_s = 0.5 * seed;
  frame.state = TrackingState::relocalized;
  frame.T_world_camera = Eigen::Translation3d(1, 2, 3) * Eigen::AngleAxisd(0.3, Eigen::Vector3d::UnitY());
  if (seed == 2) frame.intrinsics = Intrinsics{212.34567F, 211.98765F, 127.25F, 95.5F, 256, 192};
  delta.frames.push_back(frame);
  ViewCoverage seen_from;
  seen_from.addDirection({1, 2, -3});
  seen_from.addDirection({-1, 0, static_cast<float>(seed)});
  delta.fragments.push_back({FragmentId{7}, RegionId{3}, 100 + seed, seen_from, {1000.1F, 10.3F, 900}});
  delta.regions.push_back({RegionId{3}, ObjectId{2}, {"red cup", "cup", false, true, false}});
  BorderEvidence evidence;
  evidence.observations = 3.25F;
  evidence.appeared_together = 2;
  evidence.attached = 7;
  evidence.unattached = 1.5F;
  evidence.outlined = 4;
  evidence.unoutlined = 2.5F;
  evidence.appeared_apart = 0.5F;
  evidence.color_shift = 12;
  evidence.step_m = 0.02F;
  evidence.colors = {8, 5, 0.75F, 12, 0.25F, 4};
  evidence.constraint = LinkConstraint::cannot_link;
  evidence.by_person = true;
  evidence.constraint_order = 4;
  delta.borders.push_back({FragmentId{7}, FragmentId{9}, evidence});
  // The brick of seed 1 stays, the next one is replaced, the last one loses its cells.
  delta.estimates = {{{seed, 0, -4}, {5 | 2U << 16U, 7}},
                     {{10, 0, -4}, {static_cast<std::uint32_t>(seed) | 1U << 16U, 7}},
                     {{20, 0, -4}, {}}};
  if (seed == 1) delta.estimates[2].words = {5 | 2U << 16U, 7};
  // The rating of region 5 is gone in the second delta.
  delta.objectness = SavedObjectness{{RegionId{3}, static_cast<float>(seed) + 0.25F}};
  if (seed == 1) (*delta.objectness)[RegionId{5}] = -4;
  delta.operations.push_back(
      {seed,
       {.kind = OperationKind::cut,
        .regions = {RegionId{3}},
        .here_world = {{1, 2, 3}},
        .there_world = {{4, 5, 6}},
        .frame = 12},
       {.moves = {{FragmentId{7}, RegionId{3}, RegionId{5}}}, .constraints = {}, .notes = {}},
       OperationLog::State::undone});
  return delta;
}

SavedPage somePage(int seed) {
  return {{seed, -2, 5}, std::vector<std::uint32_t>(5000, 17U + static_cast<unsigned>(seed))};
}

Result<void> saveSome(SessionStore& store, int seed) {
  SCANTROVE_TRY(store.writePages(std::vector{somePage(seed)}));
  return store.save(someDelta(seed));
}

std::unique_ptr<SessionStore> created(const std::filesystem::path& folder) {
  auto store = SessionStore::create(folder);
  EXPECT_TRUE(store) << store.error().message();
  return std::move(*store);
}

TEST(SessionStore, KeepsRatings_WhenADeltaHasNone) {
  const TemporaryFolder folder;
  const auto store = created(folder / "scan");
  SavedDelta rated;
  rated.objectness = SavedObjectness{{RegionId{3}, 1.5F}};
  ASSERT_TRUE(store->save(rated));
  ASSERT_TRUE(store->save(SavedDelta{}));
  EXPECT_EQ(store->load()->objectness, *rated.objectness);
  rated.objectness->clear();
  ASSERT_TRUE(store->save(rated));
  EXPECT_TRUE(store->load()->objectness.empty());
  EXPECT_TRUE(store->damages().empty());
}

TEST(SessionStore, LoadsWhatWasSaved) {
  const TemporaryFolder folder;
  const std::filesystem::path path = folder.path() / "scan";
  {
    const auto store = created(path);
    ASSERT_TRUE(saveSome(*store, 1));
    ASSERT_TRUE(saveSome(*store, 2));
  }
  const auto store = SessionStore::open(path);
  ASSERT_TRUE(store) << store.error().message();
  const Result<SavedScan> scan = (*store)->load();
  ASSERT_TRUE(scan) << scan.error().message();
  const SavedDelta last = someDelta(2);
  EXPECT_EQ(scan->metadata, last.metadata);
  ASSERT_EQ(scan->frames.size(), 2U);
  EXPECT_EQ(scan->frames[1].source_index, 502);
  EXPECT_EQ(scan->frames[1].state, TrackingState::relocalized);
  EXPECT_TRUE(scan->frames[1].T_world_camera.isApprox(last.frames[0].T_world_camera, 1e-12));
  EXPECT_FALSE(scan->frames[0].intrinsics);
  EXPECT_EQ(scan->frames[1].intrinsics, last.frames[0].intrinsics) << "all bits";
  ASSERT_EQ(scan->fragments.size(), 1U);
  EXPECT_EQ(scan->fragments[0].voxels, 102);
  EXPECT_EQ(scan->fragments[0].seen_from, last.fragments[0].seen_from);
  EXPECT_EQ(scan->fragments[0].support_pixels, last.fragments[0].support_pixels);
  ASSERT_EQ(scan->regions.size(), 1U);
  EXPECT_EQ(scan->regions[0], last.regions[0]);
  EXPECT_EQ(scan->objectness, (SavedObjectness{{RegionId{3}, 2.25F}}));
  ASSERT_EQ(scan->borders.size(), 1U);
  EXPECT_EQ(scan->borders[0].evidence->observations, 3.25F);
  EXPECT_EQ(scan->borders[0].evidence->appeared_together, 2);
  EXPECT_EQ(scan->borders[0].evidence->appeared_apart, 0.5F);
  EXPECT_EQ(scan->borders[0].evidence->attached, 7);
  EXPECT_EQ(scan->borders[0].evidence->unattached, 1.5F);
  EXPECT_EQ(scan->borders[0].evidence->outlined, 4);
  EXPECT_EQ(scan->borders[0].evidence->unoutlined, 2.5F);
  EXPECT_EQ(scan->borders[0].evidence->color_shift, 12.0F);
  EXPECT_EQ(scan->borders[0].evidence->step_m, 0.02F);
  ASSERT_TRUE(scan->borders[0].evidence->colors);
  EXPECT_EQ(scan->borders[0].evidence->colors->difference, 8);
  EXPECT_EQ(scan->borders[0].evidence->colors->chroma_difference, 5);
  EXPECT_EQ(scan->borders[0].evidence->colors->shared, 0.75F);
  EXPECT_EQ(scan->borders[0].evidence->colors->shared_chroma, 12);
  EXPECT_EQ(scan->borders[0].evidence->colors->elsewhere, 0.25F);
  EXPECT_EQ(scan->borders[0].evidence->colors->variety, 4);
  EXPECT_EQ(scan->borders[0].evidence->constraint, LinkConstraint::cannot_link);
  EXPECT_TRUE(scan->borders[0].evidence->by_person);
  ASSERT_EQ(scan->estimates.size(), 3U);
  EXPECT_EQ(scan->estimates[0].position, Eigen::Vector3i(1, 0, -4));
  EXPECT_EQ(scan->estimates[0].words, someDelta(1).estimates[0].words);
  EXPECT_EQ(scan->estimates[1].position, Eigen::Vector3i(2, 0, -4));
  EXPECT_EQ(scan->estimates[2].position, Eigen::Vector3i(10, 0, -4));
  EXPECT_EQ(scan->estimates[2].words, last.estimates[1].words);
  ASSERT_EQ(scan->operations.size(), 2U);
  EXPECT_EQ(scan->operations[1].operation, last.operations[0].operation);
  EXPECT_EQ(scan->operations[1].effect, last.operations[0].effect);
  EXPECT_EQ(scan->operations[1].state, OperationLog::State::undone);
  ASSERT_EQ(scan->pages.size(), 2U);
  for (const Eigen::Vector3i& page : scan->pages) {
    const auto words = (*store)->loadPage(page);
    ASSERT_TRUE(words);
    EXPECT_EQ(*words, somePage(page.x()).words);
  }
  EXPECT_TRUE((*store)->damages().empty());
}

TEST(SessionStore, OpensACopyOfTheFolder) {
  const TemporaryFolder folder;
  { ASSERT_TRUE(saveSome(*created(folder.path() / "scan"), 1)); }
  std::filesystem::copy(folder.path() / "scan", folder.path() / "copy",
                        std::filesystem::copy_options::recursive);
  std::filesystem::remove_all(folder.path() / "scan");
  const auto store = SessionStore::open(folder.path() / "copy");
  ASSERT_TRUE(store);
  EXPECT_TRUE((*store)->loadPage({1, -2, 5}));
}

TEST(SessionStore, RefusesASecondProgram) {
  const TemporaryFolder folder;
  const auto store = created(folder.path() / "scan");
  const auto second = SessionStore::open(folder.path() / "scan");
  ASSERT_FALSE(second);
  EXPECT_THAT(second.error().message(), HasSubstr("in use"));
}

TEST(SessionStore, LoadsOtherPages_WhenOneIsDamaged) {
  const TemporaryFolder folder;
  {
    const auto store = created(folder.path() / "scan");
    ASSERT_TRUE(saveSome(*store, 1));
    ASSERT_TRUE(saveSome(*store, 2));
  }
  {
    std::fstream file(folder.path() / "scan" / "map" / "000001.bricks",
                      std::ios::in | std::ios::out | std::ios::binary);
    file.seekp(20);
    file.put('\x55');
  }
  const auto store = SessionStore::open(folder.path() / "scan");
  ASSERT_TRUE(store);
  const auto damaged = (*store)->loadPage({1, -2, 5});
  ASSERT_FALSE(damaged);
  EXPECT_THAT(damaged.error().message(), HasSubstr("000001.bricks"));
  EXPECT_TRUE((*store)->loadPage({2, -2, 5}));
}

TEST(SessionStore, LoadsRemainingPages_WhenTheMapIsTruncated) {
  const TemporaryFolder folder;
  {
    const auto store = created(folder.path() / "scan");
    ASSERT_TRUE(saveSome(*store, 1));
    ASSERT_TRUE(saveSome(*store, 2));
  }
  const std::filesystem::path file = folder.path() / "scan" / "map" / "000001.bricks";
  std::filesystem::resize_file(file, std::filesystem::file_size(file) - 3);
  const auto store = SessionStore::open(folder.path() / "scan");
  ASSERT_TRUE(store);
  EXPECT_TRUE((*store)->loadPage({1, -2, 5}));
  EXPECT_FALSE((*store)->loadPage({2, -2, 5}));
}

TEST(SessionStore, SkipsAndNamesRows_WhenTheyAreInvalid) {
  const TemporaryFolder folder;
  { ASSERT_TRUE(saveSome(*created(folder.path() / "scan"), 1)); }
  {
    auto connection = DatabaseConnection::open((folder.path() / "scan" / "session.sqlite").string());
    ASSERT_TRUE((*connection)->execute("UPDATE operations SET effect = '{'"));
    ASSERT_TRUE((*connection)->execute("UPDATE borders SET evidence = x'00'"));
  }
  const auto store = SessionStore::open(folder.path() / "scan");
  const auto scan = (*store)->load();
  ASSERT_TRUE(scan);
  EXPECT_TRUE(scan->operations.empty());
  EXPECT_TRUE(scan->borders.empty());
  EXPECT_EQ(scan->frames.size(), 1U);
  EXPECT_EQ((*store)->damages().size(), 2U);
}

TEST(SessionStore, OpenFails_WhenNewerOrNoSession) {
  const TemporaryFolder folder;
  { created(folder.path() / "scan"); }
  {
    auto connection = DatabaseConnection::open((folder.path() / "scan" / "session.sqlite").string());
    ASSERT_TRUE((*connection)->execute("PRAGMA user_version = 99"));
  }
  const auto newer = SessionStore::open(folder.path() / "scan");
  ASSERT_FALSE(newer);
  EXPECT_THAT(newer.error().message(), HasSubstr("newer"));
  const auto none = SessionStore::open(folder.path());
  ASSERT_FALSE(none);
  EXPECT_THAT(none.error().message(), HasSubstr(folder.path().string()));
}

/// The border of saveSome() as an earlier version stored it: only the first `numbers` numbers of its
/// evidence.
BorderEvidence evidenceOfNumbers(int numbers) {
  const TemporaryFolder folder;
  EXPECT_TRUE(saveSome(*created(folder.path() / "scan"), 1));
  {
    const auto connection = DatabaseConnection::open((folder.path() / "scan" / "session.sqlite").string());
    EXPECT_TRUE((*connection)
                    ->execute("UPDATE borders SET evidence = substr(evidence, 1, ?), row_check = NULL",
                              {4 * numbers}));
  }
  const auto scan = (*SessionStore::open(folder.path() / "scan"))->load();
  if (!scan || scan->borders.size() != 1) {
    ADD_FAILURE() << numbers;
    return {};
  }
  return *scan->borders[0].evidence;
}

TEST(SessionStore, EvidenceHasNoColors_WhenAnEarlierVersionStoredIt) {
  const BorderEvidence evidence = evidenceOfNumbers(14);
  EXPECT_EQ(evidence.observations, 3.25F);
  EXPECT_EQ(evidence.unattached, 1.5F);
  EXPECT_EQ(evidence.step_m, 0);
  EXPECT_FALSE(evidence.colors);
}

TEST(SessionStore, ColorsHaveDefaults_WhenAnEarlierVersionStoredThem) {
  const BorderEvidence evidence = evidenceOfNumbers(17);
  ASSERT_TRUE(evidence.colors);
  EXPECT_EQ(evidence.colors->difference, 8);
  EXPECT_EQ(evidence.colors->chroma_difference, 5);
  EXPECT_EQ(evidence.colors->shared, ColorComparison{}.shared);
  EXPECT_EQ(evidence.colors->shared_chroma, ColorComparison{}.shared_chroma);
  EXPECT_EQ(evidence.colors->elsewhere, ColorComparison{}.elsewhere);
  EXPECT_EQ(evidence.colors->variety, ColorComparison{}.variety);
}

TEST(SessionStore, EvidenceHasNoOutlines_WhenAnEarlierVersionStoredIt) {
  const BorderEvidence evidence = evidenceOfNumbers(21);
  EXPECT_EQ(evidence.observations, 3.25F);
  EXPECT_EQ(evidence.unattached, 1.5F);
  ASSERT_TRUE(evidence.colors);
  EXPECT_EQ(evidence.colors->variety, 4);
  EXPECT_EQ(evidence.outlined, 0);
  EXPECT_EQ(evidence.unoutlined, 0);
}

TEST(SessionStore, OpensTheFirstVersion_WithoutViewCoverage) {
  const TemporaryFolder folder;
  ASSERT_TRUE(saveSome(*created(folder.path() / "scan"), 1));
  {
    const auto connection = DatabaseConnection::open((folder.path() / "scan" / "session.sqlite").string());
    ASSERT_TRUE(connection);
    for (const char* column : {"seen_from", "seen_pixels", "support_pixels", "carried_pixels"})
      ASSERT_TRUE((*connection)->execute(QString("ALTER TABLE fragments DROP COLUMN %1").arg(column)));
    for (const char* column : {"fx", "fy", "cx", "cy", "width", "height"})
      ASSERT_TRUE((*connection)->execute(QString("ALTER TABLE frames DROP COLUMN %1").arg(column)));
    for (const char* column : {"color_checksum", "depth_checksum"})
      ASSERT_TRUE((*connection)->execute(QString("ALTER TABLE key_frames DROP COLUMN %1").arg(column)));
    for (const char* table :
         {"facts", "frames", "key_frames", "fragments", "regions", "borders", "operations", "pages"})
      ASSERT_TRUE((*connection)->execute(QString("ALTER TABLE %1 DROP COLUMN row_check").arg(table)));
    for (const char* table : {"camera", "recordings", "table_sums", "fact_copies", "files", "estimates",
                              "objectness", "mask_corrections", "frame_reviews"})
      ASSERT_TRUE((*connection)->execute(QString("DROP TABLE %1").arg(table)));
    ASSERT_TRUE((*connection)->execute("DELETE FROM schema_migrations WHERE version > 1"));
    ASSERT_TRUE((*connection)->execute("PRAGMA user_version = 1"));
  }
  const auto store = SessionStore::open(folder.path() / "scan");
  ASSERT_TRUE(store) << store.error().message();
  const Result<SavedScan> scan = (*store)->load();
  ASSERT_TRUE(scan) << scan.error().message();
  ASSERT_EQ(scan->fragments.size(), 1U);
  EXPECT_EQ(scan->fragments[0].voxels, 101);
  EXPECT_EQ(scan->fragments[0].seen_from, ViewCoverage());
  EXPECT_EQ(scan->fragments[0].support_pixels, SupportPixels());
  ASSERT_EQ(scan->frames.size(), 1U);
  EXPECT_FALSE(scan->frames[0].intrinsics);
  EXPECT_FALSE((*store)->loadCamera()->has_value());
  EXPECT_TRUE(scan->metadata.contains("begun")) << "identifies its catalogue";
  EXPECT_FALSE(scan->metadata.contains("catalogue"));
  ASSERT_TRUE(saveSome(**store, 2));
}

TEST(SessionStore, LoadsTheLatestCamera) {
  const TemporaryFolder folder;
  std::vector<std::uint32_t> words(5000);
  for (std::uint32_t i = 0; i < words.size(); ++i) words[i] = i * i;
  {
    const auto store = created(folder.path() / "scan");
    EXPECT_FALSE(store->loadCamera()->has_value());
    SavedDelta delta;
    delta.camera = {3, {1, 2, 3}};
    ASSERT_TRUE(store->save(delta));
    delta.camera = {8, words};
    ASSERT_TRUE(store->save(delta));
    ASSERT_TRUE(saveSome(*store, 2)) << "a save without camera";
  }
  const auto store = SessionStore::open(folder.path() / "scan");
  ASSERT_TRUE(store) << store.error().message();
  const auto camera = (*store)->loadCamera();
  ASSERT_TRUE(camera && camera->has_value());
  EXPECT_EQ((*camera)->frame, 8);
  EXPECT_EQ((*camera)->words, words);
}

TEST(SessionStore, RemovesOutdatedPages_WhenTheyAreMany) {
  const TemporaryFolder folder;
  const auto store = created(folder.path() / "scan");
  // Words that do not compress: 4 MB a page.
  std::vector<SavedPage> pages{{{0, 0, 0}, std::vector<std::uint32_t>(1 << 20)}};
  std::uint32_t state = 1;
  for (int save = 0; save < 14; ++save) {
    for (std::uint32_t& word : pages[0].words) word = state = state * 1664525U + 1013904223U;
    ASSERT_TRUE(store->writePages(pages));
    ASSERT_TRUE(store->save({}));
  }
  std::uintmax_t bytes = 0;
  for (const auto& file : std::filesystem::directory_iterator(folder.path() / "scan" / "map"))
    bytes += file.file_size();
  EXPECT_LT(bytes, 44U << 20U) << "of 56 MB written";
  EXPECT_EQ(*store->loadPage({0, 0, 0}), pages[0].words);
}

TEST(SessionStore, PagesAppear_WithTheirSave) {
  const TemporaryFolder folder;
  {
    const auto store = created(folder.path() / "scan");
    ASSERT_TRUE(saveSome(*store, 1));
    SavedPage anew = somePage(1);
    anew.words[0] = 4;
    ASSERT_TRUE(store->writePages(std::vector{anew, somePage(2)}));
    SavedKeyFrame images;
    images.frame = 7;
    images.color_file = "c.jpg";
    images.depth_file = "d.png";
    ASSERT_TRUE(store->saveKeyFrame({.number = 7}, images));
    EXPECT_EQ(store->load()->pages.size(), 1U) << "images alone do not save the scan";
    EXPECT_EQ(*store->loadPage({1, -2, 5}), somePage(1).words);
  }  // the program ends before the save
  auto store = SessionStore::open(folder.path() / "scan");
  ASSERT_TRUE(store);
  EXPECT_EQ((*store)->load()->pages.size(), 1U);
  EXPECT_EQ(*(*store)->loadPage({1, -2, 5}), somePage(1).words);
  ASSERT_TRUE((*store)->writePages(std::vector{somePage(2)}));
  ASSERT_TRUE((*store)->save({}));
  EXPECT_EQ((*store)->load()->pages.size(), 2U);
  EXPECT_EQ(*(*store)->loadPage({2, -2, 5}), somePage(2).words);
}

}  // namespace
}  // namespace scantrove::test
