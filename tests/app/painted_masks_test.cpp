// Masks that a person paints in one image, which a demo's truth stands for.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <map>
#include <opencv2/core.hpp>
#include <opencv2/imgcodecs.hpp>
#include <opencv2/imgproc.hpp>

#include "tests/app/demo_scan.h"

namespace scantrove::test {
namespace {

namespace fs = std::filesystem;
using testing::HasSubstr;

constexpr int kLeastObject_px = 1500;

class PaintedMasksTest : public DemoScanTest {
 protected:
  using Masks = std::map<int, cv::Mat>;  // by frame

  static std::string sixDigits(int frame) {
    const std::string digits = std::to_string(frame);
    return std::string(6 - digits.size(), '0') + digits;
  }
  /// The true instances of a frame.
  static cv::Mat truthOf(int frame) {
    const fs::path file = demoFolder() / "truth" / ("frame-" + sixDigits(frame) + ".instance.png");
    return cv::imread(file.string(), cv::IMREAD_UNCHANGED);
  }
  static int instanceOf(const std::string& name) {
    for (const Json& instance : Json::parse(readText(demoFolder() / "truth" / "instances.json"))) {
      if (instance["name"] == name) return instance["id"];
    }
    return 0;
  }
  /// An export with the images of all key frames, and the masks of objects.
  [[nodiscard]] Masks exported(const std::string& name) const {
    const Finished run = scantrove({"export", scan_, "--format", "masks", "--background",
                                    "--include-unfit-frames", "--out", folder_ / name});
    EXPECT_EQ(run.exit_code, 0) << run.err;
    Masks masks;
    for (const auto& entry : fs::directory_iterator(folder_ / name / "masks"))
      masks[std::stoi(entry.path().stem().string())] =
          cv::imread(entry.path().string(), cv::IMREAD_UNCHANGED);
    return masks;
  }
  /// All regions in the image of a key frame.
  [[nodiscard]] cv::Mat regionsIn(int frame) const {
    const fs::path file = folder_ / ("regions-" + std::to_string(++images_) + ".png");
    const Finished run = session({"masks", "--frame", std::to_string(frame), "--out", file});
    EXPECT_EQ(run.exit_code, 0) << run.err;
    return cv::imread(file.string(), cv::IMREAD_UNCHANGED);
  }
  /// All regions in all key frames, whose numbers an export tells.
  [[nodiscard]] Masks regionsOfAll(const Masks& key_frames) const {
    Masks masks;
    for (const auto& [frame, mask] : key_frames) masks[frame] = regionsIn(frame);
    return masks;
  }
  /// Overlap of a region with a true instance, over all frames but `without`.
  static double overlapOf(const Masks& masks, int region, int instance, int without) {
    double both = 0, any = 0;
    for (const auto& [frame, mask] : masks) {
      if (frame == without) continue;
      const cv::Mat found = mask == region, truth = truthOf(frame) == instance;
      both += cv::countNonZero(found & truth);
      any += cv::countNonZero(found | truth);
    }
    return any > 0 ? both / any : 0;
  }
  [[nodiscard]] fs::path written(const std::string& name, const cv::Mat& mask) const {
    EXPECT_TRUE(cv::imwrite((folder_ / name).string(), mask));
    return folder_ / name;
  }
  /// The region that covers most of an instance in an image.
  static int regionOf(const cv::Mat& mask, int frame, int instance) {
    std::map<int, int> pixels;
    const cv::Mat truth = truthOf(frame);
    for (int y = 0; y < mask.rows; ++y) {
      for (int x = 0; x < mask.cols; ++x) {
        const int region = mask.at<std::uint16_t>(y, x);
        if (truth.at<std::uint16_t>(y, x) == instance && region != 0) ++pixels[region];
      }
    }
    const auto most = std::max_element(pixels.begin(), pixels.end(),
                                       [](const auto& a, const auto& b) { return a.second < b.second; });
    return most == pixels.end() ? 0 : most->first;
  }

  /// An object with a region of its own, and the key frame that shows most of it.
  struct Shown {
    int instance = 0, region = 0, frame = 0, pixels = 0;
  };
  static Shown someObject(const Masks& masks) {
    Shown best;
    for (const char* name : {"cereal box", "teapot", "can", "bowl", "mug", "L block"}) {
      Shown shown{.instance = instanceOf(name)};
      for (const auto& [frame, mask] : masks) {
        const int pixels = cv::countNonZero(truthOf(frame) == shown.instance);
        if (pixels > shown.pixels) shown.frame = frame, shown.pixels = pixels;
      }
      if (shown.pixels < kLeastObject_px) continue;
      shown.region = regionOf(masks.at(shown.frame), shown.frame, shown.instance);
      const int table = regionOf(masks.at(shown.frame), shown.frame, instanceOf("table"));  // may be none
      if (shown.region == 0 || shown.region == table) continue;
      best = shown;
      break;
    }
    return best;
  }
  [[nodiscard]] static std::string text(int number) { return std::to_string(number); }

