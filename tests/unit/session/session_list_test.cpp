#include "core/session/session_list.h"

#include <gmock/gmock.h>
#include <sys/stat.h>
#include <unistd.h>

#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <iostream>

#include "core/session/session_store.h"
#include "tests/support/temporary_folder.h"

namespace scantrove::test {
namespace {

namespace fs = std::filesystem;
using testing::ElementsAre;
using testing::HasSubstr;
using testing::IsEmpty;

/// A short scan: three frames, two key frames, a large and a tiny region.
SavedDelta shortScan() {
  SavedDelta delta;
  delta.metadata["source"] = "demo";
  for (int number = 0; number < 3; ++number) {
    SavedFrame frame;
    frame.number = number;
    frame.state = number == 1 ? TrackingState::lost : TrackingState::tracking;
    delta.frames.push_back(frame);
  }
  for (const int number : {0, 2}) {
    SavedKeyFrame key;
    key.frame = number;
    key.color_file = "keyframes/00000" + std::to_string(number) + ".color.png";
    delta.key_frames.push_back(key);
  }
  delta.fragments = {
      {FragmentId{1}, RegionId{3}, 60}, {FragmentId{2}, RegionId{3}, 60}, {FragmentId{3}, RegionId{4}, 7}};
  delta.regions = {{RegionId{3}, ObjectId{2}, {"red cup", "cup", false, false, false}},
                   {RegionId{99}, ObjectId{5}, {"joined with another", "", false, false, false}}};
  return delta;
}

std::unique_ptr<SessionStore> storeIn(const fs::path& folder, const SavedDelta& delta) {
  auto store = SessionStore::create(folder);
  EXPECT_TRUE(store) << store.error().message();
  EXPECT_TRUE((*store)->save(delta));
  std::ofstream(folder / "keyframes" / "000002.color.png") << std::string(2000, 'x');
  return std::move(*store);
}

TEST(SessionList, UsesTheLatestCatalogueNames) {
  const TemporaryFolder folder;
  SavedDelta delta = shortScan();
  delta.regions.push_back({RegionId{4}, ObjectId{3}, {"old cup", "cup", false, false, false}});
  const auto namesWith = [&](const std::string& name, const std::string& objects) {
    delta.metadata["objects"] = objects;
    { static_cast<void>(storeIn(folder / name, delta)); }
    return listSessions(folder / name).at(0).names;
  };
  EXPECT_THAT(namesWith("one", R"({"3": {"name": "blue cup", "by_person": true, "deleted": false},
                                   "4": {"name": "", "by_person": false, "deleted": true}})"),
              ElementsAre("blue cup"));
  EXPECT_THAT(namesWith("two", "{"), ElementsAre("old cup", "red cup"));
  EXPECT_THAT(namesWith("three", R"({"3": 4, "4": {"deleted": "x", "by_person": true, "name": 7}})"),
              ElementsAre("old cup", "red cup"));
}

TEST(SessionList, DescribesASession) {
  const TemporaryFolder folder;
  SavedDelta delta = shortScan();
  delta.metadata["ended"] = "yes";
  { static_cast<void>(storeIn(folder / "one", delta)); }
  fs::create_directories(folder / "no session");
  const std::vector<SessionSummary> sessions = listSessions(folder.path());
  ASSERT_EQ(sessions.size(), 1U);
  const SessionSummary& one = sessions[0];
  EXPECT_EQ(one.damage, "");
  EXPECT_EQ(one.folder, folder / "one");
  EXPECT_EQ(one.name, "one");
  EXPECT_EQ(one.source, "demo");
  EXPECT_THAT(one.started, HasSubstr("T")) << "a time";
  EXPECT_EQ(one.frames, 3);
  EXPECT_EQ(one.tracked, 2);
  EXPECT_EQ(one.key_frames, 2);
  EXPECT_EQ(one.picture, folder / "one" / "keyframes" / "000002.color.png");
  EXPECT_EQ(one.regions, 1) << "without the tiny one";
  EXPECT_EQ(one.objects, 1) << "only of existing regions";
  EXPECT_THAT(one.names, ElementsAre("red cup"));
  EXPECT_TRUE(one.ended);
  EXPECT_FALSE(one.isRecovered());
  EXPECT_GT(one.megabytes, 0.002);
  EXPECT_EQ(listSessions(folder / "one").size(), 1U) << "the folder of one session";
}

TEST(SessionList, ListsASession_WhileItIsWritten) {
  const TemporaryFolder folder;
  const auto store = storeIn(folder / "one", shortScan());
  std::vector<SessionSummary> sessions = listSessions(folder.path());
  ASSERT_EQ(sessions.size(), 1U);
  EXPECT_EQ(sessions[0].damage, "");
  EXPECT_EQ(sessions[0].frames, 3) << "frames in the write-ahead log";
  SavedDelta more;
  more.frames.emplace_back().number = 3;
  EXPECT_TRUE(store->save(more));
  sessions = listSessions(folder.path());
  EXPECT_EQ(sessions.at(0).frames, 4);
  if (!fs::exists("/proc/locks")) {
    std::cerr << "NOT TESTED: whether a session is in use, for this system does not tell.\n";
    return;
  }
  EXPECT_TRUE(sessions[0].in_use);
  EXPECT_FALSE(sessions[0].isRecovered());
}

TEST(SessionList, MarksASessionRecovered_WhenInterrupted) {
  const TemporaryFolder folder;
  { static_cast<void>(storeIn(folder / "one", shortScan())); }
  const std::vector<SessionSummary> sessions = listSessions(folder.path());
  ASSERT_EQ(sessions.size(), 1U);
  EXPECT_FALSE(sessions[0].ended);
  EXPECT_FALSE(sessions[0].in_use);
  EXPECT_TRUE(sessions[0].isRecovered());
}

TEST(SessionList, NamesADamagedSessionAndListsTheOthers) {
  const TemporaryFolder folder;
  { static_cast<void>(storeIn(folder / "good", shortScan())); }
  folder.write("letter/session.sqlite",
               "This is a letter, and longer than the header of a database file.\n" + std::string(600, 'x'));
  folder.write("empty/session.sqlite", "");
  std::vector<std::string> damages;
  std::vector<std::string> names;
  for (const SessionSummary& session : listSessions(folder.path())) {
    if (!session.damage.empty()) damages.push_back(session.name + ": " + session.damage);
    if (session.damage.empty()) names.push_back(session.name);
    EXPECT_FALSE(session.isRecovered() && !session.damage.empty());
  }
  EXPECT_THAT(names, ElementsAre("good"));
  EXPECT_THAT(damages,
              testing::UnorderedElementsAre(testing::AllOf(HasSubstr("letter: "), HasSubstr("not a database"),
                                                           testing::Not(HasSubstr("catalogue"))),
                                            testing::AllOf(HasSubstr("empty: "), HasSubstr("is empty"))));
}

TEST(SessionList, ChangesNoFiles) {
  const TemporaryFolder folder;
  { static_cast<void>(storeIn(folder / "one", shortScan())); }
  const auto before = fs::last_write_time(folder / "one");
  ASSERT_EQ(listSessions(folder.path()).size(), 1U);
  EXPECT_EQ(fs::last_write_time(folder / "one"), before) << "no file was added or removed";
}

TEST(SessionList, IsEmpty_WithoutSessions) {
  const TemporaryFolder folder;
  EXPECT_THAT(listSessions(folder.path()), IsEmpty());
  EXPECT_THAT(listSessions(folder / "nowhere"), IsEmpty());
}

TEST(DefaultScansFolder, FollowsXdgDataHome) {
  const char* before = std::getenv("XDG_DATA_HOME");
  const std::string original = before == nullptr ? "" : before;
  ::setenv("XDG_DATA_HOME", "/data", 1);
  EXPECT_EQ(defaultScansFolder(), "/data/scantrove/scans");
  ::setenv("XDG_DATA_HOME", "not/absolute", 1);
  EXPECT_THAT(defaultScansFolder().string(), testing::EndsWith("/.local/share/scantrove/scans"));
  if (before == nullptr) {
    ::unsetenv("XDG_DATA_HOME");
  } else {
    ::setenv("XDG_DATA_HOME", original.c_str(), 1);
  }
}

/// Drops the rights of the superuser, who may write everywhere, for the lifetime of this object.
class PlainRights {
 public:
  PlainRights() { is_on_ = ::geteuid() != 0 || ::seteuid(kNobody) == 0; }
  ~PlainRights() {
    if (::getuid() == 0) is_off_ = ::seteuid(0) == 0;
  }
  PlainRights(const PlainRights&) = delete;
  PlainRights& operator=(const PlainRights&) = delete;
  [[nodiscard]] bool isOn() const { return is_on_; }

