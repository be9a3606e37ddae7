#include "core/catalogue/view_sketches.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <random>
#include <set>

#include "core/catalogue/match_distance.h"
#include "core/catalogue/view_index.h"

namespace scantrove {
namespace {

/// A smooth random picture of 4 x 4 cells with few colours, different for each seed.
ViewDescriptor sketchedView(unsigned seed) {
  std::mt19937 random(seed);
  ViewDescriptor view;
  for (int c = 0; c < 3; ++c) {
    std::array<int, 16> cells{};
    for (int& cell : cells) cell = static_cast<int>(random() % 160) - 80;
    for (int i = 0; i < Thumbnail::kPixels; ++i) {
      const int cell = i / Thumbnail::kSide / 8 * 4 + i % Thumbnail::kSide / 8;
      view.thumbnail.fine[static_cast<std::size_t>(c * Thumbnail::kPixels + i)] =
          static_cast<std::int8_t>(cells[static_cast<std::size_t>(cell)]);
    }
    view.thumbnail.mean_lab[c] = static_cast<float>(random() % 60);
  }
  fillCoarse(view.thumbnail);
  ViewColors colors;
  for (int i = 0; i < 12; ++i)
    colors.roots[random() % ViewColors::kBins] = static_cast<std::uint8_t>(20 + random() % 100);
  view.colors = colors;
  return view;
}

Eigen::Vector3f sketchedSize(unsigned seed) {
  std::mt19937 random(seed);
  const float side_m = 0.05F + 0.01F * static_cast<float>(random() % 40);
  return {side_m, 0.8F * side_m, 0.6F * side_m};
}

/// Another view of the same thing: noise in the picture, other shares of the colours, another size.
ViewDescriptor nextView(const ViewDescriptor& view, unsigned seed) {
  std::mt19937 random(seed);
  ViewDescriptor next = view;
  for (std::int8_t& value : next.thumbnail.fine)
    value = static_cast<std::int8_t>(std::clamp(value + static_cast<int>(random() % 61) - 30, -127, 127));
  fillCoarse(next.thumbnail);
  for (std::uint8_t& root : next.colors->roots) {
    if (root > 0) root = static_cast<std::uint8_t>(root / 2 + random() % root);
  }
  return next;
}

ViewDescriptor mirroredView(const ViewDescriptor& view) {
  ViewDescriptor mirrored = view;
  for (std::size_t i = 0; i < view.thumbnail.fine.size(); ++i) {
    const std::size_t x = i % Thumbnail::kSide;
    mirrored.thumbnail.fine[i] = view.thumbnail.fine[i - x + Thumbnail::kSide - 1 - x];
  }
  fillCoarse(mirrored.thumbnail);
  return mirrored;
}

ViewSketch sketchOfView(const ViewDescriptor& view, const Eigen::Vector3f& size_m) {
  return sketchOf(view.thumbnail.coarse, view.colors, size_m);
}

/// 2 sum (q - v)^2 / (sum q^2 + sum v^2) at 16 x 16, of the better of the view and its mirror image.
float unwarpedShape(const Thumbnail& a, const Thumbnail& b) {
  double straight = 0, mirrored = 0, energy = 0;
  for (std::size_t i = 0; i < a.coarse.size(); ++i) {
    const std::size_t x = i % Thumbnail::kCoarseSide;
    const int p = a.coarse[i], q = b.coarse[i], flipped = a.coarse[i - x + Thumbnail::kCoarseSide - 1 - x];
    straight += (p - q) * (p - q);
    mirrored += (flipped - q) * (flipped - q);
    energy += p * p + q * q;
  }
  return static_cast<float>(2 * std::min(straight, mirrored) / energy);
}

TEST(ViewSketch, HasOtherSignsInOddFrequenciesAlone_WhenMirrored) {
  const ViewDescriptor view = sketchedView(1);
  const ViewSketch straight = sketchOfView(view, {1, 1, 1});
  const ViewSketch mirrored = sketchOfView(mirroredView(view), {1, 1, 1});
  EXPECT_EQ(straight.length, mirrored.length);
  for (std::size_t k = 0; k < ViewSketch::kNumbers; ++k) {
    const bool is_odd = k >= ViewSketch::kEven && k < ViewSketch::kEven + ViewSketch::kOdd;
    // 1: pixels of the smaller picture are rounded half up, and the numbers are rounded.
    EXPECT_NEAR(mirrored.numbers[k], is_odd ? -straight.numbers[k] : straight.numbers[k], 40) << k;
  }
}

TEST(ViewSketch, SaysHowSizesDiffer) {
  const Eigen::Vector3f a_m(0.3F, 0.2F, 0.01F), b_m(0.2F, 0.15F, 0.1F);
  const ViewSketch a = sketchOfView(sketchedView(1), a_m), b = sketchOfView(sketchedView(1), b_m);
  float sum = 0;
  for (std::size_t i = 0; i < a.log_sizes.size(); ++i) sum += std::abs(a.log_sizes[i] - b.log_sizes[i]);
  EXPECT_NEAR(sum, sizeDifference(a_m, b_m), 1e-5);
  EXPECT_FALSE(sketchOfView(sketchedView(1), Eigen::Vector3f::Zero()).has_size);
}

TEST(ViewSketches, FindsNone_WhenEmpty) {
  const ViewSketches views;
  EXPECT_TRUE(views.nearest(sketchOfView(sketchedView(1), {1, 1, 1}), 10, [](int) { return true; }).empty());
}

// The distance of a sketch is that of fewer numbers, so it is never larger; and it is zero for the view.
TEST(ViewSketches, DistanceIsAtMostThatOfTheViews) {
  ViewSketches views;
  constexpr int kViews = 100;  // the last block is not full
  for (unsigned i = 0; i < kViews; ++i) views.append(sketchOfView(sketchedView(i), sketchedSize(i)));
  ASSERT_EQ(views.size(), kViews);
  for (unsigned query = 0; query < kViews; query += 7) {
    const ViewDescriptor asked = sketchedView(query);
    const auto found =
        views.nearest(sketchOfView(asked, sketchedSize(query)), kViews, [](int) { return true; });
    ASSERT_EQ(std::ssize(found), kViews);
    for (const ViewSketches::Near& one : found) {
      const ViewDescriptor view = sketchedView(static_cast<unsigned>(one.place));
      ViewDifference difference;
      difference.shape = unwarpedShape(asked.thumbnail, view.thumbnail);
      difference.colors = colorDistance(*asked.colors, *view.colors);
      difference.size = sizeDifference(sketchedSize(query), sketchedSize(static_cast<unsigned>(one.place)));
      constexpr float kRounding = 0.02F;  // of 16-bit products
      EXPECT_LE(one.shape, difference.shape + kRounding);
      EXPECT_LE(one.distance, matchDistance(difference) + kRounding);
      if (one.place == static_cast<int>(query)) {
        EXPECT_NEAR(one.distance, 0, kRounding);
      }
    }
  }
}

TEST(ViewSketches, KeepsTheNearest_WhenOnlySomeCount) {
  ViewSketches views;
  for (unsigned i = 0; i < 3000; ++i) views.append(sketchOfView(sketchedView(i), sketchedSize(i)));
  const auto isEven = [](int place) { return place % 2 == 0; };
  const ViewSketch query = sketchOfView(sketchedView(77), sketchedSize(77));
  const auto all = views.nearest(query, 3000, isEven), few = views.nearest(query, 20, isEven);
  ASSERT_EQ(all.size(), 1500U);
  ASSERT_EQ(few.size(), 20U);
  std::vector<float> expected, found;
  std::vector<int> places;
  for (const ViewSketches::Near& one : all) expected.push_back(one.distance);
  for (const ViewSketches::Near& one : few) {
    found.push_back(one.distance);
    places.push_back(one.place);
    EXPECT_TRUE(isEven(one.place));
  }
  std::ranges::sort(expected);
  std::ranges::sort(found);
  expected.resize(20);
  EXPECT_EQ(found, expected);
  std::ranges::sort(places);
  const auto at = views.at(query, places);
  ASSERT_EQ(at.size(), places.size());
  for (std::size_t i = 0; i < at.size(); ++i) EXPECT_EQ(at[i].place, places[i]);
}

class ManyViewsTest : public testing::Test {
 protected:
  void append(ObjectId object, const ViewDescriptor& view, const Eigen::Vector3f& size_m) {
    index_.setMergeRoot({object, object});
    index_.append(object, view, size_m);
    all_.push_back({object, view, size_m});
  }
  [[nodiscard]] std::vector<int> shortlist(const ViewDescriptor& view, const Eigen::Vector3f& size_m) {
    return index_.shortlist({view, size_m}, 16);
  }
  [[nodiscard]] float distance(const ViewDescriptor& query, const Eigen::Vector3f& size_m, int place) const {
    const Stored& view = all_[static_cast<std::size_t>(place)];
    ViewDifference difference;
    difference.shape = unwarpedShape(query.thumbnail, view.view.thumbnail);
    difference.colors = colorDistance(*query.colors, *view.view.colors);
    difference.size = sizeDifference(size_m, view.size_m);
    return matchDistance(difference);
  }
  /// The nearest object of those that have these views.
  [[nodiscard]] ObjectId nearest(const ViewDescriptor& query, const Eigen::Vector3f& size_m,
                                 const std::vector<int>& places) const {
    std::map<ObjectId, std::vector<float>> of_views;
    for (const int place : places)
      of_views[index_.mergeRootAt(place)].push_back(distance(query, size_m, place));
    ObjectId best;
    float least = 1e9F;
    for (const auto& [object, distances] : of_views) {
      const float of_object = objectDistance(distances);
      if (of_object >= least) continue;
      least = of_object;
      best = object;
    }
    return best;
  }

