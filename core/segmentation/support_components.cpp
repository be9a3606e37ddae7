#include "core/segmentation/support_components.h"

#include <algorithm>
#include <cmath>
#include <opencv2/core/utility.hpp>
#include <opencv2/imgproc.hpp>

namespace scantrove {
namespace {

// Areas and lengths in pixels are of images of 640 x 480.
constexpr float kClearColor = kClearColorDifference;
constexpr float kSureColor = 5;          // mean difference of an object that only its colour shows
constexpr double kShadowReach_px = 40;   // shadows of objects are looked for so far around them
constexpr float kTall_m = 0.03F;         // lower objects cast no wide shadow
constexpr double kMinArea_px = 60;       // smaller components are noise
constexpr double kMinFlatArea_px = 90;   // ... and flat ones, which only colour shows
constexpr double kMaxSupportPart = 0.5;  // of the support's area: more is a cloth or another surface
constexpr double kMinTouching =
    0.6;                           // part of an outline that borders on the support; the rest may be hidden
constexpr double kMaxCut = 0.05;   // part of an outline where the surface goes on rising: a wardrobe
constexpr double kHighPart = 0.5;  // of the measured pixels: with more, height speaks for a component
constexpr double kMeasuredPart = 0.2;  // of all pixels: with fewer, the measured ones say little
constexpr double kIncomplete = 0.15;   // pixels without depth, as part of a component
/// The colour of an object changes at its outline, that of a highlight or shadow over a wide band: the
/// difference just inside the outline, relative to that of the whole.
constexpr double kMinSharpness = 0.5;

class ComponentFinder {
 public:
  ComponentFinder(const SupportImages& images, const cv::Mat1b& others, const Intrinsics& K)
      : images_(images), others_(others), K_(K) {}

  /// The components that stand out from the support by height or colour and are objects on it.
  [[nodiscard]] SupportComponents find() const {
    const cv::Mat1b object = standingOut();
    SupportComponents found;
    cv::Mat1i& labels = found.labels;
    cv::Mat1i stats;
    cv::Mat centroids;
    const int count = cv::connectedComponentsWithStats(object, labels, stats, centroids, 4);
    const double least = kMinArea_px * K_.pixelScale(),
                 most = kMaxSupportPart * cv::countNonZero(images_.area);
    for (int label = 1; label < count; ++label) {
      Component component{label,
                          {stats(label, cv::CC_STAT_LEFT), stats(label, cv::CC_STAT_TOP),
                           stats(label, cv::CC_STAT_WIDTH), stats(label, cv::CC_STAT_HEIGHT)},
                          stats(label, cv::CC_STAT_AREA)};
      if (component.area_px < least || component.area_px > most) continue;
      forPixels(component, labels, [&](int u, int v) {
        component.raised_px += images_.raised(v, u) != 0 ? 1 : 0;
        component.measured_px += images_.missing(v, u) == 0 ? 1 : 0;
      });
      if (isOnSupport(component, labels) &&
          (component.isRaised() || isOwnColor(component, labels, images_.difference.lit)))
        found.components.push_back(component);
    }
    return found;
  }

 private:
  [[nodiscard]] int scaled(double length_px) const {
    return static_cast<int>(std::lround(length_px * std::sqrt(K_.pixelScale())));
  }

  [[nodiscard]] cv::Mat1b standingOut() const {
    const cv::Mat1f& color = images_.difference.lit;
    cv::Mat1b object(color.size(), 0), like_support(color.size(), 0), shadow(color.size(), 0);
    object.setTo(255, color > kClearColor);
    object &= images_.flat | images_.missing;
    // Beside what is tall, a darker pixel of the plane is in its shadow.
    cv::Mat1b near_tall;
    const int reach = 2 * scaled(kShadowReach_px) + 1;
    cv::dilate(images_.tall, near_tall, cv::getStructuringElement(cv::MORPH_RECT, {reach, reach}));
    shadow.setTo(255, images_.difference.shaded < kClearColor);
    object.setTo(0, shadow & near_tall & images_.flat);
    object |= images_.raised;
    object.setTo(0, others_);
    constexpr double kClosing_px = 4;
    const int bridge = 2 * std::max(1, scaled(kClosing_px) / 2) + 1;
    cv::morphologyEx(object, object, cv::MORPH_CLOSE,
                     cv::getStructuringElement(cv::MORPH_ELLIPSE, {bridge, bridge}));
    // What was only bridged still looks like the support, unless the object encloses it.
    like_support.setTo(255, color < kClearColor);
    object.setTo(0, like_support & (images_.missing | images_.flat));
    fillHoles(object, bridge);
    object.setTo(0, others_);
    object &= images_.area;
    return object;
  }

  /// Adds what an object encloses, although its outline may have gaps: the inside of a plate with a visible
  /// rim.
  static void fillHoles(cv::Mat1b& object, int bridge) {
    const int gap = 2 * bridge + 1;
    const cv::Mat kernel = cv::getStructuringElement(cv::MORPH_RECT, {gap, gap});
    cv::Mat1b closed, filled;
    cv::morphologyEx(object, closed, cv::MORPH_CLOSE, kernel);
    closed.copyTo(filled);
    std::vector<std::vector<cv::Point>> contours;
    cv::findContours(closed, contours, cv::RETR_EXTERNAL, cv::CHAIN_APPROX_NONE);
    cv::drawContours(filled, contours, -1, 255, cv::FILLED);
    cv::Mat1b inside(object.size(), 0);
    inside.setTo(255, filled & ~closed);
    // The closed rim between the inside and the object belongs to it, too.
    cv::dilate(inside, inside, kernel);
    object |= inside & filled;
    contours.clear();
    cv::findContours(object, contours, cv::RETR_EXTERNAL, cv::CHAIN_APPROX_NONE);
    cv::drawContours(object, contours, -1, 255, cv::FILLED);
  }