 private:
  static constexpr uid_t kNobody = 65534;
  bool is_on_ = false, is_off_ = false;
};

TEST(SessionStore, ReportsOneError_WhenTheFolderIsReadOnly) {
  const TemporaryFolder folder;
  { static_cast<void>(storeIn(folder / "scan", shortScan())); }
  fs::remove(folder / "scan" / "session.lock");  // as in a copy on a disc
  fs::permissions(folder.path(), fs::perms(0555));
  for (const auto& entry : fs::recursive_directory_iterator(folder.path()))
    fs::permissions(entry.path(), fs::perms(entry.is_directory() ? 0555 : 0444));
  {
    const PlainRights rights;
    if (!rights.isOn()) {
      std::cerr << "NOT TESTED: a session in a read-only folder, for the superuser may write everywhere.\n";
    } else {
      const auto opened = SessionStore::open(folder / "scan");
      EXPECT_FALSE(opened);
      if (!opened) {
        EXPECT_THAT(opened.error().what, testing::AllOf(HasSubstr((folder / "scan").string()),
                                                        HasSubstr("cannot be used: Permission denied")));
        EXPECT_THAT(opened.error().advice, HasSubstr("write permission"));
      }
      const auto created = SessionStore::create(folder / "another");
      EXPECT_FALSE(created);
      if (!created) {
        EXPECT_THAT(created.error().what,
                    testing::AllOf(HasSubstr((folder / "another").string()), HasSubstr("Permission denied")));
        EXPECT_FALSE(created.error().advice.empty());
      }
      const std::vector<SessionSummary> sessions = listSessions(folder.path());
      EXPECT_EQ(sessions.size(), 1U);
      if (!sessions.empty()) {
        EXPECT_EQ(sessions[0].damage, "") << "it can be read";
        EXPECT_EQ(sessions[0].frames, 3);
      }
    }
  }
  for (const auto& entry : fs::recursive_directory_iterator(folder.path()))
    fs::permissions(entry.path(), fs::perms(0755));
  fs::permissions(folder.path(), fs::perms(0755));
}

}  // namespace
}  // namespace scantrove::test
