#include "core/project/recording_list.h"

#include <gmock/gmock.h>

#include <string>
#include <vector>

#include "tests/support/temporary_folder.h"

namespace scantrove::test {
namespace {

bool isNoDemo(const std::string& source) { return !source.starts_with("demo"); }

TEST(RecordingList, HasOneSourceALine_PathsFromItsFolder) {
  const TemporaryFolder folder;
  const auto file = folder.write("lists/day.txt",
                                 "# Monday\n"
                                 "\n"
                                 "kitchen\r\n"
                                 "  ../my office  \n"
                                 "/data/hall#2\n"
                                 "demo:room:3\n");
  const auto sources = readRecordingList(file, isNoDemo);
  ASSERT_TRUE(sources) << sources.error().message();
  EXPECT_EQ(*sources, (std::vector<std::string>{folder / "lists/kitchen", folder / "my office",
                                                "/data/hall#2", "demo:room:3"}));
}

TEST(RecordingList, IsRefused_WhenItNamesNothing) {
  const TemporaryFolder folder;
  const auto empty = readRecordingList(folder.write("list", "# nothing\n\n"), isNoDemo);
  ASSERT_FALSE(empty);
  EXPECT_THAT(empty.error().message(), testing::HasSubstr("names no recording"));
  const auto missing = readRecordingList(folder / "none", isNoDemo);
  ASSERT_FALSE(missing);
  EXPECT_THAT(missing.error().message(), testing::HasSubstr("none"));
}

TEST(RecordingList, NamesEachSourceOnce_InItsOrder) {
  EXPECT_EQ(withoutRepetitions({"b", "a", "b", "c", "a"}), (std::vector<std::string>{"b", "a", "c"}));
}

}  // namespace
}  // namespace scantrove::test
