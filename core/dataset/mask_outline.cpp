#include "core/dataset/mask_outline.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>
#include <opencv2/core.hpp>
#include <opencv2/imgproc.hpp>
#include <tuple>
#include <utility>

namespace scantrove {
namespace {

using Ring = std::vector<cv::Point>;

constexpr double kMaxLeftOut = 0.02;
constexpr double kMinPart_px = 9;
constexpr std::size_t kMaxRings = 200;
/// Pairs of pixels compared for one bridge. Of longer rings every n-th pixel is compared first, then those
/// around the nearest.
constexpr std::size_t kMaxPairs = 20'000;

/// Pixels inside a ring of neighbouring pixels, including those on it (Pick's theorem).
double pixelsWithin(const Ring& ring) {
  return cv::contourArea(ring) + static_cast<double>(ring.size()) / 2 + 1;
}

/// Pixels of the hole inside a ring; those on the ring do not belong to it.
double pixelsOfHole(const Ring& ring) {
  return std::max(1.0, 2 * cv::contourArea(ring) + 2 - pixelsWithin(ring));
}

/// The rings of parts and holes that the outline has, largest first; the first one is a part. Inner rings are
/// smaller than those around them, so no ring stays whose surroundings are left out.
std::vector<Ring> ringsOf(const cv::Mat& mask) {
  std::vector<Ring> all;
  std::vector<cv::Vec4i> hierarchy;
  cv::findContours(mask, all, hierarchy, cv::RETR_CCOMP, cv::CHAIN_APPROX_NONE);
  std::vector<double> pixels;
  for (std::size_t i = 0; i < all.size(); ++i)
    pixels.push_back(hierarchy[i][3] < 0 ? pixelsWithin(all[i]) : pixelsOfHole(all[i]));
  std::vector<std::size_t> order(all.size());
  std::iota(order.begin(), order.end(), std::size_t{0});
  std::sort(order.begin(), order.end(), [&](std::size_t a, std::size_t b) {
    const bool is_hole_a = hierarchy[a][3] >= 0, is_hole_b = hierarchy[b][3] >= 0;
    return std::tuple(-pixels[a], is_hole_a, a) < std::tuple(-pixels[b], is_hole_b, b);
  });
  const double budget = kMaxLeftOut * cv::countNonZero(mask);
  double left_out = 0;
  while (order.size() > 1) {
    const double smallest = pixels[order.back()];
    const bool is_small = smallest < kMinPart_px || left_out + smallest <= budget;
    if (!is_small && order.size() <= kMaxRings) break;
    left_out += smallest;
    order.pop_back();
  }
  std::vector<Ring> rings;
  for (const std::size_t i : order) rings.push_back(std::move(all[i]));
  return rings;
}

/// The nearest pixels of the outline and of a ring that is not connected yet.
struct Bridge {
  cv::Point from, to;
  int squared = std::numeric_limits<int>::max();
};

/// Places of a ring: every `step`-th from `begin` to `end`.
struct Places {
  std::size_t begin, end, step;
};

/// Indices of the nearest pixels, compared at these places; `best` as it was if there are none nearer.
std::pair<std::size_t, std::size_t> nearestPixels(const Ring& a, const Places& of_a, const Ring& b,
                                                  const Places& of_b, Bridge& best) {
  std::pair<std::size_t, std::size_t> found{a.size(), b.size()};
  for (std::size_t i = of_a.begin; i < of_a.end; i += of_a.step) {
    for (std::size_t j = of_b.begin; j < of_b.end; j += of_b.step) {
      const cv::Point d = a[i] - b[j];
      const int squared = d.dot(d);
      if (squared >= best.squared) continue;
      best = {a[i], b[j], squared};
      found = {i, j};
    }
  }
  return found;
}

void shorten(Bridge& bridge, const Ring& connected, const Ring& ring) {
  std::size_t step = 1;
  while ((connected.size() / step) * (ring.size() / step) > kMaxPairs) ++step;
  Bridge coarse;
  const auto [i, j] =
      nearestPixels(connected, {0, connected.size(), step}, ring, {0, ring.size(), step}, coarse);
  const auto around = [step](std::size_t place, const Ring& all) {
    return Places{place > step ? place - step : 0, std::min(place + step + 1, all.size()), 1};
  };
  if (step > 1) nearestPixels(connected, around(i, connected), ring, around(j, ring), coarse);
  if (coarse.squared < bridge.squared) bridge = coarse;
}

/// Inserts the bridge, the ring, and the bridge back.
void join(Ring& outline, const Bridge& bridge, Ring ring) {
  std::rotate(ring.begin(), std::find(ring.begin(), ring.end(), bridge.to), ring.end());
  ring.push_back(ring.front());
  ring.push_back(bridge.from);
  const auto from = std::find(outline.begin(), outline.end(), bridge.from);
  outline.insert(from + 1, ring.begin(), ring.end());
}

/// Without the points amid straight edges; where the outline turns back stays a corner.
Ring cornersOf(const Ring& outline) {
  Ring corners;
  for (std::size_t i = 0; i < outline.size(); ++i) {
    const cv::Point next = outline[(i + 1) % outline.size()];
    if (next == outline[i]) continue;
    const cv::Point previous = corners.empty() ? outline.back() : corners.back();
    const cv::Point in = outline[i] - previous, out = next - outline[i];
    const bool is_straight = in.cross(out) == 0 && in.dot(out) > 0;
    if (!is_straight) corners.push_back(outline[i]);
  }
  return corners;
}

}  // namespace

std::vector<cv::Point> outlineOf(const cv::Mat& mask) {
  std::vector<Ring> rings = ringsOf(mask);
  if (rings.empty()) return {};
  Ring outline = rings.front();
  std::vector<Bridge> bridges(rings.size());  // by ring: the nearest place of the outline so far
  std::vector<std::size_t> open(rings.size() - 1);
  std::iota(open.begin(), open.end(), std::size_t{1});
  std::size_t last = 0;
  while (!open.empty()) {
    for (const std::size_t i : open) shorten(bridges[i], rings[last], rings[i]);
    const auto next = std::min_element(open.begin(), open.end(), [&](std::size_t a, std::size_t b) {
      return bridges[a].squared < bridges[b].squared;
    });
    last = *next;
    open.erase(next);
    join(outline, bridges[last], rings[last]);
  }
  Ring corners = cornersOf(outline);
  return corners.size() >= 3 ? corners : Ring{};
}

}  // namespace scantrove
