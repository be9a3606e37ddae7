#include "core/base/latest_value.h"

#include <gtest/gtest.h>

#include <atomic>
#include <thread>

namespace scantrove {
namespace {

TEST(LatestValue, ReturnsTheNewestOnce) {
  LatestValue<int> box;
  EXPECT_TRUE(box.empty());
  EXPECT_EQ(box.collect(), nullptr);
  box.post(std::make_shared<const int>(1));
  box.post(std::make_shared<const int>(2));
  EXPECT_FALSE(box.empty());
  const auto newest = box.collect();
  ASSERT_NE(newest, nullptr);
  EXPECT_EQ(*newest, 2);
  EXPECT_TRUE(box.empty());
  EXPECT_EQ(box.collect(), nullptr);
}

TEST(LatestValue, ReleasesAValue_WhenItIsReplaced) {
  LatestValue<int> box;
  const auto first = std::make_shared<const int>(1);
  box.post(first);
  EXPECT_EQ(first.use_count(), 2);
  box.post(std::make_shared<const int>(2));
  EXPECT_EQ(first.use_count(), 1);
}

TEST(LatestValue, ReturnsValuesInOrderUpToTheLast_ToAnotherThread) {
  constexpr int kLast = 20000;
  LatestValue<int> box;
  std::atomic<bool> done{false};
  std::jthread writer([&] {
    for (int i = 1; i <= kLast; ++i) box.post(std::make_shared<const int>(i));
    done = true;
  });
  int seen = 0;
  while (true) {
    const bool was_done = done;
    if (const auto value = box.collect()) {
      ASSERT_GT(*value, seen);
      seen = *value;
    } else if (was_done) {
      break;
    } else {
      std::this_thread::yield();
    }
  }
  EXPECT_EQ(seen, kLast);
}

TEST(LatestValue, NeverReturnsAValueTwice_ToTwoReaders) {
  constexpr int kLast = 5000;
  LatestValue<int> box;
  std::atomic<int> collected{0};
  std::atomic<bool> done{false};
  std::atomic<int> returned_twice{0};
  std::vector<std::atomic<int>> times(kLast + 1);
  {
    const auto read = [&] {
      while (!done || !box.empty()) {
        if (const auto value = box.collect()) {
          ++collected;
          if (++times[static_cast<std::size_t>(*value)] > 1) ++returned_twice;
        }
      }
    };
    std::jthread a(read), b(read);
    for (int i = 1; i <= kLast; ++i) box.post(std::make_shared<const int>(i));
    done = true;
  }
  EXPECT_EQ(returned_twice, 0);
  EXPECT_GE(collected, 1);
  EXPECT_EQ(times.back(), 1);
}

}  // namespace
}  // namespace scantrove
