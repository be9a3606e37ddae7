// Which regions are similar to a given one.
#include <gtest/gtest.h>

#include <opencv2/core.hpp>

#include "core/discovery/region_appearance.h"
#include "core/fusion/kernels/color_voxel.h"
#include "core/synthetic/bowls_and_boxes.h"
#include "core/synthetic/furniture.h"
#include "core/synthetic/placed_part.h"
#include "core/synthetic/scene_recipe.h"
#include "tests/support/synthetic_scan.h"

namespace scantrove {
namespace {

using test::SyntheticScan;

constexpr std::array kMugs{"mug A", "mug B"};
constexpr std::array kBooks{"book A", "book B", "book C"};

/// Two equal mugs and three equal books among other objects on a table.
synthetic::SceneRecipe makeEqualsScene() {
  using namespace synthetic;
  SyntheticScene scene;
  const auto floor = scene.addInstance("floor", false);
  addBox(scene, floor, {}, {5, 5, 0.1}, 0, {Pattern::planks, rgb(0xb08a63), {}, {}, 0.14F}, {0, 0, -0.1});
  addWall(scene, "wall, back", {0, 2.45, 0, 0}, 5, 0xdfe5e1);
  addTable(scene, {}, {1.25, 0.90, 0.72}, {Pattern::wood, rgb(0xd9b488)});
  const double z = 0.72;
  const Material mug{Pattern::stripes, rgb(0x3567a8), rgb(0xf1f1ee), {}, 0.022F, 0.45F};
  addMug(scene, kMugs[0], {-0.46, -0.28, z, -35}, mug);
  addMug(scene, kMugs[1], {0.40, 0.22, z, 70}, mug);
  const Material book{Pattern::bookCover, rgb(0x8c2f39), rgb(0xe9d8a6), rgb(0xd98f5c), 0.03F, 0, true, 5};
  addBook(scene, kBooks[0], {-0.40, 0.18, z, 15}, {0.16, 0.22, 0.04}, book);
  addBook(scene, kBooks[1], {0.05, -0.28, z, 80}, {0.16, 0.22, 0.04}, book);
  addBook(scene, kBooks[2], {0.42, -0.20, z, -40}, {0.16, 0.22, 0.04}, book);
  addCarton(scene, "cereal box", {0.07, 0.29, z, 12}, {0.17, 0.06, 0.25},
            {Pattern::boxLabel, rgb(0xf2b632), rgb(0xc8402f), rgb(0xfff4d8), 0.03F, 0.05F, true, 3});
  addBowl(scene, "bowl", {0.10, 0.03, z}, {Pattern::bands, rgb(0xd97b4a), rgb(0xf0d9b8), {}, 0.022F, 0.35F});
  addCan(scene, "can", {-0.16, -0.20, z, 40},
         {Pattern::canLabel, rgb(0xc9372c), rgb(0xf3ead3), rgb(0xf2a541), 0.03F, 0.25F});
  addVase(scene, "vase", {-0.14, 0.30, z}, {Pattern::bands, rgb(0x2f6f8f), rgb(0xe8eef0), {}, 0.032F, 0.35F});
  const auto path = [](double t) -> Gaze {
    const double azimuth = -1.9 + 0.35 * t;
    return {{0.87 * std::cos(azimuth), 0.87 * std::sin(azimuth), 1.27}, {0, 0, 0.76}};
  };
  return {.name = "equals",
          .scene = std::move(scene),
          .path = path,
          .frames = 180,
          .lit_center = {0, 0, 0.4},
          .lit_radius_m = 1.5};
}

/// The appearance of each region of the map with at least 200 points.
std::map<RegionId, RegionAppearance> appearancesOf(MappingPipeline& pipeline) {
  std::map<RegionId, std::vector<AppearancePoint>> points;
  const RegionTable& table = pipeline.labels().table();
  const auto done = pipeline.readout().forEachCloudPoint([&](const LabelPoint& point) {
    AppearancePoint colored{{point.x, point.y, point.z}, {}, COLOR_WEIGHT(point.color) > 0};
    colored.rgb = {static_cast<std::uint8_t>(COLOR_RED(point.color)),
                   static_cast<std::uint8_t>(COLOR_GREEN(point.color)),
                   static_cast<std::uint8_t>(COLOR_BLUE(point.color))};
    points[table.regionOf(FragmentId{point.fragment})].push_back(colored);
  });
  EXPECT_TRUE(done);
  std::map<RegionId, RegionAppearance> appearances;
  for (const auto& [region, all] : points) {
    if (region && all.size() >= 200) appearances[region] = appearanceOf(all);
  }
  return appearances;
}

class LikenessTest : public testing::Test {
 protected:
  static void SetUpTestSuite() {
    SyntheticOptions options;
    options.recipe = makeEqualsScene;
    options.stride = 2;
    scan_ = new SyntheticScan(options, {}, PoseUse::given);
    scan_->run();
    appearances_ = new std::map(appearancesOf(scan_->pipeline()));
  }
  static void TearDownTestSuite() {
    delete appearances_;
    delete scan_;
  }

  /// The region with most pixels of the instance over every 15th frame.
  static RegionId regionOf(const std::string& name) {
    const int instance = scan_->source().scene().find(name);
    std::map<int, int> pixels;
    for (std::size_t i = 0; i < scan_->frames.size(); i += 15) {
      const auto& frame = scan_->frames[i];
      const cv::Mat regions = scan_->finalRegions(frame);
      for (int p = 0; p < static_cast<int>(regions.total()); ++p) {
        if (frame.instances.ptr<int>()[p] == instance) ++pixels[regions.ptr<int>()[p]];
      }
    }
    pixels.erase(0);
    const auto most = std::ranges::max_element(pixels, {}, [](const auto& one) { return one.second; });
    return most == pixels.end() ? RegionId{} : RegionId{static_cast<std::uint32_t>(most->first)};
  }

  /// All other regions, most similar first.
  static std::vector<std::pair<float, RegionId>> rankedFor(RegionId region) {
    std::vector<std::pair<float, RegionId>> ranked;
    for (const auto& [other, appearance] : *appearances_) {
      if (other != region) ranked.emplace_back(likeness(appearances_->at(region), appearance), other);
    }
    std::ranges::sort(ranked, std::ranges::greater{}, [](const auto& one) { return one.first; });
    return ranked;
  }

  /// For each of the equal objects, the others rank first with a likeness above 0.75.
  template <std::size_t count>
  static void expectFirst(const std::array<const char*, count>& equals) {
    std::set<RegionId> regions;
    for (const char* name : equals) regions.insert(regionOf(name));
    ASSERT_EQ(regions.size(), count) << "each has its own region";
    for (const RegionId region : regions) {
      ASSERT_TRUE(appearances_->contains(region));
      const auto ranked = rankedFor(region);
      for (std::size_t i = 0; i < ranked.size() && i < count; ++i)
        std::cout << region.value << " ~ " << ranked[i].second.value << ": " << ranked[i].first << '\n';
      for (std::size_t i = 0; i + 1 < count; ++i) {
        EXPECT_TRUE(regions.contains(ranked[i].second)) << region.value;
        EXPECT_GT(ranked[i].first, 0.75F) << region.value;  // the limit of RegionProposals
      }
    }
  }

  static inline SyntheticScan* scan_ = nullptr;
  static inline std::map<RegionId, RegionAppearance>* appearances_ = nullptr;
};

// One test, because each test runs as its own process and scans again.
TEST_F(LikenessTest, EqualMugsAndBooksRankFirst) {
  expectFirst(kMugs);
  expectFirst(kBooks);
}

}  // namespace
}  // namespace scantrove
