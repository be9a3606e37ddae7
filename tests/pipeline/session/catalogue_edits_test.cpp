#include <gmock/gmock.h>

#include <algorithm>
#include <array>

#include "core/catalogue/object_database.h"
#include "tests/pipeline/session/scan_worker_fixture.h"
#include "tests/support/other_program.h"

namespace scantrove {
namespace {

/// A user edits the catalogue during a scan.
class CatalogueEditsTest : public test::ScanWorkerTest {
 protected:
  static constexpr int kFrames = 120;

  [[nodiscard]] ScanRequest table(const std::string& database) const {
    ScanRequest requested = request(kFrames);
    requested.database = (folder_ / database).string();
    requested.output_folder = folder_ / ("of-" + database);  // refinement needs the stored key frames
    return requested;
  }

  /// Waits until the scan has added `count` objects. Result: their ids; empty when they do not come.
  std::vector<ObjectId> awaitObjects(std::size_t count) {
    for (int i = 0; i < 12000; ++i) {
      const std::vector<ObjectAdded> added = log_.all<ObjectAdded>();
      if (added.size() >= count) {
        std::vector<ObjectId> objects;
        for (const ObjectAdded& event : added) objects.push_back(event.object);
        return objects;
      }
      std::this_thread::sleep_for(std::chrono::milliseconds(10));
    }
    return {};
  }

  /// Lets the scan process more frames.
  void letFramesPass(int frames) {
    const auto now = awaitSnapshot(0);
    ASSERT_TRUE(now);
    ASSERT_TRUE(awaitSnapshot(now->frames.done() + frames));
  }

  static std::unique_ptr<ObjectDatabase> open(const ScanRequest& request) {
    auto database = ObjectDatabase::open(request.database);
    EXPECT_TRUE(database) << database.error().message();
    return std::move(*database);
  }
};

TEST_F(CatalogueEditsTest, ScanKeepsEditsMadeDuringIt) {
  // The reference: a scan without edits.
  const ScanRequest quiet = table("quiet.sqlite");
  worker_.post(StartScan{quiet});
  worker_.wait();
  ASSERT_EQ(worker_.state(), ScanState::finished);
  const std::size_t found = open(quiet)->objects()->size();
  ASSERT_GE(found, 5U) << "too few for the edits below";
  const std::size_t added_quietly = log_.all<ObjectAdded>().size();

  static_cast<void>(worker_.snapshots().collect());
  const ScanRequest busy = table("busy.sqlite");
  worker_.post(StartScan{busy});
  const std::vector<ObjectId> all = awaitObjects(added_quietly + 8);
  ASSERT_GE(all.size(), added_quietly + 8);
  // Both scans see the same. Objects that change later are left out: an edit would keep them. Their views
  // may change.
  std::vector<ObjectId> objects(all.begin() + static_cast<std::ptrdiff_t>(added_quietly), all.end());
  std::erase_if(objects, [&](ObjectId object) {
    return test::OtherProgram(quiet.database)
               .ask(QString(
                        "SELECT count(*) FROM events WHERE object = %1 AND action NOT IN ('add', 'add-view',"
                        " 'leave-behind')")
                        .arg(object.value)) != "0";
  });
  ASSERT_GE(objects.size(), 4U);
  const std::unique_ptr<ObjectDatabase> user = open(busy);
  ASSERT_TRUE(user->rename(objects[0], "my mug"));
  ASSERT_TRUE(user->setConfirmed(std::array{objects[1]}, true));
  ASSERT_TRUE(user->remove(std::array{objects[2], objects[3]}));
  worker_.post(ApplyCatalogueChanges{});
  letFramesPass(20);
  ASSERT_TRUE(user->restore(std::array{objects[3]}));
  const Result<ObjectMerge> merge = user->merge(std::array{objects[0], objects[1]});
  ASSERT_TRUE(merge);
  worker_.post(ApplyCatalogueChanges{});
  letFramesPass(5);
  ASSERT_EQ(worker_.state(), ScanState::scanning) << "the edits came too late to be during the scan";
  worker_.wait();
  ASSERT_EQ(worker_.state(), ScanState::finished);
  EXPECT_TRUE(log_.all<CatalogueFailed>().empty());

  const std::vector<ObjectRecord> remaining = *user->objects();
  EXPECT_EQ(remaining.size(), found - 2) << "one is deleted, two are merged, and none is added again";
  const auto record = [&](ObjectId object) {
    const auto at = std::ranges::find(remaining, object, &ObjectRecord::id);
    return at == remaining.end() ? ObjectRecord{} : *at;
  };
  EXPECT_EQ(merge->into, objects[0]);
  EXPECT_EQ(record(objects[0]).name, "my mug");
  EXPECT_TRUE(record(objects[0]).confirmed) << "one of the merged objects was confirmed";
  EXPECT_FALSE(record(objects[1]).id);
  EXPECT_FALSE(record(objects[2]).id);
  EXPECT_EQ(record(objects[3]).id, objects[3]);
  EXPECT_EQ(*user->mergeRoot(objects[1]), objects[0]);
}

TEST_F(CatalogueEditsTest, PausedScanShowsEdits) {
  ScanRequest requested = table("paused.sqlite");
  requested.skip_refinement = true;
  worker_.post(StartScan{requested});
  ASSERT_FALSE(awaitObjects(4).empty());
  worker_.post(PauseScan{});
  log_.awaitState(ScanState::paused);
  // Not every frame shows every object.
  auto paused = awaitSnapshot(1);
  while (paused && paused->state != ScanState::paused) paused = awaitSnapshot(1);
  ASSERT_TRUE(paused);
  const auto shown =
      std::ranges::find_if(paused->objects, [](const SeenObject& seen) { return !!seen.object; });
  ASSERT_NE(shown, paused->objects.end());
  const ObjectId object = shown->object;
  ASSERT_TRUE(open(requested)->rename(object, "named while paused"));
  worker_.post(ApplyCatalogueChanges{});
  bool is_shown = false;
  while (!is_shown) {
    const auto snapshot = awaitSnapshot(1);
    ASSERT_TRUE(snapshot) << "no snapshot has the name";
    is_shown = std::ranges::any_of(snapshot->objects, [&](const SeenObject& seen) {
      return seen.object == object && seen.name == "named while paused";
    });
    EXPECT_TRUE(!is_shown || snapshot->state == ScanState::paused);
  }
  worker_.post(StopScan{});
  worker_.wait();
}

}  // namespace
}  // namespace scantrove
