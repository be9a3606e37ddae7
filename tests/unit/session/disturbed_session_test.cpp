// Other programs remove, move or replace files of an open session.
#include <gmock/gmock.h>

#include <filesystem>
#include <functional>

#include "core/session/session_writer.h"
#include "tests/support/temporary_folder.h"

namespace scantrove::test {
namespace {

namespace fs = std::filesystem;
using testing::AllOf;
using testing::HasSubstr;

class DisturbedSessionTest : public testing::Test {
 protected:
  void SetUp() override {
    auto writer = SessionWriter::start(path_, SessionWriter::Way::create);
    ASSERT_TRUE(writer) << writer.error().message();
    writer_ = std::move(*writer);
    ASSERT_TRUE(save(1));
  }

  Result<void> save(int number) {
    writer_->post([number](SessionStore& store) -> Result<void> {
      SCANTROVE_TRY(store.writePages(
          std::vector{SavedPage{{number, 0, 0}, {1, 2, static_cast<std::uint32_t>(number)}}}));
      SavedDelta delta;
      SavedFrame frame;
      frame.number = number;
      frame.state = TrackingState::tracking;
      delta.frames = {frame};
      return store.save(delta);
    });
    return writer_->flush();
  }

  /// The session in `folder` has both frames and their pages.
  static void expectBothFrames(const fs::path& folder) {
    const auto store = SessionStore::open(folder);
    ASSERT_TRUE(store) << store.error().message();
    const auto scan = (*store)->load();
    ASSERT_TRUE(scan) << scan.error().message();
    EXPECT_TRUE((*store)->damages().empty()) << (*store)->damages().front();
    EXPECT_EQ(scan->frames.size(), 2U);
    for (const int number : {1, 2}) {
      const auto page = (*store)->loadPage({number, 0, 0});
      ASSERT_TRUE(page) << page.error().message();
      EXPECT_EQ((*page)[2], static_cast<std::uint32_t>(number));
    }
  }

  /// The writer reports a failure with these words once, and stores it.
  void expectFailure(const std::vector<std::string>& words) {
    const auto failure = writer_->takeFailure();
    ASSERT_TRUE(failure);
    for (const std::string& word : words) EXPECT_THAT(failure->message(), HasSubstr(word));
    EXPECT_FALSE(writer_->takeFailure());
    ASSERT_TRUE(writer_->disturbance());
    EXPECT_EQ(writer_->disturbance()->message(), failure->message());
  }

  TemporaryFolder folder_;
  const fs::path path_ = folder_ / "scan";
  std::unique_ptr<SessionWriter> writer_;
};

TEST_F(DisturbedSessionTest, ReportsNoFailure_WhenUndisturbed) {
  ASSERT_TRUE(save(2));
  EXPECT_FALSE(writer_->takeFailure());
  EXPECT_FALSE(writer_->disturbance());
  writer_.reset();
  expectBothFrames(path_);
}

TEST_F(DisturbedSessionTest, WritesTheSessionAgain_WhenFilesAreRemoved) {
  const std::vector<std::vector<std::string>> cases{
      {"session.sqlite"},
      {"session.sqlite-wal"},
      {"session.sqlite-shm"},
      {"session.sqlite", "session.sqlite-wal", "session.sqlite-shm"},
      {"map/000001.bricks"},
      {"map"},
      {"session.lock", "session.sqlite"},
      {""}};
  for (const auto& names : cases) {
    SCOPED_TRACE(names.front());
    writer_.reset();
    fs::remove_all(path_);
    SetUp();
    for (const std::string& name : names) ASSERT_GT(fs::remove_all(name.empty() ? path_ : path_ / name), 0U);
    const Result<void> saved = save(2);
    EXPECT_TRUE(saved) << saved.error().message();
    expectFailure({path_.string(), "removed", "written anew"});
    EXPECT_FALSE(SessionStore::open(path_)) << "it is still locked";
    writer_.reset();
    expectBothFrames(path_);
  }
}

TEST_F(DisturbedSessionTest, KeepsAForeignFile_WhenItReplacedTheDatabase) {
  fs::remove(path_ / "session.sqlite");
  folder_.write("scan/session.sqlite", "mine");
  const Result<void> saved = save(2);
  ASSERT_TRUE(saved) << saved.error().message();
  const fs::path rescued = path_ / "session.rescued.sqlite";
  expectFailure({"replaced", rescued.string()});
  writer_.reset();
  EXPECT_EQ(readText(path_ / "session.sqlite"), "mine");
  fs::rename(rescued, path_ / "session.sqlite");
  expectBothFrames(path_);
}

TEST_F(DisturbedSessionTest, KeepsAForeignFile_WhenItReplacedTheMap) {
  fs::remove(path_ / "map" / "000001.bricks");
  folder_.write("scan/map/000001.bricks", "mine");
  ASSERT_TRUE(save(2));
  expectFailure({"replaced", "written anew"});
  writer_.reset();
  expectBothFrames(path_);
  EXPECT_EQ(readText(path_ / "map" / "000001.bricks"), "mine");
}

TEST_F(DisturbedSessionTest, FollowsItsFolder_WhenMoved) {
  fs::rename(path_, folder_ / "elsewhere");
  ASSERT_TRUE(save(2));
  expectFailure({path_.string(), (folder_ / "elsewhere").string(), "moved"});
  EXPECT_EQ(writer_->folder(), folder_ / "elsewhere");
  writer_.reset();
  EXPECT_FALSE(fs::exists(path_));
  expectBothFrames(folder_ / "elsewhere");
}

TEST_F(DisturbedSessionTest, CountsLostImages) {
  writer_->post([this](SessionStore& store) -> Result<void> {
    SavedKeyFrame key;
    key.frame = 1;
    SCANTROVE_TRY(moveInto(key.depth_file, store.claimImage("000001", ".depth.png")));
    folder_.write("scan/" + key.depth_file.string(), "image");
    SavedFrame frame;
    frame.number = 1;
    frame.state = TrackingState::tracking;
    return store.saveKeyFrame(frame, key);
  });
  std::optional<Error> lost;
  const auto findLost = [&] {
    writer_->post([&](SessionStore& store) { return moveInto(lost, store.findLostImages()); });
    return writer_->flush();
  };
  ASSERT_TRUE(findLost());
  EXPECT_FALSE(lost);
  fs::remove_all(path_ / "keyframes");
  ASSERT_TRUE(findLost());
  ASSERT_TRUE(lost);
  EXPECT_THAT(lost->message(), AllOf(HasSubstr("1 images"), HasSubstr("removed")));
}

TEST_F(DisturbedSessionTest, RetriesLater_WhenNothingCanBeWritten) {
  fs::remove(path_ / "session.sqlite");
  fs::remove_all(path_ / "map");
  folder_.write("scan/map", "a file where the folder was");
  const Result<void> failed = save(2);
  ASSERT_FALSE(failed);
  EXPECT_THAT(failed.error().message(), HasSubstr("removed"));
  fs::remove(path_ / "map");
  ASSERT_TRUE(writer_->flush());
  writer_.reset();
  expectBothFrames(path_);
}

}  // namespace
}  // namespace scantrove::test
