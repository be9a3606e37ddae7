#include "core/refinement/continued_background.h"

#include <gmock/gmock.h>

namespace scantrove {
namespace {

using testing::ElementsAre;
using testing::IsEmpty;

/// A table that a person marked, and more of it in two new regions: a support and a sheet of paper.
class ContinuedBackgroundTest : public testing::Test {
 protected:
  ContinuedBackgroundTest() {
    for (RegionId* const region : {&table_, &more_, &paper_})
      *region = regions_.regionOf(regions_.newFragment());
    RegionNote background;
    background.background = true;
    notes_.set(table_, background);
    setPixels(table_, {9000, 9000, 0});
    setPixels(more_, {9000, 9000, 0});
    setPixels(paper_, {9000, 0, 9000});
  }
  void setPixels(RegionId region, const SupportPixels& pixels) {
    regions_.addSupportPixels(regions_.fragmentsOf(region).front(), pixels);
  }
  [[nodiscard]] ContinuedBackground continued() const {
    return {{regions_, notes_, log_, labels_}, last_known_};
  }
  /// All regions side by side, each 20 cm wide; `more_` lies at `height_m`.
  [[nodiscard]] std::vector<RegionId> findAt(float height_m = 0) const {
    ContinuedBackground background = continued();
    for (int i = 0; i < 40; ++i) {
      for (int j = 0; j < 40; ++j) {
        const Eigen::Vector3f at(0.005F * static_cast<float>(i), 0.005F * static_cast<float>(j), 0);
        background.add(table_, at, Eigen::Vector3f::UnitZ());
        background.add(more_, at + Eigen::Vector3f(0.2F, 0, height_m), Eigen::Vector3f::UnitZ());
        background.add(paper_, at + Eigen::Vector3f(0, 0.2F, 0), Eigen::Vector3f::UnitZ());
      }
    }
    return background.find();
  }

  RegionTable regions_;
  RegionNotes notes_;
  OperationLog log_;
  std::map<RegionId, RegionLabel> labels_;
  RegionId table_, more_, paper_;
  RegionId last_known_{1};
};

TEST_F(ContinuedBackgroundTest, FindsNewSupportsInThePlaneOfAMarkedRegion) {
  ASSERT_TRUE(continued().mayFind());
  EXPECT_THAT(findAt(), ElementsAre(more_));
  EXPECT_THAT(findAt(0.1F), IsEmpty()) << "another table";
}

TEST_F(ContinuedBackgroundTest, FindsNothing_WithoutMarkedRegions) {
  notes_.set(table_, {});
  EXPECT_FALSE(continued().mayFind());
  EXPECT_THAT(findAt(), IsEmpty());
}

TEST_F(ContinuedBackgroundTest, LeavesRegionsOfEarlierScansAsTheyAre) {
  last_known_ = paper_;
  EXPECT_FALSE(continued().mayFind());
  EXPECT_THAT(findAt(), IsEmpty());
}

TEST_F(ContinuedBackgroundTest, LeavesObjectsAsTheyAre) {
  labels_[more_].is_object = true;
  EXPECT_THAT(findAt(), IsEmpty());
}

TEST_F(ContinuedBackgroundTest, LeavesEditedRegionsAsTheyAre) {
  Operation operation;
  operation.kind = OperationKind::background;
  operation.regions = {more_};
  log_.add(operation, {});
  ASSERT_NE(log_.undo(), nullptr);
  EXPECT_THAT(findAt(), IsEmpty()) << "a person took the mark back";
}

}  // namespace
}  // namespace scantrove
