#include "core/project/recording_claim.h"

#include <gmock/gmock.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <atomic>
#include <chrono>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <memory>
#include <string>
#include <thread>
#include <utility>
#include <vector>

#include "tests/support/temporary_folder.h"

namespace scantrove::test {
namespace {

namespace fs = std::filesystem;
using namespace std::chrono_literals;

ClaimOwner ofAnotherMachine() {
  ClaimOwner owner = thisClaimOwner();
  owner.host = "lab7";
  owner.machine = "another boot";
  return owner;
}

/// A process of this machine that has ended.
ClaimOwner ofAnEndedProcess() {
  ClaimOwner owner = thisClaimOwner();
  const pid_t process = fork();
  if (process == 0) _exit(0);
  waitpid(process, nullptr, 0);
  owner.process = process;
  return owner;
}

/// A claim file as a program leaves it that was killed.
fs::path leaveClaim(const fs::path& folder, const std::string& source, const ClaimOwner& owner,
                    std::chrono::minutes age) {
  fs::path path = RecordingClaim::fileOf(folder, source);
  std::ofstream(path) << toClaimText(owner, source);
  fs::last_write_time(path, fs::file_time_type::clock::now() - age);
  return path;
}

std::unique_ptr<RecordingClaim> claimOn(const fs::path& folder, const std::string& source) {
  auto attempt = RecordingClaim::take(folder, source);
  EXPECT_TRUE(attempt) << attempt.error().message();
  return attempt ? std::move(attempt->claim) : nullptr;
}

std::ptrdiff_t filesIn(const fs::path& folder) {
  return std::distance(fs::directory_iterator(folder), fs::directory_iterator());
}

TEST(RecordingClaim, IsHeldByOne_UntilItEnds) {
  const TemporaryFolder folder;
  auto first = claimOn(folder.path(), "/data/kitchen");
  ASSERT_NE(first, nullptr);
  EXPECT_TRUE(first->isHeld());
  const auto second = RecordingClaim::take(folder.path(), "/data/kitchen");
  ASSERT_TRUE(second) << second.error().message();
  EXPECT_EQ(second->claim, nullptr);
  EXPECT_EQ(second->owner.process, getpid());
  EXPECT_NE(claimOn(folder.path(), "/data/office"), nullptr);
  first.reset();
  EXPECT_NE(claimOn(folder.path(), "/data/kitchen"), nullptr);
  EXPECT_EQ(filesIn(folder.path()), 0);
}

TEST(RecordingClaim, IsTakenOver_WhenItsProcessEnded) {
  const TemporaryFolder folder;
  leaveClaim(folder.path(), "a", ofAnEndedProcess(), 0min);
  const auto claim = claimOn(folder.path(), "a");
  ASSERT_NE(claim, nullptr);
  EXPECT_TRUE(claim->isHeld());
  EXPECT_EQ(filesIn(folder.path()), 1);
}

TEST(RecordingClaim, IsTakenOver_WhenItsProcessNumberIsAnothersNow) {
  const TemporaryFolder folder;
  ClaimOwner earlier = thisClaimOwner();
  earlier.process_start = "1";
  leaveClaim(folder.path(), "a", earlier, 0min);
  EXPECT_NE(claimOn(folder.path(), "a"), nullptr);
}

TEST(RecordingClaim, OfAnotherMachineIsTakenOver_OnceItIsTenMinutesOld) {
  const TemporaryFolder folder;
  const fs::path path = leaveClaim(folder.path(), "a", ofAnotherMachine(), 9min);
  const auto early = RecordingClaim::take(folder.path(), "a");
  ASSERT_TRUE(early) << early.error().message();
  EXPECT_EQ(early->claim, nullptr);
  EXPECT_EQ(early->owner.host, "lab7");
  EXPECT_EQ(filesIn(folder.path()), 1);
  fs::last_write_time(path, fs::file_time_type::clock::now() - 11min);
  EXPECT_NE(claimOn(folder.path(), "a"), nullptr);
}

TEST(RecordingClaim, IsNotStale_WhenRenewed) {
  const TemporaryFolder folder;
  auto attempt = RecordingClaim::take(folder.path(), "a", ofAnotherMachine());
  ASSERT_TRUE(attempt && attempt->claim != nullptr);
  const fs::path path = RecordingClaim::fileOf(folder.path(), "a");
  fs::last_write_time(path, fs::file_time_type::clock::now() - 11min);
  attempt->claim->renew();
  EXPECT_EQ(claimOn(folder.path(), "a"), nullptr);
}

TEST(RecordingClaim, LeavesTheFileOfAProgramThatTookItOver) {
  const TemporaryFolder folder;
  auto slow = RecordingClaim::take(folder.path(), "a", ofAnotherMachine());
  ASSERT_TRUE(slow && slow->claim != nullptr);
  const fs::path path = RecordingClaim::fileOf(folder.path(), "a");
  fs::last_write_time(path, fs::file_time_type::clock::now() - 11min);
  const auto taken = claimOn(folder.path(), "a");
  ASSERT_NE(taken, nullptr);
  EXPECT_FALSE(slow->claim->isHeld());
  slow->claim.reset();
  EXPECT_TRUE(taken->isHeld());
}

TEST(RecordingClaim, WithoutReadableOwner_IsStaleByItsAgeOnly) {
  const TemporaryFolder folder;
  const fs::path path = RecordingClaim::fileOf(folder.path(), "a");
  std::ofstream(path) << "half a cla";
  EXPECT_EQ(claimOn(folder.path(), "a"), nullptr);
  fs::last_write_time(path, fs::file_time_type::clock::now() - 11min);
  EXPECT_NE(claimOn(folder.path(), "a"), nullptr);
}

TEST(RecordingClaim, GoesToOneOfMany_NewOrStale) {
  for (const bool is_stale : {false, true}) {
    const TemporaryFolder folder;
    if (is_stale) leaveClaim(folder.path(), "a", ofAnotherMachine(), 11min);
    std::atomic<int> waiting{0};
    std::vector<std::unique_ptr<RecordingClaim>> claims(8);
    {
      std::vector<std::jthread> threads;
      for (std::unique_ptr<RecordingClaim>& claim : claims) {
        threads.emplace_back([&] {
          ++waiting;
          while (waiting < 8) std::this_thread::yield();
          claim = claimOn(folder.path(), "a");
        });
      }
    }
    EXPECT_EQ(std::ranges::count_if(claims, [](const auto& claim) { return claim != nullptr; }), 1)
        << is_stale;
  }
}

TEST(RecordingClaim, ErrorNamesTheFile_WhenTheFolderIsMissing) {
  const TemporaryFolder folder;
  const auto attempt = RecordingClaim::take(folder / "none", "a");
  ASSERT_FALSE(attempt);
  EXPECT_THAT(attempt.error().message(), testing::HasSubstr((folder / "none").string()));
}

}  // namespace
}  // namespace scantrove::test
