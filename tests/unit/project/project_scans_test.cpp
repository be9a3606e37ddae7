#include "core/project/project_scans.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <string>
#include <vector>

#include "tests/support/temporary_folder.h"

namespace scantrove::test {
namespace {

using testing::HasSubstr;

TEST(ScansToExport, SayThatAProjectIsEmpty) {
  const TemporaryFolder folder;
  const auto project = createProject(folder / "rooms", "");
  ASSERT_TRUE(project) << project.error().message();
  const auto scans = scansToExport(*project, {}, "", [](const std::string&) {});
  ASSERT_FALSE(scans);
  EXPECT_THAT(scans.error().message(), testing::AllOf(HasSubstr("rooms"), HasSubstr("no scans")));
}

TEST(ScansToExport, LeaveOutDamagedScans_UnlessTheyAreNamed) {
  const TemporaryFolder folder;
  const auto project = createProject(folder / "rooms", "");
  ASSERT_TRUE(project) << project.error().message();
  folder.write("rooms/scans/broken/session.sqlite", "not a database");
  std::vector<std::string> warnings;
  const auto warn = [&](const std::string& sentence) { warnings.push_back(sentence); };
  const auto all = scansToExport(*project, {}, "", warn);
  ASSERT_FALSE(all) << "no other scan is there";
  EXPECT_THAT(warnings, testing::ElementsAre(HasSubstr("broken")));
  const auto named = scansToExport(*project, {"broken"}, "", warn);
  ASSERT_FALSE(named);
  EXPECT_THAT(named.error().what, HasSubstr("broken"));
  const auto unknown = scansToExport(*project, {"cellar"}, "", warn);
  ASSERT_FALSE(unknown);
  EXPECT_THAT(unknown.error().message(), testing::AllOf(HasSubstr("'cellar'"), HasSubstr("broken")));
}

}  // namespace
}  // namespace scantrove::test
