#include "core/dataset/catalogue_export.h"

#include <gmock/gmock.h>

#include <algorithm>
#include <array>
#include <filesystem>
#include <nlohmann/json.hpp>
#include <opencv2/imgcodecs.hpp>
#include <set>

#include "tests/support/temporary_folder.h"
#include "tests/unit/catalogue/catalogue_test_support.h"

namespace scantrove {
namespace {

namespace fs = std::filesystem;
using test::openOrFail;
using test::randomView;
using test::readText;
using test::sameImage;
using testing::HasSubstr;
using Json = nlohmann::json;

class ExportCatalogueTest : public testing::Test {
 protected:
  void SetUp() override {
    const auto database = openOrFail(file());
    const std::int64_t session = *database->sessions().begin("desk", K_);
    ObjectView view = randomView(1);
    view.session = session;
    first_ = database->addObject(view)->id;
    view = randomView(2);
    view.object = first_;
    EXPECT_TRUE(database->addView(view));
    EXPECT_TRUE(database->rename(first_, "a/b: \"mug\""));
    second_ = database->addObject(randomView(3))->id;
    const ObjectId removed = database->addObject(randomView(4))->id;
    EXPECT_TRUE(database->remove(std::array{removed}));
  }
  [[nodiscard]] std::string file() const { return (home_ / "catalogue.sqlite").string(); }
  [[nodiscard]] std::set<std::string> allFiles() const {
    std::set<std::string> files;
    for (const auto& entry : fs::recursive_directory_iterator(home_.path()))
      files.insert(entry.path().string());
    return files;
  }
  static cv::Mat image(const fs::path& path) { return cv::imread(path.string(), cv::IMREAD_UNCHANGED); }

  const Intrinsics K_{500, 510, 320, 240, 640, 480};
  test::TemporaryFolder home_;
  ObjectId first_, second_;
};

TEST_F(ExportCatalogueTest, WritesAFolderForEachObjectAndAnIndex) {
  int steps = 0;
  const auto done = exportCatalogue(file(), home_ / "out", [&](const ExportProgress& progress) {
    EXPECT_LE(progress.done, progress.total);
    ++steps;
  });
  ASSERT_TRUE(done) << done.error().message();
  EXPECT_EQ(done->objects, 2);
  EXPECT_EQ(done->views, 3);
  EXPECT_GE(steps, 3);
  EXPECT_TRUE(done->skipped.empty());
  const Json index = Json::parse(readText(home_ / "out" / "objects.json"));
  ASSERT_EQ(index.size(), 2U);
  EXPECT_EQ(index[0]["name"], "a/b: \"mug\"");
  EXPECT_EQ(index[0]["id"], first_.value);
  EXPECT_EQ(index[0]["views"], 2);
  EXPECT_EQ(index[0]["named_by_person"], true);
  const std::string folder = index[0]["folder"];
  EXPECT_EQ(folder.find('/'), std::string::npos);
  EXPECT_THAT(folder, testing::AllOf(HasSubstr("000001_"), HasSubstr("mug")));
  EXPECT_EQ(index[1]["name"], "Obj_2");

  const fs::path views = home_ / "out" / folder;
  const ObjectView written = randomView(1);
  EXPECT_TRUE(sameImage(image(views / "000001.color.png"), written.color));
  EXPECT_TRUE(sameImage(image(views / "000001.mask.png"), written.mask));
  EXPECT_TRUE(sameImage(image(views / "000001.depth.png"), written.depth_mm));
  const Json view = Json::parse(readText(views / "000001.json"));
  for (int i = 0; i < 16; ++i)
    EXPECT_NEAR(view["T_world_camera"][static_cast<std::size_t>(i / 4)][static_cast<std::size_t>(i % 4)]
                    .get<double>(),
                written.T_world_camera.matrix()(i / 4, i % 4), 1e-12);
  EXPECT_EQ(view["camera"]["fx"], 500);
  EXPECT_EQ(view["box_px"], (Json{1, 20, 40, 30}));
  EXPECT_EQ(view["crop_camera"]["width"], 31) << "the width of the stored crop";
  EXPECT_NEAR(view["crop_camera"]["fx"].get<double>(), 500 * 31 / 40.0, 1e-3);
  EXPECT_NEAR(view["crop_camera"]["cx"].get<double>(), (320 - 1 + 0.5) * 31 / 40 - 0.5, 1e-3);
  const Json other =
      Json::parse(readText(home_ / "out" / index[1]["folder"].get<std::string>() / "000003.json"));
  EXPECT_TRUE(other["camera"].is_null()) << "the view has no session";
}

TEST_F(ExportCatalogueTest, LeavesTheCatalogueUnchanged) {
  const std::set<std::string> before = allFiles();
  const std::string bytes = readText(file());
  ASSERT_TRUE(exportCatalogue(file(), home_ / "out"));
  EXPECT_EQ(readText(file()), bytes);
  fs::remove_all(home_ / "out");
  EXPECT_EQ(allFiles(), before);
}

TEST_F(ExportCatalogueTest, Succeeds_WhileAnotherProgramHasTheCatalogueOpen) {
  const auto other = openOrFail(file());
  ASSERT_TRUE(other->rename(second_, "box"));
  const auto done = exportCatalogue(file(), home_ / "out");
  ASSERT_TRUE(done) << done.error().message();
  EXPECT_THAT(readText(home_ / "out" / "objects.json"), HasSubstr("\"box\"")) << "the latest name";
}

TEST_F(ExportCatalogueTest, Restarts_WhenAnotherProgramWrites) {
  std::unique_ptr<ObjectDatabase> other;
  const auto done = exportCatalogue(file(), home_ / "out", [&](const ExportProgress&) {
    if (other) return;
    other = openOrFail(file());
    EXPECT_TRUE(other->rename(second_, "box"));
  });
  ASSERT_TRUE(done) << done.error().message();
  EXPECT_EQ(done->objects, 2);
  EXPECT_THAT(readText(home_ / "out" / "objects.json"), HasSubstr("\"box\""));
}

TEST_F(ExportCatalogueTest, WritesNothing_WhenCancelledOrRefused) {
  std::stop_source stop;
  const auto cancelled = exportCatalogue(
      file(), home_ / "out", [&](const ExportProgress&) { stop.request_stop(); }, stop.get_token());
  ASSERT_FALSE(cancelled);
  EXPECT_THAT(cancelled.error().what, HasSubstr("cancelled"));
  EXPECT_EQ(allFiles(), std::set<std::string>{file()});

  static_cast<void>(home_.write("full/file", "x"));
  EXPECT_THAT(exportCatalogue(file(), home_ / "full").error().message(), HasSubstr("not empty"));
  EXPECT_THAT(exportCatalogue((home_ / "none").string(), home_ / "out").error().message(),
              HasSubstr("no database"));
  { openOrFail((home_ / "empty.sqlite").string()); }
  EXPECT_THAT(exportCatalogue((home_ / "empty.sqlite").string(), home_ / "out").error().message(),
              HasSubstr("nothing to export"));
  EXPECT_FALSE(fs::exists(home_ / "out"));
}

}  // namespace
}  // namespace scantrove
