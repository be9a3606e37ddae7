#include "core/catalogue/view_index.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <random>

namespace scantrove {
namespace {

constexpr int kShortlist = 16;

/// A smooth random picture, different for each seed.
Thumbnail picture(unsigned seed) {
  std::mt19937 random(seed);
  Thumbnail thumbnail;
  for (int c = 0; c < 3; ++c) {
    std::array<int, 16> cells{};
    for (int& cell : cells) cell = static_cast<int>(random() % 200) - 100;
    for (int i = 0; i < Thumbnail::kPixels; ++i) {
      const int cell = i / Thumbnail::kSide / 8 * 4 + i % Thumbnail::kSide / 8;
      thumbnail.fine[static_cast<std::size_t>(c * Thumbnail::kPixels + i)] =
          static_cast<std::int8_t>(cells[static_cast<std::size_t>(cell)] + static_cast<int>(random() % 7));
    }
    thumbnail.mean_lab[c] = static_cast<float>(random() % 20);
  }
  fillCoarse(thumbnail);
  return thumbnail;
}

Eigen::Vector3f size(unsigned seed) {
  return Eigen::Vector3f(0.1F, 0.1F, 0.1F) * static_cast<float>(1 + seed % 3);
}

class ViewIndexTest : public testing::Test {
 protected:
  /// View `seed` of object seed / 2 + 1.
  void append(unsigned seed) {
    const ObjectId object{seed / 2 + 1};
    index_.setMergeRoot({object, object});
    index_.append(object, {picture(seed)}, size(seed));
  }
  std::vector<int> shortlist(unsigned seed) {
    const ViewDescriptor descriptor{picture(seed)};
    return index_.shortlist({descriptor, size(seed)}, kShortlist);
  }
  ViewIndex index_;
};

TEST_F(ViewIndexTest, ReturnsAllViewsWithAnOwner_WhenTheyAreFew) {
  constexpr unsigned kViews = ViewIndex::kFewViews - 1;
  for (unsigned seed = 0; seed < kViews; ++seed) append(seed);
  index_.setMergeRoot({ObjectId{4}, {}});
  std::vector<int> expected;
  for (unsigned view = 0; view < kViews; ++view) {
    if (view / 2 + 1 != 4) expected.push_back(static_cast<int>(view));
  }
  std::vector<int> found = shortlist(20);
  std::ranges::sort(found);
  EXPECT_EQ(found, expected);
}

TEST_F(ViewIndexTest, CountsObjectsWithViews) {
  EXPECT_EQ(index_.countObjects(10), 0);
  for (unsigned seed = 0; seed < 8; ++seed) append(seed);
  EXPECT_EQ(index_.countObjects(10), 4);
  EXPECT_EQ(index_.countObjects(3), 3);
  index_.setMergeRoot({ObjectId{4}, ObjectId{1}});
  EXPECT_EQ(index_.countObjects(10), 3) << "two are merged";
  index_.setMergeRoot({ObjectId{2}, {}});
  EXPECT_EQ(index_.countObjects(10), 2) << "one is deleted";
}

TEST_F(ViewIndexTest, ReturnsSeveralObjects_WhenOneHasManyViews) {
  for (unsigned seed = 0; seed < 100; ++seed) append(seed);
  for (int copy = 0; copy < 40; ++copy) index_.append(ObjectId{11}, {picture(20)}, size(20));
  const std::vector<int> views = shortlist(20);
  EXPECT_EQ(std::ssize(views), kShortlist);
  std::map<ObjectId, int> views_of;
  for (const int view : views) ++views_of[index_.mergeRootAt(view)];
  EXPECT_EQ(views_of[ObjectId{11}], ViewIndex::kViewsOfAnObject);
  for (const auto& [object, count] : views_of) EXPECT_LE(count, ViewIndex::kViewsOfAnObject);
}

TEST_F(ViewIndexTest, PrefersTheSizeThatFits) {
  for (unsigned seed = 0; seed < 100; ++seed) append(seed);
  const ObjectId small{1000}, large{1001};
  for (const ObjectId object : {small, large}) index_.setMergeRoot({object, object});
  index_.append(large, {picture(500)}, 3 * size(500));
  index_.append(small, {picture(500)}, size(500));
  const ViewDescriptor descriptor{picture(500)};
  EXPECT_EQ(index_.mergeRootAt(index_.shortlist({descriptor, size(500)}, kShortlist).front()), small);
  EXPECT_EQ(index_.mergeRootAt(index_.shortlist({descriptor, 3 * size(500)}, kShortlist).front()), large);
}

TEST_F(ViewIndexTest, SaysWhatDiffers) {
  ViewDescriptor stored{picture(1)}, query{picture(2)};
  stored.colors.emplace().roots[5] = 255;
  query.colors.emplace().roots[6] = 255;
  index_.append(ObjectId{1}, stored, {0.3F, 0.3F, 0.3F});
  index_.append(ObjectId{1}, {picture(1)}, Eigen::Vector3f::Zero());
  const ViewDifference with = index_.difference({query, {0.1F, 0.1F, 0.1F}}, 0);
  const Eigen::Vector3f mean = picture(1).mean_lab - picture(2).mean_lab;
  EXPECT_FLOAT_EQ(with.mean_color, mean.squaredNorm() / (40 * 40));
  ASSERT_TRUE(with.colors);
  EXPECT_EQ(*with.colors, 1);
  EXPECT_NEAR(with.size, std::log(3.0), 1e-5);
  EXPECT_FALSE(index_.hasSize({query, {0.1F, 0.1F, 0.1F}}, 0, 0.35F));
  EXPECT_TRUE(index_.hasSize({query, {0.2F, 0.2F, 0.2F}}, 0, 0.35F));
  EXPECT_TRUE(index_.hasSize({query, {0.1F, 0.1F, 0.1F}}, 1, 0.35F)) << "the view's size is unknown";
  const ViewDifference without = index_.difference({query, {0.1F, 0.1F, 0.1F}}, 1);
  EXPECT_FALSE(without.colors);
  EXPECT_EQ(without.size, 0) << "the view's size is unknown";
}

/// Smaller squared distance of `b` at 16 x 16 to `a` or to its mirror image.
float coarseDistance(const Thumbnail& a, const Thumbnail& b) {
  float straight = 0, mirrored = 0;
  for (int i = 0; i < 3 * Thumbnail::kCoarsePixels; ++i) {
    const int row = i / Thumbnail::kCoarseSide * Thumbnail::kCoarseSide;
    const int flipped = row + Thumbnail::kCoarseSide - 1 - i % Thumbnail::kCoarseSide;
    const auto at = [](const Thumbnail& t, int place) {
      return static_cast<float>(t.coarse[static_cast<std::size_t>(place)]);
    };
    straight += (at(a, i) - at(b, i)) * (at(a, i) - at(b, i));
    mirrored += (at(a, flipped) - at(b, i)) * (at(a, flipped) - at(b, i));
  }
  return std::min(straight, mirrored);
}

// More views than the components are fitted to. The nearest view in all 768 numbers must be among the 16
// nearest along 19 components.
TEST_F(ViewIndexTest, ReturnsTheNearestView_WhenThereAreMany) {
  constexpr unsigned kViews = 2600;
  std::vector<Thumbnail> pictures;
  for (unsigned seed = 0; seed < kViews; ++seed) pictures.push_back(picture(seed));
  for (unsigned seed = 0; seed < kViews; ++seed) {
    append(seed);
    if (seed == 70 || seed == 500) {
      EXPECT_EQ(shortlist(seed).front(), static_cast<int>(seed));
    }
  }
  int found = 0, asked = 0;
  for (unsigned view = 0; view < kViews; view += 65) {
    Thumbnail query = pictures[view];
    std::mt19937 random(view);
    for (std::int8_t& value : query.fine)
      value = static_cast<std::int8_t>(std::clamp(value + static_cast<int>(random() % 21) - 10, -127, 127));
    fillCoarse(query);
    const ViewDescriptor descriptor{query};
    const std::vector<int> nearest_views = index_.shortlist({descriptor, size(view)}, kShortlist);
    EXPECT_EQ(std::ssize(nearest_views), kShortlist);
    int nearest = -1;
    float least = 1e30F;
    for (unsigned other = 0; other < kViews; ++other) {
      if (size(other) != size(view)) continue;
      const float distance = coarseDistance(query, pictures[other]);
      if (distance < least) {
        least = distance;
        nearest = static_cast<int>(other);
      }
    }
    ++asked;
    found += std::ranges::find(nearest_views, nearest) != nearest_views.end() ? 1 : 0;
  }
  EXPECT_EQ(found, asked);
}

TEST_F(ViewIndexTest, OmitsHiddenViews) {
  for (unsigned seed = 0; seed < 200; ++seed) append(seed);
  const std::vector<int> before = shortlist(42);
  ASSERT_EQ(before.front(), 42);
  index_.setMergeRoot({ObjectId{22}, {}});
  const std::vector<int> after = shortlist(42);
  EXPECT_EQ(after.size(), before.size());
  EXPECT_EQ(std::ranges::find(after, 42), after.end());
  index_.setMergeRoot({ObjectId{22}, ObjectId{7}});
  EXPECT_EQ(shortlist(42).front(), 42);
  EXPECT_EQ(index_.mergeRootAt(42), ObjectId{7});
}

}  // namespace
}  // namespace scantrove