  struct Stored {
    ObjectId object;
    ViewDescriptor view;
    Eigen::Vector3f size_m;
  };
  ViewIndex index_;
  std::vector<Stored> all_;
};

// Half of the queries show objects of the catalogue, the others do not.
TEST_F(ManyViewsTest, NearestObjectIsThatOfAllViews) {
  constexpr unsigned kObjects = 1000, kViewsOfEach = 5, kQueries = 60;
  for (unsigned i = 0; i < kObjects * kViewsOfEach; ++i)
    append(ObjectId{i % kObjects + 1}, nextView(sketchedView(i % kObjects), i), sketchedSize(i % kObjects));
  std::vector<int> places(all_.size());
  for (std::size_t i = 0; i < places.size(); ++i) places[i] = static_cast<int>(i);
  unsigned same = 0;
  for (unsigned i = 0; i < kQueries; ++i) {
    const unsigned seed = i % 2 == 0 ? i * 9 : kObjects + i;
    const ViewDescriptor query = nextView(sketchedView(seed), 100000 + i);
    const Eigen::Vector3f size_m = sketchedSize(seed);
    const std::vector<int> views = shortlist(query, size_m);
    EXPECT_EQ(views.size(), 16U);
    const ObjectId expected = nearest(query, size_m, places);
    same += nearest(query, size_m, views) == expected ? 1 : 0;
    if (i % 2 == 0) {
      EXPECT_EQ(expected, ObjectId{seed + 1});
      EXPECT_EQ(nearest(query, size_m, views), expected);
    }
  }
  // Strangers have many objects that are equally far.
  EXPECT_GE(same, kQueries / 2);
}

TEST_F(ManyViewsTest, FollowsAdditionsAndRemovals) {
  for (unsigned i = 0; i < ViewIndex::kManyViews + 100; ++i)
    append(ObjectId{i + 1}, sketchedView(i), sketchedSize(i));
  const ViewDescriptor added = sketchedView(9000);
  EXPECT_NE(index_.mergeRootAt(shortlist(added, sketchedSize(9000)).front()), ObjectId{9001});
  append(ObjectId{9001}, added, sketchedSize(9000));
  EXPECT_EQ(index_.mergeRootAt(shortlist(added, sketchedSize(9000)).front()), ObjectId{9001});
  index_.setMergeRoot({ObjectId{9001}, {}});
  for (const int place : shortlist(added, sketchedSize(9000))) EXPECT_NE(place, index_.size() - 1);
  index_.setMergeRoot({ObjectId{9001}, ObjectId{3}});
  EXPECT_EQ(index_.mergeRootAt(shortlist(added, sketchedSize(9000)).front()), ObjectId{3});
}

TEST_F(ManyViewsTest, ShowsOtherObjects_WhenOneHasNearlyAllViews) {
  constexpr int kOthers = 12;
  for (unsigned i = 0; i < ViewIndex::kManyViews + 600; ++i)
    append(ObjectId{1}, nextView(sketchedView(1), i), sketchedSize(1));
  for (unsigned i = 0; i < kOthers; ++i) append(ObjectId{i + 2}, sketchedView(i + 2), sketchedSize(i + 2));
  std::set<ObjectId> objects;
  for (const int place : shortlist(sketchedView(1), sketchedSize(1)))
    objects.insert(index_.mergeRootAt(place));
  EXPECT_GE(std::ssize(objects), kObjectsToCompare);
}

TEST_F(ManyViewsTest, ShortlistIsEmpty_WhenAllAreDeleted) {
  for (unsigned i = 0; i < ViewIndex::kManyViews + 10; ++i)
    append(ObjectId{1}, sketchedView(i), sketchedSize(i));
  index_.setMergeRoot({ObjectId{1}, {}});
  EXPECT_TRUE(shortlist(sketchedView(1), sketchedSize(1)).empty());
}

TEST_F(ManyViewsTest, BoundsTheViewsOfRoots) {
  std::vector<ObjectId> roots;
  for (unsigned i = 0; i < ViewIndex::kManyViews + 100; ++i) {
    append(ObjectId{i + 1}, sketchedView(i), {0.2F, 0.2F, 0.2F});
    roots.push_back(ObjectId{i + 1});
  }
  const ViewDescriptor query = sketchedView(42);
  const std::vector<int> views = index_.viewsOf(roots, {query, {0.2F, 0.2F, 0.2F}}, {0.35F, 1e9F});
  EXPECT_EQ(views.size(), ViewIndex::kMostOfRoots);
  EXPECT_TRUE(std::ranges::is_sorted(views));
  EXPECT_TRUE(std::ranges::binary_search(views, 42));
}

}  // namespace
}  // namespace scantrove
