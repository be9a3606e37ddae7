#include "core/segmentation/component_pieces.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <numeric>
#include <opencv2/imgproc.hpp>
#include <optional>
#include <utility>
#include <vector>

namespace scantrove {
namespace {

constexpr double kMinSeedPart = 0.03;  // of the component: smaller segments make no piece
constexpr double kRaisedPart = 0.5;    // of a segment: it rises from the support
constexpr float kTouching = 0.015F;    // of the depth: pixels farther apart are of surfaces that do not touch
constexpr int kBend_px = 3;            // on both sides of a border, over which the surface bends
constexpr int kGap_px = 4;             // between pieces: small segments are in none
constexpr double kContinuousPart = 0.2;  // of the border between pieces of one object
constexpr int kMinContinuous = 3;        // pixels of a border
constexpr float kClearFold = 0.002F;     // of the depth, over kBend_px
constexpr float kSameColor = 2.5F;       // Lab: less is one material, also across a fold
constexpr float kSimilarColor = 5;       // Lab: less across a border is one colour
constexpr float kRoundColor = 20;        // Lab: more is another object, however round the two are together
constexpr float kOtherColor = 1000;
constexpr float kLow_m = 0.03F;     // higher things are not one with a flat part: a vase on a cloth
constexpr double kOpenPart = 0.5;   // of a flat part's outline that borders on no raised part
constexpr double kRoundPart = 0.9;  // of the convex outline of one object

std::size_t at(int index) { return static_cast<std::size_t>(index); }

/// The nearest marked pixel.
class Nearest {
 public:
  explicit Nearest(const cv::Mat1b& marked) {
    if (cv::countNonZero(marked) == 0) return;
    cv::Mat1f distance;
    cv::distanceTransform(~marked, distance, label_, cv::DIST_L2, cv::DIST_MASK_5, cv::DIST_LABEL_PIXEL);
    points_.resize(marked.total() + 1);
    for (int y = 0; y < marked.rows; ++y)
      for (int x = 0; x < marked.cols; ++x)
        if (marked(y, x) != 0) points_[at(label_(y, x))] = {x, y};
  }
  [[nodiscard]] std::optional<cv::Point> to(const cv::Point& p) const {
    if (label_.empty()) return std::nullopt;
    return points_[at(label_(p))];
  }

 private:
  cv::Mat1i label_;
  std::vector<cv::Point> points_;
};

class Divider {
 public:
  Divider(const SupportedComponent& component, double min_piece_px, const SupportLimits& limits)
      : component_(component), image_({}, component.mask.size()), limits_(limits) {
    min_piece_px_ = std::max(min_piece_px, kMinSeedPart * cv::countNonZero(component.mask));
  }

  ComponentPieces divide() {
    findSeeds();
    ComponentPieces pieces = spread();
    if (pieces.count > 1) join(pieces);
    return pieces;
  }

 private:
  [[nodiscard]] bool isMeasured(const cv::Point& p) const {
    return component_.mask(p) != 0 && component_.z_m(p) > 0;
  }

  /// Calls `visit` with each pixel of the box.
  template <class Visit>
  void forPixels(const Visit& visit) const {
    for (int y = 0; y < image_.height; ++y)
      for (int x = 0; x < image_.width; ++x) visit(cv::Point(x, y));
  }

  /// The segments that make pieces; all measured pixels where none does.
  void findSeeds() {
    struct Segment {
      int area_px = 0, raised_px = 0, seed = 0;
    };
    std::map<int, Segment> segments;
    forPixels([&](const cv::Point& p) {
      if (!isMeasured(p)) return;
      Segment& segment = segments[component_.segment(p)];
      ++segment.area_px;
      segment.raised_px += isRaised(p) ? 1 : 0;
    });
    int count = 0;
    for (auto& [id, segment] : segments) {
      const bool is_raised = segment.raised_px > kRaisedPart * segment.area_px;
      if (is_raised && segment.area_px >= min_piece_px_) segment.seed = ++count;
    }
    seeds_ = cv::Mat1i(image_.size(), 0);
    forPixels([&](const cv::Point& p) {
      if (isMeasured(p)) seeds_(p) = count == 0 ? 1 : segments[component_.segment(p)].seed;
    });
    raised_ = count_ = std::max(count, 1);
    if (count > 0) findFlatSeeds();
  }

