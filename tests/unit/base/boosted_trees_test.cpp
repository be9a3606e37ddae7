#include "core/base/boosted_trees.h"

#include <gmock/gmock.h>

#include <string>

namespace scantrove {
namespace {

using testing::HasSubstr;

constexpr std::array<std::string_view, 2> kFeatures{"size", "color"};

/// The root tests the size, its children test the color; the leaves are 1, 2, 4 and 8 from left to right.
constexpr std::string_view kModel = R"({"features": ["size", "color"], "medians": {"color": 3}, "prior": 100,
  "levels": 2, "trees": [[0, 0.5, 1, 10, 1, -10, 1, 2, 4, 8], [0, 1e30, 0, 0, 0, 0, 16, 16, 32, 32]]})";

std::string changed(std::string_view from, std::string_view to) {
  std::string model(kModel);
  const std::size_t at = model.find(from);
  return at == std::string::npos ? "no such text" : model.replace(at, from.size(), to);
}

std::string errorOf(const std::string& model, std::span<const std::string_view> features = kFeatures) {
  const auto trees = BoostedTrees::parse({"models/toy.json", model}, features);
  return trees ? "no error" : trees.error().message();
}

float logOdds(float size, float color) {
  const auto trees = BoostedTrees::parse({"models/toy.json", kModel}, kFeatures);
  std::array features{size, color};
  return trees.value().logOdds(features);
}

TEST(BoostedTrees, SumLeaves_LeftUpToTheLimitAndRightBeyond) {
  EXPECT_EQ(logOdds(0.5F, 10), 100 + 1 + 16) << "values equal to the limits";
  EXPECT_EQ(logOdds(0, 10.5F), 100 + 2 + 16);
  EXPECT_EQ(logOdds(0.6F, -10), 100 + 4 + 16);
  EXPECT_EQ(logOdds(0.6F, -9), 100 + 8 + 16);
}

TEST(BoostedTrees, UseTheMedian_WhenAFeatureIsUnknown) {
  EXPECT_EQ(logOdds(0, kUnknownFeature), logOdds(0, 3));
  EXPECT_EQ(logOdds(1, kUnknownFeature), logOdds(1, 3));
}

TEST(BoostedTrees, NameFileAndFeature_WhenTheProgramDoesNotComputeIt) {
  EXPECT_EQ(errorOf(std::string(kModel), std::array<std::string_view, 2>{"size", "colour"}),
            "The model models/toy.json cannot be used: its feature 2 is 'color', which the program does not "
            "compute. Train it anew, see tools/train/README.md.");
  EXPECT_THAT(errorOf(std::string(kModel), std::array<std::string_view, 1>{"size"}),
              HasSubstr("its feature 2 is 'color'"));
  EXPECT_THAT(errorOf(changed("\"color\"]", "\"size\"]")), HasSubstr("names the feature 'size' twice"));
}

TEST(BoostedTrees, FindFeaturesByName_WhenTheProgramComputesMoreInAnotherOrder) {
  constexpr std::array<std::string_view, 4> kComputed{"fill", "color", "holes", "size"};
  const auto trees = BoostedTrees::parse({"models/toy.json", kModel}, kComputed);
  ASSERT_TRUE(trees) << trees.error().message();
  for (const float size : {0.5F, 0.6F}) {
    for (const float color : {-10.0F, 0.0F, 10.5F, kUnknownFeature}) {
      for (const float other : {-100.0F, 100.0F, kUnknownFeature}) {
        std::array features{other, color, other, size};
        EXPECT_EQ(trees->logOdds(features), logOdds(size, color)) << size << ", " << color << ", " << other;
      }
    }
  }
  EXPECT_TRUE(trees->reads("size"));
  EXPECT_TRUE(trees->reads("color"));
  EXPECT_FALSE(trees->reads("fill")) << "computed, but not in the file";
}

TEST(BoostedTrees, AreRefused_WhenTheFileIsDamaged) {
  EXPECT_THAT(errorOf(changed("8], [", "], [")), HasSubstr("cannot be used"));
  EXPECT_THAT(errorOf(changed(", 8]", "]")), HasSubstr("tree 0 holds 9 numbers"));
  EXPECT_THAT(errorOf(changed("[[0, 0.5", "[[2, 0.5")), HasSubstr("asks for feature 2"));
  EXPECT_THAT(errorOf(changed("[[0, 0.5", "[[-1, 0.5")), HasSubstr("asks for feature -1"));
  EXPECT_THAT(errorOf(changed("\"levels\": 2", "\"levels\": 40")), HasSubstr("40 levels"));
  EXPECT_THAT(errorOf(changed("{\"color\": 3}", "{\"hue\": 3}")), HasSubstr("median 'hue' is of no feature"));
  EXPECT_THAT(errorOf(changed("\"prior\": 100,", "")), HasSubstr("prior"));
}

}  // namespace
}  // namespace scantrove
