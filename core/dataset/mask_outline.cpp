#include "core/dataset/mask_outline.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <opencv2/core.hpp>
#include <opencv2/imgproc.hpp>

namespace scantrove {
namespace {

using Ring = std::vector<cv::Point>;

constexpr double kMinPart = 0.02;
constexpr double kMinPart_px = 9;

/// Pixels inside a ring, including those on it (Pick's theorem).
double pixelsWithin(const Ring& ring) {
  const double area = cv::contourArea(ring);
  double steps = 0;
  for (std::size_t i = 0; i < ring.size(); ++i) {
    const cv::Point d = ring[(i + 1) % ring.size()] - ring[i];
    steps += std::max(std::abs(d.x), std::abs(d.y));
  }
  return area + steps / 2 + 1;
}

/// Pixels of the hole inside a ring; those on the ring do not belong to it.
double pixelsOfHole(const Ring& ring) {
  return std::max(1.0, 2 * cv::contourArea(ring) + 2 - pixelsWithin(ring));
}

struct Bridge {
  std::size_t from = 0, ring = 0, to = 0;
  int squared = std::numeric_limits<int>::max();
};

/// The shortest bridge from the outline to a ring that is not connected yet.
Bridge shortestBridge(const Ring& outline, const std::vector<Ring>& rings) {
  Bridge best;
  for (std::size_t r = 0; r < rings.size(); ++r) {
    for (std::size_t j = 0; j < rings[r].size(); ++j) {
      for (std::size_t i = 0; i < outline.size(); ++i) {
        const cv::Point d = outline[i] - rings[r][j];
        const int squared = d.dot(d);
        if (squared < best.squared) best = {i, r, j, squared};
      }
    }
  }
  return best;
}

/// Inserts the bridge, the ring, and the bridge back.
void join(Ring& outline, const Bridge& bridge, Ring ring) {
  std::rotate(ring.begin(), ring.begin() + static_cast<std::ptrdiff_t>(bridge.to), ring.end());
  ring.push_back(ring.front());
  ring.push_back(outline[bridge.from]);
  outline.insert(outline.begin() + static_cast<std::ptrdiff_t>(bridge.from) + 1, ring.begin(), ring.end());
}

}  // namespace

std::vector<cv::Point> outlineOf(const cv::Mat& mask) {
  std::vector<Ring> all;
  std::vector<cv::Vec4i> hierarchy;
  cv::findContours(mask, all, hierarchy, cv::RETR_CCOMP, cv::CHAIN_APPROX_SIMPLE);
  const double least = std::max(kMinPart_px, kMinPart * cv::countNonZero(mask));
  std::vector<Ring> rings;
  std::vector<bool> is_kept(all.size());
  for (std::size_t i = 0; i < all.size(); ++i) {
    const int parent = hierarchy[i][3];
    if (parent < 0) is_kept[i] = pixelsWithin(all[i]) >= least;
  }
  for (std::size_t i = 0; i < all.size(); ++i) {
    const int parent = hierarchy[i][3];
    if (parent >= 0) is_kept[i] = is_kept[static_cast<std::size_t>(parent)] && pixelsOfHole(all[i]) >= least;
    if (is_kept[i]) rings.push_back(all[i]);
  }
  if (rings.empty()) {  // the largest part, however small
    const auto largest = std::max_element(all.begin(), all.end(), [](const Ring& a, const Ring& b) {
      return pixelsWithin(a) < pixelsWithin(b);
    });
    if (largest != all.end()) rings.push_back(*largest);
  }
  if (rings.empty()) return {};
  Ring outline = rings.front();
  rings.erase(rings.begin());
  while (!rings.empty()) {
    const Bridge bridge = shortestBridge(outline, rings);
    join(outline, bridge, rings[bridge.ring]);
    rings.erase(rings.begin() + static_cast<std::ptrdiff_t>(bridge.ring));
  }
  return outline.size() >= 3 ? outline : Ring{};
}

}  // namespace scantrove
