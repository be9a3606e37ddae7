#include "core/catalogue/thumbnail_matcher.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <optional>
#include <random>

#include "core/compute/device_choice.h"
#include "tests/reference/thumbnail_matching.h"

namespace scantrove {
namespace {

// Kernel and reference divide equal integers; OpenCL allows 2.5 ulp of error.
constexpr float kTolerance = 2e-6F;

/// Smooth blobs on a background of 0, so that warps have an effect.
Thumbnail blobs(unsigned seed) {
  std::mt19937 random(seed);
  const auto draw = [&](float low, float high) {
    return low + (high - low) * static_cast<float>(random() % 10000) / 10000.0F;
  };
  Thumbnail thumbnail;
  for (std::size_t c = 0; c < 3; ++c) {
    std::array<float, 32 * 32> plane{};
    for (int blob = 0; blob < 6; ++blob) {
      const float x0 = draw(4, 28), y0 = draw(4, 28), size = draw(2, 7), height = draw(-90, 90);
      for (int y = 0; y < 32; ++y) {
        for (int x = 0; x < 32; ++x) {
          const float dx = static_cast<float>(x) - x0, dy = static_cast<float>(y) - y0;
          plane[static_cast<std::size_t>(y * 32 + x)] +=
              height * std::exp(-(dx * dx + dy * dy) / (2 * size * size));
        }
      }
    }
    for (std::size_t i = 0; i < plane.size(); ++i) {
      thumbnail.fine[c * 1024 + i] = static_cast<std::int8_t>(std::clamp(plane[i], -127.0F, 127.0F));
    }
  }
  fillCoarse(thumbnail);
  return thumbnail;
}

Thumbnail extremes(unsigned seed) {
  std::mt19937 random(seed);
  Thumbnail thumbnail;
  for (std::int8_t& value : thumbnail.fine) value = random() % 2 == 0 ? std::int8_t{127} : std::int8_t{-127};
  fillCoarse(thumbnail);
  return thumbnail;
}

/// `source` mirrored about the vertical axis and moved by (dx, dy); uncovered pixels are 0.
Thumbnail moved(const Thumbnail& source, int dx, int dy, bool mirror) {
  Thumbnail result;
  for (int c = 0; c < 3; ++c) {
    for (int y = 0; y < 32; ++y) {
      for (int x = 0; x < 32; ++x) {
        const int u = mirror ? 31 - x + dx : x - dx, v = y - dy;
        if (u < 0 || v < 0 || u > 31 || v > 31) continue;
        result.fine[static_cast<std::size_t>((c * 32 + y) * 32 + x)] =
            source.fine[static_cast<std::size_t>((c * 32 + v) * 32 + u)];
      }
    }
  }
  fillCoarse(result);
  return result;
}

class ThumbnailMatcherTest : public testing::TestWithParam<int> {
 protected:
  void SetUp() override {
    auto compute = ComputeContext::create({.device = std::to_string(GetParam())});
    ASSERT_TRUE(compute) << compute.error().message();
    compute_ = std::move(*compute);
    auto matcher = ThumbnailMatcher::create(*compute_);
    ASSERT_TRUE(matcher) << matcher.error().message();
    matcher_.emplace(std::move(*matcher));
  }
  std::unique_ptr<ComputeContext> compute_;
  std::optional<ThumbnailMatcher> matcher_;
};

TEST_P(ThumbnailMatcherTest, EqualsTheReference) {
  std::vector<Thumbnail> views, queries;
  for (unsigned i = 0; i < 13; ++i) views.push_back(blobs(i));
  views.push_back(extremes(1));
  views.push_back(Thumbnail{});
  for (unsigned i = 10; i < 13; ++i) queries.push_back(blobs(i));
  queries.push_back(extremes(2));
  queries.push_back(moved(views[3], 2, -1, false));
  queries.push_back(Thumbnail{});
  for (const Thumbnail& view : views) matcher_->append(view);
  std::vector<ThumbnailMatcher::Pair> pairs;
  for (int q = 0; q < static_cast<int>(queries.size()); ++q) {
    for (int v = static_cast<int>(views.size()) - 1; v >= 0; --v) pairs.push_back({q, v});
  }
  const std::vector<float> distances = matcher_->distances(queries, pairs);
  ASSERT_EQ(distances.size(), pairs.size());
  for (std::size_t i = 0; i < pairs.size(); ++i) {
    const reference::ThumbnailMatching expected(queries[static_cast<std::size_t>(pairs[i].query)],
                                                views[static_cast<std::size_t>(pairs[i].view)]);
    EXPECT_NEAR(distances[i], expected.distance(), kTolerance) << pairs[i].query << " " << pairs[i].view;
  }
}

TEST_P(ThumbnailMatcherTest, DistanceIsSmall_WhenMirroredOrMoved) {
  const Thumbnail view = blobs(5);
  matcher_->append(view);
  const std::vector<Thumbnail> queries = {view,
                                          moved(view, 2, -2, false),
                                          moved(view, -3, 3, false),
                                          moved(view, 0, 0, true),
                                          moved(view, -2, 1, true),
                                          blobs(6)};
  const std::vector<float> distances =
      matcher_->distances(queries, {{0, 0}, {1, 0}, {2, 0}, {3, 0}, {4, 0}, {5, 0}});
  EXPECT_EQ(distances[0], 0);
  EXPECT_EQ(distances[3], 0);
  // Pixels moved out of the thumbnail are lost.
  for (const int i : {1, 2, 4}) EXPECT_LT(distances[static_cast<std::size_t>(i)], 0.12F) << i;
  EXPECT_GT(distances[5], 0.5F);
}

TEST_P(ThumbnailMatcherTest, DistanceIsTwo_BetweenEmptyThumbnails) {
  matcher_->append(Thumbnail{});
  EXPECT_EQ(matcher_->distances({Thumbnail{}}, {{0, 0}}), std::vector<float>{2.0F});
  EXPECT_TRUE(matcher_->distances({blobs(1)}, {}).empty());
}

TEST_P(ThumbnailMatcherTest, KeepsPositions_WhenItGrows) {
  constexpr unsigned kViews = 600;
  std::vector<Thumbnail> views;
  for (unsigned i = 0; i < kViews; ++i) views.push_back(blobs(i));
  const auto expectAt = [&](int position, unsigned seed) {
    EXPECT_EQ(matcher_->distances({views[seed]}, {{0, position}}), std::vector<float>{0.0F}) << position;
  };
  for (unsigned i = 0; i < kViews; ++i) {
    matcher_->append(views[i]);
    if (i == 10 || i == 300) expectAt(static_cast<int>(i), i);  // in the middle of a batch
  }
  EXPECT_EQ(matcher_->size(), static_cast<int>(kViews));
  for (const unsigned i : {0U, 11U, 63U, 64U, 255U, 256U, 301U, 511U, 512U, kViews - 1}) {
    expectAt(static_cast<int>(i), i);
  }
  matcher_->clear();
  matcher_->append(views[7]);
  expectAt(0, 7);
  matcher_->reserve(5000);
  matcher_->append(views[8]);
  expectAt(0, 7);
  expectAt(1, 8);
}

std::vector<int> allDevices() {
  std::vector<int> indices;
  for (const DeviceInfo& device : listDevices()) indices.push_back(device.index);
  return indices;
}

INSTANTIATE_TEST_SUITE_P(Devices, ThumbnailMatcherTest, testing::ValuesIn(allDevices()));
GTEST_ALLOW_UNINSTANTIATED_PARAMETERIZED_TEST(ThumbnailMatcherTest);

}  // namespace
}  // namespace scantrove
