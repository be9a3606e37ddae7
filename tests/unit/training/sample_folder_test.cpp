#include "tools/train/sample_folder.h"

#include <gmock/gmock.h>

#include <mutex>
#include <thread>

#include "core/base/file_lock.h"
#include "tests/support/temporary_folder.h"
#include "tests/unit/training/made_samples.h"

namespace scantrove::train {
namespace {

using test::TemporaryFolder;
using testing::ElementsAre;
using testing::HasSubstr;

/// Counts scans in place of scanning.
struct FakeScans {
  std::vector<std::string> scanned;

  Result<Collected> collect(const std::filesystem::path& folder, const std::string& scene, int frames = 30) {
    return collectSamples(folder, {scene, frames, "abc123"},
                          [this](const std::string& name) -> Result<SceneSamples> {
                            scanned.push_back(name);
                            return test::madeSamples();
                          });
  }
};

std::vector<std::string> namesIn(const std::filesystem::path& folder) {
  std::vector<std::string> names;
  for (const auto& entry : std::filesystem::directory_iterator(folder))
    names.push_back(entry.path().filename().string());
  std::ranges::sort(names);
  return names;
}

TEST(SampleFolder, IsResumed_WithTheScenesThatAreMissing) {
  const TemporaryFolder folder;
  FakeScans first, second;
  EXPECT_EQ(first.collect(folder.path(), "room:1"), Collected::scanned);
  EXPECT_EQ(first.collect(folder.path(), "room:2:uneven:hard"), Collected::scanned);
  EXPECT_EQ(second.collect(folder.path(), "room:1"), Collected::present);
  EXPECT_EQ(second.collect(folder.path(), "room:2:uneven:hard"), Collected::present);
  EXPECT_EQ(second.collect(folder.path(), "hands:3"), Collected::scanned);
  EXPECT_THAT(second.scanned, ElementsAre("hands:3"));
  EXPECT_THAT(namesIn(folder.path()), ElementsAre("hands-3.txt", "room-1.txt", "room-2-uneven-hard.txt"));
}

TEST(SampleFolder, GivesAllScenesByTheNamesOfTheirFiles) {
  const TemporaryFolder folder;
  FakeScans scans;
  for (const char* scene : {"tabletop:1", "hands:3", "room:1"})
    ASSERT_TRUE(scans.collect(folder.path(), scene)) << scene;
  const auto all = readSampleFolder(folder.path());
  ASSERT_TRUE(all) << all.error().message();
  std::vector<SampleOrigin> origins;
  for (const SceneSamples& scene : *all) origins.push_back(scene.origin);
  EXPECT_THAT(origins,
              ElementsAre(SampleOrigin{"hands:3", 30, "abc123"}, SampleOrigin{"room:1", 30, "abc123"},
                          SampleOrigin{"tabletop:1", 30, "abc123"}));
  const std::vector<std::string> chosen{"tabletop:1", "room:1"};
  const auto two = readSampleFolder(folder.path(), chosen);
  ASSERT_TRUE(two) << two.error().message();
  ASSERT_EQ(two->size(), 2U);
  EXPECT_EQ(two->front().origin.scene, "room:1") << "the same order, however they are named";
}

TEST(SampleFolder, NamesADamagedFileAndLeavesIt) {
  const TemporaryFolder folder;
  FakeScans scans;
  ASSERT_TRUE(scans.collect(folder.path(), "room:1"));
  std::string text = test::readText(folder / "room-1.txt");
  text.resize(text.size() / 2);
  folder.write("room-1.txt", text);
  const auto collected = scans.collect(folder.path(), "room:1");
  ASSERT_FALSE(collected);
  EXPECT_THAT(collected.error().message(), HasSubstr((folder / "room-1.txt").string() + " is damaged"));
  EXPECT_THAT(scans.scanned, ElementsAre("room:1")) << "it is not scanned again unasked";
  EXPECT_EQ(test::readText(folder / "room-1.txt"), text);
  const auto all = readSampleFolder(folder.path());
  ASSERT_FALSE(all);
  EXPECT_THAT(all.error().message(), HasSubstr("room-1.txt is damaged"));
}

TEST(SampleFolder, NamesTheFile_WhenTheNumberOfFramesDiffers) {
  const TemporaryFolder folder;
  FakeScans scans;
  ASSERT_TRUE(scans.collect(folder.path(), "room:1", 30));
  const auto collected = scans.collect(folder.path(), "room:1", 200);
  ASSERT_FALSE(collected);
  EXPECT_THAT(collected.error().message(), HasSubstr("room-1.txt holds samples of 30 frames of room:1"));
  ASSERT_TRUE(scans.collect(folder.path(), "room:2", 200));
  const auto all = readSampleFolder(folder.path());
  ASSERT_FALSE(all);
  EXPECT_THAT(all.error().message(), HasSubstr("room-2.txt comes from 200 frames"));
}

TEST(SampleFolder, LeavesASceneToTheProcessThatScansIt) {
  const TemporaryFolder folder;
  FakeScans scans;
  {
    const auto other = FileLock::take(folder / "room-1.lock", {"taken", ""});
    ASSERT_TRUE(other);
    EXPECT_EQ(scans.collect(folder.path(), "room:1"), Collected::busy);
    EXPECT_THAT(scans.scanned, testing::IsEmpty());
  }
  EXPECT_EQ(scans.collect(folder.path(), "room:1"), Collected::scanned) << "the other ended without samples";
}

TEST(SampleFolder, HoldsEachSceneOnce_WhenSeveralFillIt) {
  const TemporaryFolder folder;
  std::mutex mutex;
  std::vector<std::string> scanned;
  const auto fill = [&] {
    for (int i = 0; i < 40; ++i) {
      const auto collected = collectSamples(folder.path(), {"room:" + std::to_string(i), 30, "abc123"},
                                            [&](const std::string& name) -> Result<SceneSamples> {
                                              const std::lock_guard lock(mutex);
                                              scanned.push_back(name);
                                              return test::madeSamples();
                                            });
      EXPECT_TRUE(collected) << collected.error().message();
    }
  };
  { std::jthread first(fill), second(fill), third(fill); }
  EXPECT_EQ(namesIn(folder.path()).size(), 40U) << "no other files remain";
  const auto all = readSampleFolder(folder.path());
  ASSERT_TRUE(all) << all.error().message();
  EXPECT_EQ(all->size(), 40U);
  EXPECT_EQ(scanned.size(), 40U);
}

TEST(SampleFolder, StaysAsItWas_WhenAScanFails) {
  const TemporaryFolder folder;
  const auto collected =
      collectSamples(folder.path(), {"cellar:1", 30, "abc123"},
                     [](const std::string&) -> Result<SceneSamples> { return fail("There is no cellar."); });
  ASSERT_FALSE(collected);
  EXPECT_EQ(collected.error().message(), "There is no cellar.");
  EXPECT_THAT(namesIn(folder.path()), testing::IsEmpty());
}

TEST(SampleFolder, NamesTheFolder_WhenItHoldsNoSamples) {
  const TemporaryFolder folder;
  const auto empty = readSampleFolder(folder.path());
  ASSERT_FALSE(empty);
  EXPECT_THAT(empty.error().message(), HasSubstr(folder.path().string()));
  const auto missing = readSampleFolder(folder / "nowhere");
  ASSERT_FALSE(missing);
  EXPECT_THAT(missing.error().message(), HasSubstr("nowhere"));
}

}  // namespace
}  // namespace scantrove::train
