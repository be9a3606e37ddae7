#include "core/project/task_share.h"

#include <gmock/gmock.h>

#include <map>
#include <optional>
#include <string>
#include <vector>

namespace scantrove::test {
namespace {

using Names = std::vector<std::string>;
using Variables = std::map<std::string, std::string>;

Result<TaskShare> parseShare(const std::string& text, const Variables& variables = {}) {
  return parseTaskShare(text, [&](const std::string& name) -> std::optional<std::string> {
    const auto found = variables.find(name);
    return found != variables.end() ? std::optional(found->second) : std::nullopt;
  });
}

TEST(TaskShare, TakesEveryNthSource) {
  const Names sources{"a", "b", "c", "d", "e"};
  EXPECT_EQ((TaskShare{1, 1}.of(sources)), sources);
  EXPECT_EQ((TaskShare{1, 2}.of(sources)), (Names{"a", "c", "e"}));
  EXPECT_EQ((TaskShare{2, 2}.of(sources)), (Names{"b", "d"}));
  EXPECT_EQ((TaskShare{7, 8}.of(sources)), Names());
}

TEST(TaskShare, OfAllTasks_HasEachSourceOnce) {
  Names sources;
  for (int i = 0; i < 23; ++i) sources.push_back(std::to_string(i));
  Names all;
  for (int task = 1; task <= 4; ++task) {
    const Names share = TaskShare{task, 4}.of(sources);
    all.insert(all.end(), share.begin(), share.end());
  }
  EXPECT_THAT(all, testing::UnorderedElementsAreArray(sources));
}

TEST(TaskShare, IsRead_AsIOfN) {
  const auto share = parseShare("2/8");
  ASSERT_TRUE(share) << share.error().message();
  EXPECT_EQ(share->index, 2);
  EXPECT_EQ(share->count, 8);
  for (const char* const text : {"", "2", "/8", "2/", "0/8", "9/8", "-1/8", "2/8/3", "two/8", "1/0"})
    EXPECT_FALSE(parseShare(text)) << text;
}

TEST(TaskShare, IsThePlaceInASlurmArray) {
  const auto from_one = parseShare(
      "slurm",
      {{"SLURM_ARRAY_TASK_ID", "3"}, {"SLURM_ARRAY_TASK_COUNT", "8"}, {"SLURM_ARRAY_TASK_MIN", "1"}});
  ASSERT_TRUE(from_one) << from_one.error().message();
  EXPECT_EQ(from_one->index, 3);
  EXPECT_EQ(from_one->count, 8);
  // --array=0-30:10 has the tasks 0, 10, 20 and 30.
  const auto stepped = parseShare("slurm", {{"SLURM_ARRAY_TASK_ID", "20"},
                                            {"SLURM_ARRAY_TASK_COUNT", "4"},
                                            {"SLURM_ARRAY_TASK_MIN", "0"},
                                            {"SLURM_ARRAY_TASK_STEP", "10"}});
  ASSERT_TRUE(stepped) << stepped.error().message();
  EXPECT_EQ(stepped->index, 3);
  EXPECT_EQ(stepped->count, 4);
}

TEST(TaskShare, IsRefused_WithoutSlurmOrWithGaps) {
  EXPECT_THAT(parseShare("slurm").error().message(), testing::HasSubstr("SLURM_ARRAY_TASK_ID"));
  // --array=1,5 has two tasks.
  const auto gaps = parseShare(
      "slurm",
      {{"SLURM_ARRAY_TASK_ID", "5"}, {"SLURM_ARRAY_TASK_COUNT", "2"}, {"SLURM_ARRAY_TASK_MIN", "1"}});
  ASSERT_FALSE(gaps);
  EXPECT_THAT(gaps.error().message(), testing::HasSubstr("gaps"));
}

}  // namespace
}  // namespace scantrove::test
