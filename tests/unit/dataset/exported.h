#pragma once
#include <gtest/gtest.h>

#include <filesystem>
#include <nlohmann/json.hpp>
#include <opencv2/imgcodecs.hpp>
#include <string>
#include <vector>

#include "core/dataset/dataset_export.h"
#include "core/dataset/export_record.h"
#include "tests/support/temporary_folder.h"
#include "tests/unit/dataset/scanned_scene.h"

namespace scantrove::test {

using Json = nlohmann::ordered_json;

/// A scene small enough for many exports.
struct SmallScene : ScannedScene {
  SmallScene() {
    K_depth = K_depth.resizedTo(80, 60);
    K_color = K_color.resizedTo(160, 120);
    frames = 2;
    faults.shift_m.setZero();  // one view of the map for each frame
  }
};

inline bool contains(const std::string& text, const std::string& part) {
  return text.find(part) != std::string::npos;
}

/// A scan exported to a temporary folder.
struct Exported {
  ScannedScene scene;
  TemporaryFolder home;
  ExportSummary summary;

  explicit Exported(DatasetFormat format, const std::function<void(ScannedScene&)>& change = {},
                    bool background = false) {
    // An error of a pose is corrected, and exported poses with it: see BopExport.CorrectsAnErrorOfThePose.
    scene.faults.shift_m.setZero();
    if (change) change(scene);
    const auto result =
        exportDataset(scene, {.format = format, .folder = home / "out", .background = background});
    EXPECT_TRUE(result) << (result ? "" : result.error().message());
    if (result) summary = *result;
  }

  [[nodiscard]] std::filesystem::path file(const std::string& name) const { return home / "out" / name; }
  [[nodiscard]] std::string text(const std::string& name) const {
    EXPECT_TRUE(std::filesystem::is_regular_file(file(name))) << name;
    return readText(file(name));
  }
  [[nodiscard]] Json json(const std::string& name) const { return Json::parse(text(name)); }
  [[nodiscard]] cv::Mat image(const std::string& name) const {
    return cv::imread(file(name).string(), cv::IMREAD_UNCHANGED);
  }
  /// All files but README.md, sorted.
  [[nodiscard]] std::vector<std::string> files() const {
    std::vector<std::string> names = filesIn(home / "out");
    EXPECT_EQ(std::erase(names, "README.md"), 1U);
    return names;
  }

  /// All files but the record of an export, sorted.
  static std::vector<std::string> filesIn(const std::filesystem::path& folder) {
    std::vector<std::string> names;
    for (const auto& entry : std::filesystem::recursive_directory_iterator(folder)) {
      if (entry.is_directory() || entry.path().filename() == ExportRecord::kFile) continue;
      names.push_back(entry.path().lexically_relative(folder).generic_string());
    }
    std::sort(names.begin(), names.end());
    return names;
  }
};

/// One export for all tests of a suite: rendering the scene takes a while.
#define SCANTROVE_EXPORTED_ONCE(Suite, format)                                 \
  class Suite : public testing::Test {                                         \
   protected:                                                                  \
    static void SetUpTestSuite() { shared_ = new test::Exported(format); }     \
    static void TearDownTestSuite() { delete shared_; }                        \
    [[nodiscard]] static const test::Exported& exported() { return *shared_; } \
    inline static test::Exported* shared_ = nullptr;                           \
  }

}  // namespace scantrove::test
