// Suggestions from masks of another program, which a demo's truth stands for.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <map>
#include <opencv2/core.hpp>
#include <opencv2/imgcodecs.hpp>

#include "tests/app/demo_scan.h"

namespace scantrove::test {
namespace {

namespace fs = std::filesystem;
using testing::HasSubstr;

constexpr int kShownFrame = 20;
constexpr int kMinObject_px = 800;

class SuggestionsTest : public DemoScanTest {
 protected:
  using Masks = std::map<std::string, cv::Mat>;  // by file name, CV_16UC1

  /// The recording of the demo's frames with their true instances.
  static fs::path truth() { return demoFolder() / "truth"; }
  static Masks trueMasks() {
    Masks masks;
    for (int frame = 0; frame < 40; ++frame) {
      const std::string number = std::string(frame < 10 ? "00000" : "0000") + std::to_string(frame);
      masks[number + ".png"] =
          cv::imread((truth() / ("frame-" + number + ".instance.png")).string(), cv::IMREAD_UNCHANGED);
    }
    return masks;
  }
  /// The number of the true instance with this name.
  static int instanceOf(const std::string& name) {
    for (const Json& instance : Json::parse(readText(truth() / "instances.json"))) {
      if (instance["name"] == name) return instance["id"];
    }
    return 0;
  }
  /// The region in the middle of what the shown frame shows of an instance; 0: too little.
  [[nodiscard]] int regionOf(int instance, const Masks& masks) const {
    cv::Mat inside = masks.at("0000" + std::to_string(kShownFrame) + ".png") == instance;
    if (cv::countNonZero(inside) < kMinObject_px) return 0;
    std::vector<cv::Point> pixels;
    cv::findNonZero(inside, pixels);
    const cv::Point middle = pixels[pixels.size() / 2];
    const Finished at = session({"at", "--frame", std::to_string(kShownFrame), "--pixel",
                                 std::to_string(middle.x) + "," + std::to_string(middle.y), "--json"});
    return at.exit_code == 0 ? Json::parse(at.out)["region"].get<int>() : 0;
  }
  [[nodiscard]] fs::path written(const Masks& masks) const {
    const fs::path folder = folder_ / "masks";
    fs::create_directories(folder);
    for (const auto& [name, labels] : masks) EXPECT_TRUE(cv::imwrite((folder / name).string(), labels));
    return folder;
  }
  [[nodiscard]] Json suggested(const fs::path& masks, int min_frames = 2,
                               std::vector<std::string> options = {}) const {
    options.insert(options.begin(),
                   {"suggest", "--masks", masks, "--min-frames", std::to_string(min_frames), "--json"});
    return jsonOf(session(options));
  }
  /// The join that holds both regions; null: there is none.
  static Json joinOf(const Json& suggestions, int a, int b) {
    for (const Json& proposal : suggestions["proposals"]) {
      const Json& regions = proposal["regions"];
      const bool has_both = std::count(regions.begin(), regions.end(), a) > 0 &&
                            std::count(regions.begin(), regions.end(), b) > 0;
      if (proposal["kind"] == "join" && has_both) return proposal;
    }
    return {};
  }