  mutable int images_ = 0;  // of regionsIn()
};

TEST_F(PaintedMasksTest, OneCorrectedImageRaisesTheOverlapInOthers) {
  const Masks at_first = regionsOfAll(exported("first"));
  ASSERT_GE(at_first.size(), 3U);
  const Shown shown = someObject(at_first);
  ASSERT_NE(shown.region, 0);
  const double possible = overlapOf(at_first, shown.region, shown.instance, shown.frame);
  // A flaw: the object and the table are one region.
  const int table = regionOf(at_first.at(shown.frame), shown.frame, instanceOf("table"));
  ASSERT_EQ(session({"join", text(table), text(shown.region)}).exit_code, 0);
  const std::string flawed = regionTable();
  const cv::Mat truth = truthOf(shown.frame) == shown.instance;
  const fs::path mask = written("truth.png", truth);
  const Finished run =
      session({"paint", mask, "--frame", text(shown.frame), "--region", text(table), "--remove", "--json"});
  ASSERT_EQ(run.exit_code, 0) << run.err;
  const Json changed = Json::parse(run.out)["regions"];
  EXPECT_GE(changed.size(), 2U) << "the table and a new region";
  EXPECT_EQ(changed[0], table);
  const Masks corrected = regionsOfAll(at_first);
  const int created = regionOf(corrected.at(shown.frame), shown.frame, shown.instance);
  EXPECT_NE(created, table);
  EXPECT_GE(overlapOf(corrected, created, shown.instance, shown.frame), 0.9 * possible);
  EXPECT_EQ(cv::countNonZero((corrected.at(shown.frame) == table) & truth), 0) << "as painted";
  ASSERT_EQ(session({"undo"}).exit_code, 0);
  EXPECT_EQ(regionTable(), flawed) << "one step takes back all";
}

TEST_F(PaintedMasksTest, HoldExactlyInTheirImage) {
  const Masks at_first = exported("first");
  const Shown shown = someObject(at_first);  // in data sets
  ASSERT_NE(shown.region, 0);
  const cv::Mat regions_at_first = regionsIn(shown.frame);
  cv::Mat mask = cv::Mat::zeros(regions_at_first.size(), CV_8UC1);
  cv::circle(mask, {320, 240}, 40, 255, cv::FILLED);
  const std::string before = regionTable();
  const Finished run = session({"paint", written("disc.png", mask), "--frame", text(shown.frame), "--region",
                                text(shown.region), "--set", "--this-image-only"});
  ASSERT_EQ(run.exit_code, 0) << run.err;
  EXPECT_EQ(run.out, text(shown.region) + "\n");
  EXPECT_EQ(regionTable(), before);
  const cv::Mat painted = regionsIn(shown.frame);
  ASSERT_EQ(painted.type(), CV_16UC1);
  EXPECT_EQ(cv::countNonZero((painted == shown.region) != mask), 0);
  EXPECT_EQ(cv::countNonZero((exported("again").at(shown.frame) == shown.region) != mask), 0)
      << "as in data sets";
  const Json at = jsonOf(session({"at", "--frame", text(shown.frame), "--pixel", "320,240", "--json"}));
  EXPECT_EQ(at["region"], shown.region);
  const Finished history = session({"history"});
  EXPECT_THAT(history.out, HasSubstr("Correct mask of"));
  EXPECT_THAT(history.out, HasSubstr("in image " + text(shown.frame)));
  ASSERT_EQ(session({"undo"}).exit_code, 0);
  EXPECT_EQ(cv::countNonZero(regionsIn(shown.frame) != regions_at_first), 0);
  ASSERT_EQ(session({"redo"}).exit_code, 0);
  EXPECT_EQ(cv::countNonZero(regionsIn(shown.frame) != painted), 0);
}

TEST_F(PaintedMasksTest, PolygonPaintsWithHoles) {
  const Masks at_first = exported("first");
  const int frame = at_first.begin()->first;
  const std::string region = plainRegions().front();
  const Finished run =
      session({"paint", "--frame", text(frame), "--region", region, "--set", "--this-image-only", "--polygon",
               "99.5,99.5,199.5,99.5,199.5,199.5,99.5,199.5", "--polygon",
               "119.5,119.5,139.5,119.5,139.5,139.5,119.5,139.5"});
  ASSERT_EQ(run.exit_code, 0) << run.err;
  EXPECT_EQ(cv::countNonZero(regionsIn(frame) == std::stoi(region)), 100 * 100 - 20 * 20);
}

TEST_F(PaintedMasksTest, RefuseUnusablePaintings) {
  const Masks at_first = exported("first");
  const std::string frame = text(at_first.begin()->first), region = plainRegions().front();
  const cv::Mat all(480, 640, CV_8UC1, cv::Scalar::all(255));
  const fs::path mask = written("mask.png", all);
  const std::string before = regionTable();
  const auto paint = [&](const fs::path& file, const std::string& of_frame, const std::string& of_region) {
    return session({"paint", file, "--frame", of_frame, "--region", of_region, "--add"});
  };
  expectJobFailure(paint(mask, "99999", region), {"No image of frame 99999"});
  expectJobFailure(paint(mask, frame, "99999"), {"no region 99999"});
  expectJobFailure(paint(written("small.png", all(cv::Rect(0, 0, 64, 48))), frame, region),
                   {"small.png has 64 x 48 pixels", "640 x 480"});
  expectJobFailure(paint(written("none.png", cv::Mat::zeros(480, 640, CV_8UC1)), frame, region),
                   {"Nothing is painted"});
  expectJobFailure(paint(written("deep.png", cv::Mat(480, 640, CV_16UC1, cv::Scalar::all(1))), frame, region),
                   {"deep.png", "8 bits"});
  expectJobFailure(
      paint(written("alpha.png", cv::Mat(480, 640, CV_8UC4, cv::Scalar::all(255))), frame, region),
      {"alpha.png", "4 channels", "without alpha"});
  expectJobFailure(paint(folder_ / "missing.png", frame, region), {"missing.png"});
  expectJobFailure(session({"paint", "--frame", frame, "--region", region, "--add", "--polygon", "1,2,3,4"}),
                   {"no polygon"});
  expectJobFailure(session({"masks", "--frame", frame, "--out", mask}), {"mask.png exists"});
  EXPECT_EQ(regionTable(), before);
  EXPECT_EQ(jsonOf(session({"history", "--json"})).size(), 0U);
}

TEST_F(PaintedMasksTest, NewRegionIsItsMask_AndCanBeNamedAndTakenBack) {
  const Masks at_first = regionsOfAll(exported("first"));
  const Shown shown = someObject(at_first);
  ASSERT_NE(shown.region, 0);
  const std::string frame = text(shown.frame);
  const cv::Mat before = at_first.at(shown.frame);
  // The middle of the object, away from its outline.
  cv::Mat object = before == shown.region, middle;
  cv::erode(object, middle, cv::getStructuringElement(cv::MORPH_ELLIPSE, {9, 9}));
  const cv::Rect box = cv::boundingRect(middle);
  cv::Mat mask = cv::Mat::zeros(middle.size(), CV_8UC1);
  const cv::Rect left(box.x, box.y, box.width / 2, box.height);
  middle(left).copyTo(mask(left));
  const Finished run = session(
      {"paint", written("part.png", mask), "--frame", frame, "--new-region", "--name", "sticker", "--json"});
  ASSERT_EQ(run.exit_code, 0) << run.err;
  const int created = Json::parse(run.out)["regions"][0];
  EXPECT_NE(created, shown.region);
  EXPECT_EQ(cv::countNonZero((regionsIn(shown.frame) == created) != mask), 0);
  EXPECT_THAT(session({"regions"}).out, HasSubstr("sticker"));

  ASSERT_EQ(session({"unpaint", "--frame", frame, "--region", text(created)}).exit_code, 0);
  EXPECT_GT(cv::countNonZero((regionsIn(shown.frame) == created) & mask), 0) << "the region behind stays";
  expectJobFailure(session({"unpaint", "--frame", frame, "--region", text(created)}), {"Nothing is painted"});
  ASSERT_EQ(session({"undo", "--steps", "3"}).exit_code, 0);
  EXPECT_EQ(cv::countNonZero(regionsIn(shown.frame) != before), 0);
}

TEST_F(PaintedMasksTest, NewRegionNeedsNoRegion_AndNothingElseDoes) {
  const std::string frame = "0";
  for (const std::vector<std::string>& wrong : {std::vector<std::string>{"--new-region", "--region", "3"},
                                                {"--new-region", "--add"},
                                                {"--new-region", "--this-image-only"},
                                                {"--add"},
                                                {"--add", "--region", "3", "--name", "mug"}}) {
    std::vector<std::string> words{"paint", "--frame", frame, "--polygon", "1,1,9,1,9,9"};
    words.insert(words.end(), wrong.begin(), wrong.end());
    EXPECT_EQ(session(words).exit_code, 2) << wrong.back();
  }
}

}  // namespace
}  // namespace scantrove::test
