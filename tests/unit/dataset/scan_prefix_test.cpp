#include "core/dataset/scan_prefix.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <filesystem>
#include <set>

namespace scantrove::test {
namespace {

std::string prefixOf(const std::string& name) { return scanPrefixes({name}).front(); }

TEST(ScanPrefixes, AreTheNames_WhenTheseAreSafe) {
  EXPECT_THAT(scanPrefixes({"kitchen", "2026-11-22_15.40.02_büro"}),
              testing::ElementsAre("kitchen", "2026-11-22_15.40.02_büro"));
}

TEST(ScanPrefixes, StayInsideTheirFolder_ForAnyName) {
  const std::vector<std::string> hostile{
      "..",      ".",   "/etc/passwd", "a/../../b", "\"quoted\"", "a\nb\r",   "", std::string(300, 'x'),
      ".hidden", "-rf", "C:\\nul",     "\xFF\xFE",  "  ",         "a|b;c$(d)"};
  const std::vector<std::string> prefixes = scanPrefixes(hostile);
  ASSERT_EQ(prefixes.size(), hostile.size());
  for (const std::string& prefix : prefixes) {
    EXPECT_FALSE(prefix.empty());
    EXPECT_LE(prefix.size(), 60U) << prefix;
    EXPECT_EQ(prefix.find_first_of("/\\\"'\n\r|;$:*?<>"), std::string::npos) << prefix;
    EXPECT_NE(prefix.front(), '.') << prefix;
    EXPECT_NE(prefix.front(), '-') << prefix;
    EXPECT_EQ(std::filesystem::path(prefix).filename(), prefix);
  }
  EXPECT_EQ(std::set<std::string>(prefixes.begin(), prefixes.end()).size(), prefixes.size());
}

TEST(ScanPrefixes, DependOnTheirNameAlone) {
  const std::string before = prefixOf("my \"kitchen\"");
  const auto among_others = scanPrefixes({"office", "my 'kitchen'", "my \"kitchen\"", "my_kitchen"});
  EXPECT_EQ(among_others[2], before);
  EXPECT_NE(among_others[1], before) << "both have the same safe form";
}

TEST(ScanPrefixes, Differ_WhenNamesDifferInCaseOnly) {
  const auto prefixes = scanPrefixes({"Kitchen", "kitchen"});
  EXPECT_THAT(prefixes[0], testing::StartsWith("Kitchen-"));
  EXPECT_THAT(prefixes[1], testing::StartsWith("kitchen-"));
  EXPECT_NE(prefixes[0].substr(8), prefixes[1].substr(8));
}

}  // namespace
}  // namespace scantrove::test
