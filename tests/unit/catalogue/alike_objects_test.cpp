#include "core/catalogue/alike_objects.h"

#include <gmock/gmock.h>

#include <algorithm>
#include <opencv2/core.hpp>
#include <opencv2/imgproc.hpp>

namespace scantrove {
namespace {

using testing::ElementsAre;
using testing::IsEmpty;

constexpr ObjectId kMug{1}, kCopy{2}, kSecondCopy{3};

/// What a thing with this pattern looks like, with other noise for each view.
ViewDescriptor lookOf(int pattern, int view) {
  cv::RNG of_pattern(static_cast<std::uint64_t>(pattern) * 977 + 5);
  cv::Mat cells(5, 5, CV_8UC3);
  of_pattern.fill(cells, cv::RNG::UNIFORM, 20, 236);
  cv::Mat color;
  cv::resize(cells, color, {64, 64}, 0, 0, cv::INTER_CUBIC);
  cv::RNG of_view(static_cast<std::uint64_t>(view) + 1);
  cv::Mat noise(color.size(), CV_8UC3);
  of_view.fill(noise, cv::RNG::UNIFORM, 0, 6);
  color += noise;
  const auto descriptor = describeView(color, cv::Mat(64, 64, CV_8UC1, cv::Scalar(255)));
  EXPECT_TRUE(descriptor);
  return descriptor.value_or(ViewDescriptor{});
}

/// Object i has the pattern i, but the copies that of the mug.
class AlikeObjects : public testing::Test {
 protected:
  void SetUp() override {
    for (std::uint32_t id = 1; id <= 9; ++id) add(ObjectId{id}, id <= 3 ? 1 : static_cast<int>(id));
  }

  void add(ObjectId object, int pattern) {
    ObjectState state;
    state.id = object;
    state.name = "Obj_" + std::to_string(object.value);
    catalogue_.put(state);
    for (int view = 0; view < 3; ++view) {
      StoredDescriptor stored;
      stored.view = static_cast<std::int64_t>(views_.size()) + 1;
      stored.first_object = object;
      stored.size_m = {0.1F, 0.1F, 0.1F};
      stored.descriptor = lookOf(pattern, static_cast<int>(views_.size()));
      views_.push_back(std::move(stored));
    }
  }

  [[nodiscard]] std::vector<ObjectId> alikeTo(ObjectId object) const {
    std::vector<ObjectId> found;
    for (const AlikeObject& alike : findAlikeObjects(object, views_, catalogue_, different_))
      found.push_back(alike.object);
    return found;
  }

  std::vector<StoredDescriptor> views_;
  CatalogueModel catalogue_;
  std::set<ObjectPair> different_;
};

TEST_F(AlikeObjects, AreAllCopies_AlsoIfThereAreSeveral) {
  std::vector<ObjectId> found = alikeTo(kMug);
  std::ranges::sort(found);
  EXPECT_THAT(found, ElementsAre(kCopy, kSecondCopy));
  for (const AlikeObject& alike : findAlikeObjects(kMug, views_, catalogue_, different_))
    EXPECT_TRUE(alike.isVeryAlike()) << alike.distance;
}

TEST_F(AlikeObjects, AreNone_WhenThePatternIsItsOwn) { EXPECT_THAT(alikeTo(ObjectId{7}), IsEmpty()); }

TEST_F(AlikeObjects, LeaveOutWhatAUserCalledDifferent_AlsoAfterAMerge) {
  different_.insert({kMug, kCopy});
  EXPECT_THAT(alikeTo(kMug), ElementsAre(kSecondCopy));
  EXPECT_THAT(alikeTo(kCopy), ElementsAre(kSecondCopy));
  // A named thing takes the views of the copy, and stays different from the mug.
  ASSERT_TRUE(catalogue_.rename(ObjectId{8}, "tin", NamedBy::user));
  ASSERT_TRUE(catalogue_.merge(std::vector<ObjectId>{ObjectId{8}, kCopy}));
  EXPECT_THAT(alikeTo(kMug), ElementsAre(kSecondCopy));
}

TEST_F(AlikeObjects, CompareViewsWithTheirPresentOwner) {
  ASSERT_TRUE(catalogue_.merge(std::vector<ObjectId>{kMug, kCopy}));
  EXPECT_THAT(alikeTo(kMug), ElementsAre(kSecondCopy)) << "not itself";
  EXPECT_THAT(alikeTo(kSecondCopy), ElementsAre(kMug));
  ASSERT_TRUE(catalogue_.remove(std::vector<ObjectId>{kMug}));
  EXPECT_THAT(alikeTo(kSecondCopy), IsEmpty()) << "deleted";
}

TEST_F(AlikeObjects, AreNoThingsOfQuiteAnotherSize) {
  for (StoredDescriptor& view : views_) {
    if (view.first_object == kMug) view.size_m *= 6;
  }
  EXPECT_THAT(alikeTo(kMug), IsEmpty());
}

TEST_F(AlikeObjects, AreAtMostFive) {
  for (std::uint32_t id = 20; id < 30; ++id) add(ObjectId{id}, 1);
  EXPECT_EQ(alikeTo(kMug).size(), kMostAlike);
}

}  // namespace
}  // namespace scantrove