  /// Flat parts beside raised ones are pieces of their own: a sheet that touches a cup. What raised parts
  /// enclose belongs to them: the inside of a plate.
  void findFlatSeeds() {
    cv::Mat1b flat(image_.size(), 0), inner;
    forPixels([&](const cv::Point& p) {
      if (isMeasured(p) && !isRaised(p)) flat(p) = 255;
    });
    cv::erode(flat, inner, {}, {-1, -1}, 1, cv::BORDER_CONSTANT, 0);
    cv::Mat1i parts, stats;
    cv::Mat centroids;
    const int count = cv::connectedComponentsWithStats(inner, parts, stats, centroids, 4);
    for (int part = 1; part < count; ++part) {
      const cv::Mat1b pixels(parts == part);
      if (stats(part, cv::CC_STAT_AREA) < min_piece_px_ || !isOpen(pixels)) continue;
      cv::dilate(pixels, inner, {}, {-1, -1}, 1, cv::BORDER_CONSTANT, 0);
      seeds_.setTo(++count_, inner & flat);
    }
  }

  /// True if raised parts do not enclose these pixels. What is around the box is not of the component.
  [[nodiscard]] bool isOpen(const cv::Mat1b& pixels) const {
    constexpr int kReach_px = 2;
    cv::Mat1b inside, around;
    cv::copyMakeBorder(pixels, inside, kReach_px, kReach_px, kReach_px, kReach_px, cv::BORDER_CONSTANT, 0);
    constexpr int kSide_px = 2 * kReach_px + 1;
    cv::dilate(inside, around, cv::getStructuringElement(cv::MORPH_RECT, {kSide_px, kSide_px}));
    int open = 0, closed = 0;
    for (int y = 0; y < around.rows; ++y) {
      for (int x = 0; x < around.cols; ++x) {
        if (around(y, x) == 0 || inside(y, x) != 0) continue;
        const cv::Point p(x - kReach_px, y - kReach_px);
        const bool is_outside = !image_.contains(p) || component_.mask(p) == 0;
        open += is_outside ? 1 : 0;
        closed += !is_outside && isMeasured(p) && isRaised(p) ? 1 : 0;
      }
    }
    return open >= kOpenPart * (open + closed);
  }

  [[nodiscard]] bool isRaised(const cv::Point& p) const {
    return component_.height_m(p) > limits_.raised_m * SupportLimits::growth(component_.z_m(p));
  }

  [[nodiscard]] bool isFlat(int seed) const { return seed > raised_; }

  /// Mean height of a seed's pixels.
  [[nodiscard]] float heightOf(int seed) const {
    const cv::Mat1b pixels(seeds_ == seed);
    return static_cast<float>(cv::mean(component_.height_m, pixels)[0]);
  }

  /// Each pixel takes the piece of the nearest seed, and the height of the nearest measured pixel.
  [[nodiscard]] ComponentPieces spread() const {
    ComponentPieces pieces{cv::Mat1i(image_.size(), 0), cv::Mat1f(image_.size(), 0.0F), count_};
    cv::Mat1b seeds(image_.size(), 0), measured(image_.size(), 0);
    forPixels([&](const cv::Point& p) {
      if (seeds_(p) != 0) seeds(p) = 255;
      if (isMeasured(p)) measured(p) = 255;
    });
    const Nearest seed(seeds), reading(measured);
    forPixels([&](const cv::Point& p) {
      if (component_.mask(p) == 0) return;
      const auto nearest_seed = seed.to(p), nearest_reading = reading.to(p);
      pieces.piece(p) = nearest_seed ? seeds_(*nearest_seed) : 1;
      pieces.height_m(p) = nearest_reading ? std::max(0.0F, component_.height_m(*nearest_reading)) : 0.0F;
    });
    return pieces;
  }

  struct Border {
    int length = 0, continuous = 0;
    float fold_sum = 0;     ///< of the depth; > 0: the surface is farther away between the two sides
    cv::Vec3f color_sum{};  ///< of the higher minus the lower piece
    [[nodiscard]] float colorStep() const {
      // Both sides may lie in different light.
      constexpr float kLightness = 0.3F;
      const cv::Vec3f mean = color_sum / static_cast<float>(std::max(length, 1));
      return std::hypot(kLightness * mean[0], mean[1], mean[2]);
    }
    [[nodiscard]] float fold() const {
      return continuous > 0 ? fold_sum / static_cast<float>(continuous) : 0;
    }
  };

  [[nodiscard]] std::map<std::pair<int, int>, Border> findBorders() const {
    std::map<std::pair<int, int>, Border> borders;
    forPixels([&](const cv::Point& p) {
      if (seeds_(p) == 0) return;
      for (const cv::Point& step : {cv::Point{1, 0}, cv::Point{0, 1}}) {
        if (const auto other = acrossBorder(p, step)) addStep(p, *other, step, borders);
      }
    });
    return borders;
  }

  /// The next pixel of another seed in that direction, over a few pixels of none; none: there is none.
  [[nodiscard]] std::optional<cv::Point> acrossBorder(const cv::Point& from, const cv::Point& step) const {
    cv::Point to = from;
    for (int i = 0; i < kGap_px; ++i) {
      to += step;
      if (!image_.contains(to) || seeds_(to) == seeds_(from)) return std::nullopt;
      if (seeds_(to) != 0) return to;
    }
    return std::nullopt;
  }

