#include "core/session/scans_of_object.h"

#include <gmock/gmock.h>

#include <algorithm>
#include <fstream>

#include "core/session/catalogue_numbers.h"
#include "core/session/session_store.h"
#include "tests/support/temporary_folder.h"

namespace scantrove::test {
namespace {

using testing::ElementsAre;
using testing::IsEmpty;

constexpr ObjectId kWanted{2}, kMergedIntoIt{5};

void storeScan(const std::filesystem::path& folder, const std::string& catalogue,
               const std::vector<ObjectId>& objects) {
  SavedDelta delta;
  delta.metadata["source"] = "demo";
  delta.metadata[kCatalogueKey] = catalogue;
  for (int number = 0; number < 2; ++number) {
    SavedFrame frame;
    frame.number = number;
    frame.state = TrackingState::tracking;
    delta.frames.push_back(frame);
    SavedKeyFrame key;
    key.frame = number;
    delta.key_frames.push_back(key);
  }
  for (const ObjectId object : objects) {
    const auto number = static_cast<std::uint32_t>(delta.regions.size()) + 1;
    delta.fragments.push_back({FragmentId{number}, RegionId{number}, 100});
    delta.regions.push_back({RegionId{number}, object, {}});
  }
  // A region that was joined with another one has no fragments any more.
  delta.regions.push_back({RegionId{90}, ObjectId{33}, {}});
  auto store = SessionStore::create(folder);
  ASSERT_TRUE(store) << store.error().message();
  ASSERT_TRUE((*store)->save(delta));
}

std::vector<std::string> namesOf(const std::vector<ScanOfObject>& scans) {
  std::vector<std::string> names;
  for (const ScanOfObject& scan : scans) names.push_back(scan.folder.filename().string());
  std::ranges::sort(names);
  return names;
}

TEST(ScansOfObject, AreThoseWithARegionOfIt) {
  const TemporaryFolder folder;
  storeScan(folder / "one", "A", {kWanted, ObjectId{7}});
  storeScan(folder / "two", "A", {kMergedIntoIt, kWanted});
  storeScan(folder / "none", "A", {ObjectId{7}});
  const auto scans = scansOfObject(folder / ".", "A", {kWanted, kMergedIntoIt});
  EXPECT_THAT(namesOf(scans), ElementsAre("one", "two"));
  for (const ScanOfObject& scan : scans) {
    EXPECT_EQ(scan.key_frames, 2);
    EXPECT_EQ(scan.source, "demo");
    EXPECT_EQ(scan.regions, scan.folder.filename() == "two" ? 2 : 1);
    EXPECT_FALSE(scan.started.empty());
  }
  EXPECT_THAT(scansOfObject(folder / ".", "A", {ObjectId{33}}), IsEmpty()) << "its region is gone";
}

TEST(ScansOfObject, LeavesOutOtherCataloguesAndDamagedScans) {
  const TemporaryFolder folder;
  storeScan(folder / "other", "B", {kWanted});
  std::filesystem::create_directories(folder / "damaged");
  std::ofstream(folder / "damaged" / "session.sqlite") << "no database";
  EXPECT_THAT(scansOfObject(folder / ".", "A", {kWanted}), IsEmpty());
  EXPECT_THAT(scansOfObject(folder / "missing", "A", {kWanted}), IsEmpty());
  EXPECT_THAT(scansOfObject(folder / ".", "", {kWanted}), IsEmpty());
}

}  // namespace
}  // namespace scantrove::test
