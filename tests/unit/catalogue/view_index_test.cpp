#include "core/catalogue/view_index.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <random>

namespace scantrove {
namespace {

constexpr ViewIndex::Limits kLimits{0.35F, 0.5F, 16};

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
    index_.append(object, picture(seed), size(seed));
  }
  std::vector<int> shortlist(unsigned seed) {
    const Thumbnail thumbnail = picture(seed);
    return index_.shortlist({thumbnail, size(seed)}, kLimits);
  }
  ViewIndex index_;
};

// Expected by definition: size and colour agree, and the view's object is visible.
TEST_F(ViewIndexTest, ReturnsAllViewsOfSimilarSizeAndColor_WhenTheyAreFew) {
  constexpr unsigned kViews = ViewIndex::kFewViews - 1;
  for (unsigned seed = 0; seed < kViews; ++seed) append(seed);
  index_.setMergeRoot({ObjectId{4}, {}});
  for (unsigned query = 0; query < 40; ++query) {
    std::vector<int> expected;
    for (unsigned view = 0; view < kViews; ++view) {
      const float color = (picture(query).mean_lab - picture(view).mean_lab).squaredNorm() / (40 * 40);
      const float a = size(query).norm(), b = size(view).norm();
      if (color < kLimits.max_distance && std::abs(a - b) <= kLimits.size_tolerance * std::max(a, b) &&
          view / 2 + 1 != 4) {
        expected.push_back(static_cast<int>(view));
      }
    }
    std::vector<int> found = shortlist(query);
    std::ranges::sort(found);
    EXPECT_EQ(found, expected) << "query " << query;
  }
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
    const std::vector<int> nearest_views = index_.shortlist({query, size(view)}, kLimits);
    EXPECT_EQ(nearest_views.size(), static_cast<std::size_t>(kLimits.shortlist));
    int nearest = -1;
    float least = 1e30F;
    for (unsigned other = 0; other < kViews; ++other) {
      const float color = (query.mean_lab - pictures[other].mean_lab).squaredNorm() / (40 * 40);
      if (size(other) != size(view) || color >= kLimits.max_distance) continue;
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
