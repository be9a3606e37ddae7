#include "core/session/param_registry.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <sys/stat.h>

#include <algorithm>
#include <set>

#include "tests/support/temporary_folder.h"

namespace scantrove {
namespace {

using testing::HasSubstr;

std::string refusal(const std::string& setting) {
  ScanParams params;
  const Result<void> done = applySetting(params, setting);
  return done ? "" : done.error().message();
}

TEST(ParamRegistry, HasUniqueKeysAndDefaultsInRange) {
  std::set<std::string> keys;
  const ScanParams defaults;
  for (const ParamInfo& info : paramRegistry()) {
    EXPECT_TRUE(keys.insert(info.key).second) << info.key;
    EXPECT_TRUE(info.isAutomatic(defaults) || info.get(defaults) >= info.minimum) << info.key;
    EXPECT_LE(info.get(defaults), info.maximum) << info.key;
    EXPECT_FALSE(info.help.empty()) << info.key;
  }
}

TEST(ParamRegistry, ReadsBackWhatWasSet) {
  for (const ParamInfo& info : paramRegistry()) {
    ScanParams params;
    for (const double value : {info.minimum, info.maximum}) {
      info.set(params, value);
      EXPECT_NEAR(info.get(params), value, 1e-5 * std::abs(value)) << info.key;
      ScanParams again;
      const Result<void> done = applySetting(again, info.key + "=" + info.text(params));
      ASSERT_TRUE(done) << done.error().message();
      EXPECT_EQ(info.get(again), info.get(params)) << info.key;
    }
  }
}

TEST(ParamRegistry, ReadsAutomaticValues_WhereASensorDecides) {
  ScanParams params;
  const auto info = std::ranges::find(paramRegistry(), "fusion.voxel_size_m", &ParamInfo::key);
  EXPECT_EQ(info->text(params), "auto");
  ASSERT_TRUE(applySetting(params, "fusion.voxel_size_m=0.01"));
  EXPECT_FALSE(info->isAutomatic(params));
  ASSERT_TRUE(applySetting(params, "fusion.voxel_size_m=auto"));
  EXPECT_TRUE(info->isAutomatic(params));
  const test::TemporaryFolder folder;
  ASSERT_TRUE(applySetting(params, "fusion.voxel_size_m=0.01"));
  ASSERT_TRUE(loadConfig(params, folder.write("c.toml", "[fusion]\nvoxel_size_m = \"auto\"\n")));
  EXPECT_TRUE(info->isAutomatic(params));
  EXPECT_THAT(refusal("fusion.voxel_size_m=-1"), HasSubstr("out of range"));
  EXPECT_THAT(refusal("segmentation.k=auto"), HasSubstr("is no number"));
}

TEST(ParamRegistry, TextKeepsEveryBit) {
  ScanParams params;
  for (const float voxel_size_m : {3.0F / 512.0F, 0.01F, 0.1F / 3.0F, 0.0078125F}) {
    params.fusion.voxel_size_m = voxel_size_m;
    for (const ParamInfo& info : paramRegistry()) {
      ScanParams again;
      ASSERT_TRUE(applySetting(again, info.key + "=" + info.text(params))) << info.key;
      EXPECT_EQ(info.get(again), info.get(params)) << info.key << " " << info.text(params);
    }
  }
}

TEST(ParamRegistry, RefusesASetting_WhenKeyOrValueIsWrong) {
  EXPECT_THAT(refusal("segmentation.q=1"), HasSubstr("Did you mean 'segmentation.k'"));
  EXPECT_THAT(refusal("segmentation.k=many"), HasSubstr("'many' is no number"));
  EXPECT_THAT(refusal("segmentation.k=nan"), HasSubstr("no number"));
  EXPECT_THAT(refusal("segmentation.k=-1"), HasSubstr("between"));
  EXPECT_THAT(refusal("segmentation.k"), HasSubstr("key=value"));
  EXPECT_THAT(refusal("labeling.rule=best"), HasSubstr("graph, thesis"));
  EXPECT_THAT(refusal("="), HasSubstr("key=value"));
  EXPECT_THAT(refusal("=3"), HasSubstr("key=value"));
  EXPECT_THAT(refusal("segmentation.k="), HasSubstr("'' is no number"));
}

TEST(ParamRegistry, RefusesAFraction_WhenTheParameterIsAnInteger) {
  EXPECT_THAT(refusal("detection.max_views=1.5"), HasSubstr("not a whole number"));
  EXPECT_EQ(refusal("detection.max_views=2"), "");
  EXPECT_EQ(refusal("detection.max_distance=0.25"), "");
  const test::TemporaryFolder folder;
  ScanParams params;
  const Result<void> done = loadConfig(params, folder.write("c.toml", "[detection]\nmax_views = 1.5\n"));
  ASSERT_FALSE(done);
  EXPECT_THAT(done.error().message(), HasSubstr("line 2"));
}

TEST(ParamRegistry, KeepsAFileAsAnAbsolutePath) {
  ScanParams params;
  const auto& registry = paramRegistry();
  const auto info = std::ranges::find(registry, "recognition.model", &ParamInfo::key);
  ASSERT_NE(info, registry.end());
  EXPECT_EQ(info->text(params), "off");
  EXPECT_FALSE(info->isNumber());
  ASSERT_TRUE(applySetting(params, "recognition.model=nets/../a=b.onnx"));
  EXPECT_EQ(params.detection.model, (std::filesystem::current_path() / "a=b.onnx").string());
  ScanParams again;
  ASSERT_TRUE(applySetting(again, "recognition.model=" + info->text(params)));
  EXPECT_EQ(again.detection.model, params.detection.model);
  ASSERT_TRUE(applySetting(params, "recognition.model=off"));
  EXPECT_EQ(params.detection.model, "");
  EXPECT_THAT(refusal("recognition.model="), HasSubstr("is no file"));
  EXPECT_THAT(refusal("recognition.model=a\nb"), HasSubstr("is no file"));

  const test::TemporaryFolder folder;
  ASSERT_TRUE(loadConfig(params, folder.write("c.toml", "[recognition]\nmodel = \"/x/net.onnx\"\n")));
  EXPECT_EQ(params.detection.model, "/x/net.onnx");
  ASSERT_TRUE(loadConfig(params, folder.write("e.toml", "[recognition]\nmodel = \"/x/m\\u00F6bel.onnx\"\n")));
  EXPECT_EQ(params.detection.model, "/x/möbel.onnx");
  EXPECT_FALSE(loadConfig(params, folder.write("d.toml", "[recognition]\nmodel = 3\n")));
}

TEST(ParamRegistry, SuggestsSimilarKeys_WhenAKeyIsUnknown) {
  EXPECT_THAT(refusal("voxel_size_m=1"), HasSubstr("Did you mean 'fusion.voxel_size_m'?"));
  EXPECT_THAT(refusal("fusion.depth_m=1"),
              testing::AllOf(HasSubstr("'fusion.min_depth_m'"), HasSubstr("'fusion.max_depth_m'")));
  EXPECT_THAT(refusal("laundry=1"), testing::Not(HasSubstr("Did you mean")));
}

TEST(ParamRegistry, NamesAConfiguration_WhenItIsNoFile) {
  const test::TemporaryFolder folder;
  ScanParams params;
  ASSERT_EQ(mkfifo((folder / "pipe").c_str(), 0600), 0);
  std::filesystem::create_symlink("loop", folder / "loop");
  for (const char* name : {"pipe", "loop", "none", ""}) {
    const Result<void> done = loadConfig(params, folder / name);
    ASSERT_FALSE(done);
    EXPECT_THAT(done.error().message(), HasSubstr((folder / name).string()));
  }
}

TEST(ParamRegistry, RefusesConfiguration_WhenKeyOrFileIsTooLong) {
  const test::TemporaryFolder folder;
  const auto deepKey = [](int parts) {
    std::string key = "a";
    for (int i = 1; i < parts; ++i) key += ".a";
    return key;
  };
  const std::string comment = "# " + std::string(200, '.') + "\n[fusion] # " + std::string(200, '.') + "\n";
  ScanParams params;
  EXPECT_TRUE(loadConfig(params, folder.write("comment.toml", comment)));
  for (const std::string& text :
       {deepKey(200'000) + " = 1\n", "[" + deepKey(200'000) + "]\n", "x = {" + deepKey(30'000) + " = 1}\n",
        "x = \"#\" # " + deepKey(30'000) + "\n", std::string(70'000, '\n')}) {
    const Result<void> done = loadConfig(params, folder.write("deep.toml", text));
    ASSERT_FALSE(done) << text.substr(0, 20);
    EXPECT_THAT(done.error().message(), HasSubstr("deep.toml"));
    EXPECT_LT(done.error().message().size(), 500U);
  }
}

TEST(ParamRegistry, AppliesNothing_WhenAConfigurationIsInvalid) {
  const test::TemporaryFolder folder;
  ScanParams params;
  ASSERT_TRUE(loadConfig(params, folder.write("good.toml",
                                              "\xEF\xBB\xBF[segmentation]\nk = 0.5 # für Möbel\n"
                                              "[labeling]\nrule = \"thesis\"\n"
                                              "joining_bias = 0.5\n")));
  EXPECT_FLOAT_EQ(params.segmentation.k, 0.5F);
  EXPECT_EQ(params.labeling.rule, LabelingParams::Rule::thesis);
  EXPECT_FLOAT_EQ(params.labeling.joining_bias, 0.5F);

  const Result<void> bad = loadConfig(params, folder.write("bad.toml", "[segmentation]\nk = 0.7\nkk = 1\n"));
  ASSERT_FALSE(bad);
  EXPECT_THAT(bad.error().message(), HasSubstr("line 3"));
  EXPECT_FLOAT_EQ(params.segmentation.k, 0.5F);
  for (const char* text :
       {"[segmentation\n", "[!segmentation]\n", "[[!segmentation]]\n", "[segmentation]\nkä = 1\n"}) {
    const Result<void> broken = loadConfig(params, folder.write("broken.toml", text));
    ASSERT_FALSE(broken) << text;
    EXPECT_THAT(broken.error().message(), HasSubstr("broken.toml"));
  }
}

}  // namespace
}  // namespace scantrove