  /// True if the outline borders on the support nearly all around.
  [[nodiscard]] bool isOnSupport(const Component& component, const cv::Mat1i& labels) const {
    int outline = 0, touching = 0, cut = 0;
    forOutline(component, labels, [&](int, int, int u, int v) {
      ++outline;
      touching += images_.flat(v, u) != 0 || images_.missing(v, u) != 0 ? 1 : 0;
      cut += images_.height_m(v, u) >= SupportLimits{}.most_m ? 1 : 0;
    });
    return outline > 0 && touching >= kMinTouching * outline && cut <= kMaxCut * outline;
  }

  /// True if its colour is clear and changes sharply at its outline.
  [[nodiscard]] bool isOwnColor(const Component& component, const cv::Mat1i& labels,
                                const cv::Mat1f& color) const {
    if (component.area_px < kMinFlatArea_px * K_.pixelScale()) return false;
    constexpr float kMost = 3 * kClearColor;  // beyond it all differences are alike
    double whole = 0, step = 0;
    forPixels(component, labels, [&](int u, int v) { whole += std::min(color(v, u), kMost); });
    whole /= component.area_px;
    if (whole < kSureColor) return false;
    int outline = 0;
    const cv::Rect image({}, color.size());
    forOutline(component, labels, [&](int x, int y, int u, int v) {
      // One pixel farther on both sides, past the blur of the outline.
      const cv::Point inside(2 * x - u, 2 * y - v), outside(2 * u - x, 2 * v - y);
      if (!image.contains(inside) || !image.contains(outside)) return;
      ++outline;
      step += std::min(color(inside), kMost) - std::min(color(outside), kMost);
    });
    return outline > 0 && step / outline >= kMinSharpness * whole;
  }

  template <class Visit>
  static void forPixels(const Component& component, const cv::Mat1i& labels, const Visit& visit) {
    for (int v = component.box.y; v < component.box.br().y; ++v)
      for (int u = component.box.x; u < component.box.br().x; ++u)
        if (labels(v, u) == component.label) visit(u, v);
  }

  /// Calls `visit` with each pixel of the component (x, y) and its neighbour outside (u, v) in the image.
  template <class Visit>
  static void forOutline(const Component& component, const cv::Mat1i& labels, const Visit& visit) {
    constexpr std::array<std::array<int, 2>, 4> kNeighbors = {{{1, 0}, {-1, 0}, {0, 1}, {0, -1}}};
    const cv::Rect image({}, labels.size());
    forPixels(component, labels, [&](int x, int y) {
      for (const auto& [dx, dy] : kNeighbors) {
        const cv::Point other(x + dx, y + dy);
        if (image.contains(other) && labels(other) != component.label) visit(x, y, other.x, other.y);
      }
    });
  }

  const SupportImages& images_;
  const cv::Mat1b& others_;
  const Intrinsics& K_;
};

}  // namespace

bool Component::isRaised() const {
  return measured_px >= kMeasuredPart * area_px && raised_px >= kHighPart * measured_px;
}

bool Component::isComplete() const { return area_px - measured_px < kIncomplete * area_px; }

SupportImages SupportImages::of(const Support& support, const SegmentMap& segments, const cv::Mat3f& lab,
                                const Intrinsics& K) {
  const cv::Rect box = support.box;
  SupportImages images{box,
                       support.area(box),
                       {box.size(), 0},
                       {box.size(), 0},
                       {box.size(), 0},
                       {box.size(), 0},
                       {box.size(), 0.0F},
                       {}};
  const SupportLimits limits;
  const auto fill = [&](int u, int v) {
    if (images.area(v, u) == 0) return;
    const float z = segments.depths_m[K.indexOf(box.x + u, box.y + v)];
    if (!(z > 0)) {
      images.missing(v, u) = 255;
      return;
    }
    const float x = (static_cast<float>(box.x + u) - K.cx) / K.fx,
                y = (static_cast<float>(box.y + v) - K.cy) / K.fy;
    const float height_m = support.surface.height(x, y, z), growth = SupportLimits::growth(z);
    images.height_m(v, u) = height_m;
    if (std::abs(height_m) < limits.flat_m * growth) images.flat(v, u) = 255;
    if (height_m > limits.raised_m * growth && height_m < limits.most_m) {
      images.raised(v, u) = 255;
      if (height_m > kTall_m) images.tall(v, u) = 255;
    }
  };
  cv::parallel_for_({0, box.height}, [&](const cv::Range& rows) {
    for (int v = rows.start; v < rows.end; ++v)
      for (int u = 0; u < box.width; ++u) fill(u, v);
  });
  images.difference =
      differenceFromSupport(lab.empty() ? cv::Mat3f() : cv::Mat3f(lab(box)), images.flat, images.area);
  return images;
}

SupportComponents findComponents(const SupportImages& images, const cv::Mat1b& others, const Intrinsics& K) {
  return ComponentFinder(images, others, K).find();
}

}  // namespace scantrove
