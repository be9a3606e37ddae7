// Pairing of two lists of times equals a full search, with memory linear in the lists.
#include <gtest/gtest.h>
#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <random>
#include <tuple>

#include "core/capture/time_association.h"

namespace scantrove {
namespace {

using Times = std::vector<double>;
using Pairs = std::vector<std::pair<std::size_t, std::size_t>>;

/// Reference: repeatedly takes the closest of all pairs.
Pairs pairsOfFullSearch(const Times& a, const Times& b, double tolerance_s) {
  std::vector<std::tuple<double, std::size_t, std::size_t>> candidates;
  for (std::size_t i = 0; i < a.size(); ++i) {
    for (std::size_t j = 0; j < b.size(); ++j) {
      if (b[j] >= a[i] - tolerance_s && b[j] <= a[i] + tolerance_s)
        candidates.emplace_back(std::abs(a[i] - b[j]), i, j);
    }
  }
  std::sort(candidates.begin(), candidates.end());
  std::vector<bool> used_a(a.size()), used_b(b.size());
  Pairs pairs;
  for (const auto& [distance, i, j] : candidates) {
    if (used_a[i] || used_b[j]) continue;
    used_a[i] = used_b[j] = true;
    pairs.emplace_back(i, j);
  }
  std::sort(pairs.begin(), pairs.end());
  return pairs;
}

/// Sorted times in steps of 5 ms, with many equal times and distances.
Times someTimes(std::mt19937& random, std::size_t count, int steps) {
  std::uniform_int_distribution<int> step(0, steps);
  Times times(count);
  for (double& time : times) time = 1305031229 + 0.005 * step(random);
  std::sort(times.begin(), times.end());
  return times;
}

TEST(TimeAssociation, ReturnsThePairsOfAFullSearch) {
  std::mt19937 random(7);
  for (int round = 0; round < 400; ++round) {
    const int steps = 1 + round % 40;
    const Times a = someTimes(random, static_cast<std::size_t>(round % 23), steps);
    const Times b = someTimes(random, static_cast<std::size_t>(round % 17), steps);
    ASSERT_EQ(associateTimes(a, b, 0.02), pairsOfFullSearch(a, b, 0.02)) << "round " << round;
  }
}

/// Peak memory of a process during the work, in MB.
long peakMegabytes(const std::function<void()>& work) {
  const pid_t child = ::fork();
  if (child == 0) {
    work();
    ::_exit(0);
  }
  int status = 0;
  rusage usage{};
  EXPECT_EQ(::wait4(child, &status, 0, &usage), child);
  EXPECT_TRUE(WIFEXITED(status) && WEXITSTATUS(status) == 0) << status;
  return usage.ru_maxrss / 1024;
}

TEST(TimeAssociation, NeedsLittleMemory_WhenManyTimesAreEqual) {
  constexpr std::size_t kCount = 3000;
  const auto pairAll = [](const Times& a, const Times& b) {
    return peakMegabytes([&] {
      if (associateTimes(a, b, 0.02).size() != std::min(a.size(), b.size())) ::_exit(1);
    });
  };
  const long idle = peakMegabytes([] {});
  const Times same(kCount, 1305031229.25), later(kCount, 1305031229.26);
  EXPECT_LT(pairAll(same, same) - idle, 100) << "MB";
  EXPECT_LT(pairAll(same, later) - idle, 100) << "MB";
  Times dense(kCount);
  for (std::size_t i = 0; i < kCount; ++i) dense[i] = 1e-6 * static_cast<double>(i);
  EXPECT_LT(pairAll(dense, dense) - idle, 100) << "MB";
}

}  // namespace
}  // namespace scantrove