  void addStep(const cv::Point& from, const cv::Point& to, const cv::Point& step,
               std::map<std::pair<int, int>, Border>& borders) const {
    Border& border = borders[std::minmax(seeds_(from), seeds_(to))];
    ++border.length;
    if (component_.lab.empty()) {
      border.color_sum = {kOtherColor * static_cast<float>(border.length), 0, 0};
    } else {
      const cv::Vec3f difference = component_.lab(beside(to, step)) - component_.lab(beside(from, -step));
      border.color_sum += seeds_(to) > seeds_(from) ? difference : -difference;
    }
    const cv::Mat1f& z = component_.z_m;
    if (std::abs(z(to) - z(from)) > kTouching * z(from)) return;
    const cv::Point before = from - kBend_px * step, after = to + kBend_px * step;
    if (!image_.contains(before) || !image_.contains(after)) return;
    if (seeds_(before) != seeds_(from) || seeds_(after) != seeds_(to)) return;
    ++border.continuous;
    border.fold_sum += (z(from) + z(to) - z(before) - z(after)) / (2 * z(from));
  }

  /// A pixel farther from the border, past its blur, if it is of the same piece.
  [[nodiscard]] cv::Point beside(const cv::Point& p, const cv::Point& step) const {
    const cv::Point farther = p + 2 * step;
    return image_.contains(farther) && seeds_(farther) == seeds_(p) ? farther : p;
  }

  void join(ComponentPieces& pieces) const {
    std::vector<int> parent(at(pieces.count) + 1);
    std::iota(parent.begin(), parent.end(), 0);
    const auto rootOf = [&](int piece) {
      while (parent[at(piece)] != piece) piece = parent[at(piece)];
      return piece;
    };
    for (const auto& [pair, border] : findBorders()) {
      const bool continues =
          border.continuous >= std::max<double>(kMinContinuous, kContinuousPart * border.length);
      const float color = border.colorStep();
      const bool is_even =
          border.fold() <= kClearFold &&
          (color < kSimilarColor || (color < kRoundColor && isRound(pair.first, pair.second)));
      const bool is_one = isFlat(pair.first) != isFlat(pair.second)
                              ? color < kSimilarColor && heightOf(std::min(pair.first, pair.second)) < kLow_m
                              : (continues && border.fold() <= 0) || is_even || color < kSameColor;
      if (!is_one) continue;
      const int a = rootOf(pair.first), b = rootOf(pair.second);
      parent[at(std::max(a, b))] = std::min(a, b);
    }
    std::vector<int> number(parent.size(), 0);
    int next = 0;
    for (int piece = 1; piece <= pieces.count; ++piece)
      number[at(piece)] = parent[at(piece)] == piece ? ++next : number[at(rootOf(piece))];
    pieces.count = next;
    for (int& piece : pieces.piece) piece = number[at(piece)];
  }

  /// True if the two pieces together have no dents in the image.
  [[nodiscard]] bool isRound(int a, int b) const {
    std::vector<cv::Point> points, hull;
    forPixels([&](const cv::Point& p) {
      if (seeds_(p) == a || seeds_(p) == b) points.push_back(p);
    });
    cv::convexHull(points, hull);
    cv::Mat1b filled(image_.size(), 0);
    cv::fillConvexPoly(filled, hull, 255);
    return static_cast<double>(points.size()) >= kRoundPart * cv::countNonZero(filled);
  }

  const SupportedComponent& component_;
  const cv::Rect image_;
  const SupportLimits& limits_;
  double min_piece_px_ = 0;
  cv::Mat1i seeds_;             // 1 .. count_; 0: none
  int count_ = 1, raised_ = 1;  // seeds; the flat ones follow the raised ones
};

}  // namespace

cv::Mat2i nearestMeasured(const SupportedComponent& component) {
  cv::Mat1b measured(component.mask.size(), 0);
  measured.setTo(255, component.z_m > 0);
  measured &= component.mask;
  const Nearest nearest(measured);
  cv::Mat2i result(component.mask.size(), cv::Vec2i(-1, -1));
  for (int y = 0; y < result.rows; ++y) {
    for (int x = 0; x < result.cols; ++x) {
      const auto source = component.mask(y, x) == 0 ? std::nullopt : nearest.to({x, y});
      if (source) result(y, x) = {source->x, source->y};
    }
  }
  return result;
}

ComponentPieces divideComponent(const SupportedComponent& component, double min_piece_px,
                                const SupportLimits& limits) {
  return Divider(component, min_piece_px, limits).divide();
}

}  // namespace scantrove