  /// Two regions that touch, and masks of which each holds both.
  struct JoinedPair {
    int table = 0, object = 0;
    Masks masks;
  };
  [[nodiscard]] JoinedPair joinedPair() const {
    JoinedPair pair{.masks = trueMasks()};
    const int table = instanceOf("table");
    pair.table = regionOf(table, pair.masks);
    for (const char* name : {"L block", "cereal box", "can", "teapot", "bowl", "mug", "book, lower"}) {
      const int object = instanceOf(name);
      pair.object = regionOf(object, pair.masks);
      if (pair.object == 0 || pair.object == pair.table) continue;
      for (auto& [file, labels] : pair.masks) labels.setTo(table, labels == object);
      break;
    }
    return pair;
  }
};

TEST_F(SuggestionsTest, ProposesToJoinWhatMasksHoldTogether) {
  const JoinedPair pair = joinedPair();
  ASSERT_NE(pair.table, 0);
  ASSERT_NE(pair.object, 0);
  ASSERT_NE(pair.object, pair.table);
  const fs::path masks = written(pair.masks);
  const std::string before = regionTable();
  const Json suggestions = suggested(masks);
  EXPECT_GE(suggestions["key_frames"], 2);
  const Json join = joinOf(suggestions, pair.table, pair.object);
  ASSERT_FALSE(join.is_null()) << suggestions;
  EXPECT_GE(join["frames_for"], 2);
  EXPECT_TRUE(join["result"].is_null()) << "nothing was performed";
  EXPECT_EQ(regionTable(), before);
  EXPECT_EQ(jsonOf(session({"history", "--json"})).size(), 0U);
  const Finished text = session({"suggest", "--masks", masks, "--min-frames", "2"});
  EXPECT_EQ(text.exit_code, 0);
  EXPECT_THAT(text.out, HasSubstr("join"));
  EXPECT_THAT(text.err, HasSubstr("--apply"));
}

TEST_F(SuggestionsTest, ProposesNoJoin_WhenMasksPartTheRegions) {
  const JoinedPair pair = joinedPair();
  ASSERT_NE(pair.object, 0);
  EXPECT_TRUE(joinOf(suggested(written(trueMasks())), pair.table, pair.object).is_null());
}

TEST_F(SuggestionsTest, AppliedProposalsAreUndoneOneByOne) {
  const JoinedPair pair = joinedPair();
  ASSERT_NE(pair.object, 0);
  const std::string before = regionTable();
  const Json applied = suggested(written(pair.masks), 2, {"--apply"});
  const std::size_t count = applied["proposals"].size();
  ASSERT_GE(count, 1U);
  const Json join = joinOf(applied, pair.table, pair.object);
  ASSERT_FALSE(join.is_null()) << applied;
  EXPECT_EQ(join["result"].size(), 1U);
  EXPECT_EQ(jsonOf(session({"history", "--json"})).size(), count) << "one operation each";
  EXPECT_NE(regionTable(), before);
  ASSERT_EQ(session({"undo", "--steps", std::to_string(count)}).exit_code, 0);
  EXPECT_EQ(regionTable(), before);
}

TEST_F(SuggestionsTest, RespectsWhatAPersonSaid) {
  const JoinedPair pair = joinedPair();
  ASSERT_NE(pair.object, 0);
  const std::string table = std::to_string(pair.table), object = std::to_string(pair.object);
  const fs::path masks = written(pair.masks);
  ASSERT_EQ(session({"background", table}).exit_code, 0);
  ASSERT_EQ(session({"name", "--region", object, "--name", "mine"}).exit_code, 0);
  EXPECT_TRUE(joinOf(suggested(masks), pair.table, pair.object).is_null()) << "both are labelled";
}

TEST_F(SuggestionsTest, ProposesNothing_WhenMasksAreTheRegions) {
  ASSERT_EQ(
      scantrove({"export", scan_, "--format", "masks", "--background", "--out", folder_ / "own"}).exit_code,
      0);
  EXPECT_EQ(suggested(folder_ / "own" / "masks", 3)["proposals"].size(), 0U);
}

TEST_F(SuggestionsTest, ReadsItsOwnCocoExport) {
  ASSERT_EQ(
      scantrove({"export", scan_, "--format", "coco", "--background", "--out", folder_ / "own"}).exit_code,
      0);
  const Json suggestions = suggested(folder_ / "own" / "annotations", 3);
  EXPECT_EQ(suggestions["proposals"].size(), 0U) << "masks are the regions";
  EXPECT_GE(suggestions["masks"], 5);
}

TEST_F(SuggestionsTest, RefusesUnusableMasks) {
  const auto suggest = [&](const fs::path& masks) { return session({"suggest", "--masks", masks}); };
  const auto writeMask = [&](const std::string& name, const cv::Mat& labels) {
    fs::create_directories((folder_ / name).parent_path());
    EXPECT_TRUE(cv::imwrite((folder_ / name).string(), labels));
  };
  expectJobFailure(suggest(folder_ / "missing"), {"missing is not a folder"});
  fs::create_directories(folder_ / "empty");
  expectJobFailure(suggest(folder_ / "empty"), {"holds no masks"});
  writeMask("other/009999.png", cv::Mat(480, 640, CV_16UC1, cv::Scalar(1)));
  expectJobFailure(suggest(folder_ / "other"), {"other", "the number of a key frame"});
  writeMask("small/000000.png", cv::Mat(48, 64, CV_16UC1, cv::Scalar(1)));
  expectJobFailure(suggest(folder_ / "small"), {"000000.png has 64 x 48 pixels", "640 x 480"});
  writeMask("void/000000.png", cv::Mat(480, 640, CV_16UC1, cv::Scalar(0)));
  expectJobFailure(suggest(folder_ / "void"), {"hold no mask"});
  writeMask("damaged/000000.png", cv::Mat(480, 640, CV_16UC1, cv::Scalar(1)));
  fs::resize_file(folder_ / "damaged/000000.png", 60);
  expectJobFailure(suggest(folder_ / "damaged"), {"damaged/000000.png"});
  folder_.write("broken/masks.json", "{");
  expectJobFailure(suggest(folder_ / "broken"), {"masks.json is not a COCO file"});
}

}  // namespace
}  // namespace scantrove::test
