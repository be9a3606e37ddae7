#include "core/segmentation/supported_segments.h"

#include <algorithm>
#include <map>
#include <opencv2/imgproc.hpp>
#include <utility>
#include <vector>

#include "core/base/check.h"
#include "core/segmentation/component_pieces.h"
#include "core/segmentation/support_components.h"

namespace scantrove {
namespace {

// Areas are of images of 640 x 480.
constexpr double kMinPiece_px = 200;   // of a component of several objects
constexpr int kSmallSegment_px = 600;  // smaller segments in a support are holes' rims
constexpr double kMinCarried_px = 60;  // raised pixels of what carries something

/// Seen area, square metres, from which a flat part that carries something is a cloth or a tray, with objects
/// of their own. Smaller ones are objects themselves: a sheet under a cup.
constexpr double kMinCarrierArea = 0.06;

/// Numbers of new segments. 0: the pixel keeps its segment.
class NewSegments {
 public:
  explicit NewSegments(cv::Size size) : ids(size, 0) {}

  /// The number of a new segment.
  int add(SegmentRole role) {
    roles_.push_back(role);
    return static_cast<int>(roles_.size()) - 1;
  }
  [[nodiscard]] SegmentRole roleOf(int id) const { return roles_[static_cast<std::size_t>(id)]; }

  cv::Mat1i ids;

 private:
  std::vector<SegmentRole> roles_{1};
};

/// 255 on the component's pixels without depth that do not reach its outline.
cv::Mat1b enclosedHoles(const SupportedComponent& component) {
  cv::Mat1b missing(component.mask.size(), 0), outside;
  missing.setTo(255, component.z_m == 0);
  missing &= component.mask;
  cv::dilate(~component.mask, outside, {}, {-1, -1}, 1, cv::BORDER_CONSTANT, 255);
  cv::Mat1i holes;
  const int count = cv::connectedComponents(missing, holes, 8);
  std::vector<bool> is_open(static_cast<std::size_t>(count), false);
  for (int v = 0; v < holes.rows; ++v)
    for (int u = 0; u < holes.cols; ++u)
      if (outside(v, u) != 0) is_open[static_cast<std::size_t>(holes(v, u))] = true;
  for (int v = 0; v < holes.rows; ++v)
    for (int u = 0; u < holes.cols; ++u)
      if (is_open[static_cast<std::size_t>(holes(v, u))]) missing(v, u) = 0;
  return missing;
}

class SupportSegmenter {
 public:
  SupportSegmenter(std::span<const Eigen::Vector3f> color_lab, const Intrinsics& K, SegmentMap& segments)
      : K_(K),
        segments_(segments),
        new_(cv::Size(segments.width, segments.height)),
        kept_roles_(segments.areas.size()) {
    if (color_lab.empty()) return;
    SCANTROVE_CHECK(color_lab.size() == segments.ids.size());
    lab_ = cv::Mat3f(segments.height, segments.width,
                     reinterpret_cast<cv::Vec3f*>(const_cast<float*>(color_lab.front().data())));
  }

  void run(std::span<const Support> supports) {
    for (const Support& support : supports) segmentOn(support, supports);
    if (!supports.empty()) write();
  }

 private:
  [[nodiscard]] float depthAt(int u, int v) const { return segments_.depths_m[K_.indexOf(u, v)]; }

  void segmentOn(const Support& support, std::span<const Support> supports) {
    ++support_number_;
    segmentArea(support, supports, SegmentRole::Kind::support);
  }

  /// `kind`: of the area's own segment.
  void segmentArea(const Support& support, std::span<const Support> supports, SegmentRole::Kind kind) {
    const SupportImages images = SupportImages::of(support, segments_, lab_, K_);
    const auto [labels, components] = findComponents(images, otherSupports(support, supports), K_);
    const int rest = new_.add({kind, support_number_});
    cv::Mat1b keeps(images.area.size(), 0);  // the pixels are not of the area's own segment
    for (const Component& component : components) {
      if (component.isRaised() && component.isComplete()) {
        keeps.setTo(255, labels == component.label);
        complete(component, labels, images, support.surface);
      } else if (kind == SegmentRole::Kind::support && isCarrier(component, images, support.surface)) {
        keeps.setTo(255, labels == component.label);
        segmentArea(carrierOf(component, labels, images, support.surface), supports,
                    SegmentRole::Kind::carrier);
      } else {
        add(component, labels, images, support.surface);
      }
    }
    fillRest(support, images, keeps, rest);
  }

  [[nodiscard]] bool isCarrier(const Component& component, const SupportImages& images,
                               const InverseDepthSurface& surface) const {
    if (component.isRaised() || component.raised_px < kMinCarried_px * K_.pixelScale()) return false;
    const cv::Point middle = images.box.tl() + (component.box.tl() + component.box.br()) / 2;
    const double z_m = surface.depthAt((static_cast<float>(middle.x) - K_.cx) / K_.fx,
                                       (static_cast<float>(middle.y) - K_.cy) / K_.fy, 0);
    return component.area_px * z_m * z_m / (double{K_.fx} * K_.fy) >= kMinCarrierArea;
  }

  /// The component as a support. Its segment by depth is the one of most of its flat pixels.
  [[nodiscard]] Support carrierOf(const Component& component, const cv::Mat1i& labels,
                                  const SupportImages& images, const InverseDepthSurface& surface) const {
    Support carrier{surface, 0, {cv::Size(segments_.width, segments_.height), 0}, {}};
    carrier.box = component.box + images.box.tl();
    std::map<std::uint32_t, int> flat_px;
    for (int v = 0; v < component.box.height; ++v) {
      for (int u = 0; u < component.box.width; ++u) {
        const cv::Point in_support = component.box.tl() + cv::Point(u, v), p = images.box.tl() + in_support;
        if (labels(in_support) != component.label) continue;
        carrier.area(p) = 255;
        if (images.flat(in_support) != 0) ++flat_px[segments_.ids[K_.indexOf(p.x, p.y)]];
      }
    }
    if (!flat_px.empty())
      carrier.segment =
          std::ranges::max_element(flat_px, {}, &std::pair<const std::uint32_t, int>::second)->first;
    return carrier;
  }

  /// 255 on the segments of other supports, in this one's box: a chair's seat above the floor.
  [[nodiscard]] cv::Mat1b otherSupports(const Support& support, std::span<const Support> supports) const {
    const cv::Rect box = support.box;
    cv::Mat1b others(box.size(), 0);
    for (int v = 0; v < box.height; ++v) {
      for (int u = 0; u < box.width; ++u) {
        const std::uint32_t id = segments_.ids[K_.indexOf(box.x + u, box.y + v)];
        const bool is_other = std::ranges::any_of(supports, [&](const Support& other) {
          return other.segment == id && other.segment != support.segment;
        });
        if (is_other) others(v, u) = 255;
      }
    }
    return others;
  }

  /// The component's pixels, in its box.
  [[nodiscard]] SupportedComponent pixelsOf(const Component& component, const cv::Mat1i& labels,
                                            const SupportImages& images) const {
    const cv::Rect box = component.box;
    const cv::Point origin = images.box.tl() + box.tl();
    SupportedComponent carried{{box.size(), 0},
                               {box.size(), 0.0F},
                               images.height_m(box),
                               {box.size(), 0},
                               lab_.empty() ? cv::Mat3f() : cv::Mat3f(lab_(cv::Rect(origin, box.size())))};
    carried.mask.setTo(255, labels(box) == component.label);
    for (int v = 0; v < box.height; ++v) {
      for (int u = 0; u < box.width; ++u) {
        carried.z_m(v, u) = depthAt(origin.x + u, origin.y + v);
        carried.segment(v, u) = static_cast<int>(segments_.ids[K_.indexOf(origin.x + u, origin.y + v)]);
      }
    }
    return carried;
  }

  /// Keeps the component's segments by depth; pixels without depth that it encloses join the nearest. Those
  /// at its outline may be what it hides from the depth sensor.
  void complete(const Component& component, const cv::Mat1i& labels, const SupportImages& images,
                const InverseDepthSurface& surface) {
    const SupportedComponent carried = pixelsOf(component, labels, images);
    const cv::Point origin = images.box.tl() + component.box.tl();
    std::map<int, int> areas;
    for (int v = 0; v < component.box.height; ++v)
      for (int u = 0; u < component.box.width; ++u)
        if (carried.mask(v, u) != 0) ++areas[carried.segment(v, u)];
    for (const auto& [id, area_px] : areas) {
      const auto segment = static_cast<std::size_t>(id);
      if (id > 0 && 2 * area_px > segments_.areas[segment])
        kept_roles_[segment] = {SegmentRole::Kind::carried, support_number_};
    }
    if (component.measured_px == component.area_px) return;
    const cv::Mat1b enclosed = enclosedHoles(carried);
    const cv::Mat2i nearest = nearestMeasured(carried);
    for (int v = 0; v < component.box.height; ++v) {
      for (int u = 0; u < component.box.width; ++u) {
        const cv::Point source(nearest(v, u)[0], nearest(v, u)[1]);
        if (enclosed(v, u) == 0 || source.x < 0) continue;
        segments_.ids[K_.indexOf(origin.x + u, origin.y + v)] =
            static_cast<std::uint32_t>(carried.segment(source));
        estimate(origin.x + u, origin.y + v, surface, std::max(0.0F, carried.height_m(source)));
      }
    }
  }

  /// Replaces the component's segments by new ones.
  void add(const Component& component, const cv::Mat1i& labels, const SupportImages& images,
           const InverseDepthSurface& surface) {
    const cv::Rect box = component.box;
    const cv::Point origin = images.box.tl() + box.tl();
    const SupportedComponent carried = pixelsOf(component, labels, images);
    const ComponentPieces pieces = divideComponent(carried, kMinPiece_px * K_.pixelScale(), {});
    std::vector<int> ids(1);
    for (int piece = 1; piece <= pieces.count; ++piece)
      ids.push_back(new_.add({SegmentRole::Kind::carried, support_number_}));
    for (int v = 0; v < box.height; ++v) {
      for (int u = 0; u < box.width; ++u) {
        if (carried.mask(v, u) == 0) continue;
        new_.ids(origin.y + v, origin.x + u) = ids[static_cast<std::size_t>(pieces.piece(v, u))];
        if (!(carried.z_m(v, u) > 0)) estimate(origin.x + u, origin.y + v, surface, pieces.height_m(v, u));
      }
    }
  }

  /// The rest of the support is one segment: its own, small ones in it, and holes in depth that look like it.
  void fillRest(const Support& support, const SupportImages& images, const cv::Mat1b& keeps, int rest) {
    const auto small_px = static_cast<int>(kSmallSegment_px * K_.pixelScale());
    for (int v = 0; v < images.box.height; ++v) {
      for (int u = 0; u < images.box.width; ++u) {
        const int x = images.box.x + u, y = images.box.y + v;
        if (images.area(v, u) == 0 || keeps(v, u) != 0 || new_.ids(y, x) != 0) continue;
        const std::uint32_t id = segments_.ids[K_.indexOf(x, y)];
        const bool is_gap =
            images.missing(v, u) != 0 && !lab_.empty() && images.difference.lit(v, u) < kClearColorDifference;
        const bool is_flat =
            images.flat(v, u) != 0 && (id == support.segment || segments_.areas[id] < small_px);
        if (!is_gap && !is_flat) continue;
        new_.ids(y, x) = rest;
        if (is_gap) estimate(x, y, support.surface, 0);
      }
    }
  }

  void estimate(int u, int v, const InverseDepthSurface& surface, float height_m) {
    const float z_m = surface.depthAt((static_cast<float>(u) - K_.cx) / K_.fx,
                                      (static_cast<float>(v) - K_.cy) / K_.fy, height_m);
    if (z_m > 0) estimated_.push_back({K_.indexOf(u, v), z_m});
  }

  /// Replaces the segments by the new ones, and numbers all by their first pixel.
  void write() {
    segments_.is_estimated.assign(segments_.ids.size(), 0);
    for (const auto& [pixel, z_m] : estimated_) {
      segments_.depths_m[pixel] = z_m;
      segments_.is_estimated[pixel] = 1;
    }
    const std::vector<std::uint32_t> before = std::exchange(segments_.ids, {});
    std::vector<std::uint32_t> of_before(segments_.areas.size(), 0), of_new;
    segments_.ids.reserve(before.size());
    segments_.areas.assign(1, 0);
    segments_.roles.assign(1, {});
    const auto numberIn = [&](std::vector<std::uint32_t>& numbers, std::size_t id, SegmentRole role) {
      if (id >= numbers.size()) numbers.resize(id + 1, 0);
      if (numbers[id] == 0) {
        numbers[id] = static_cast<std::uint32_t>(segments_.areas.size());
        segments_.areas.push_back(0);
        segments_.roles.push_back(role);
      }
      return numbers[id];
    };
    std::size_t pixel = 0;
    for (const int id : new_.ids) {
      std::uint32_t segment = 0;
      if (id > 0 && segments_.depths_m[pixel] > 0) {
        segment = numberIn(of_new, static_cast<std::size_t>(id), new_.roleOf(id));
      } else if (id == 0 && before[pixel] != 0) {
        segment = numberIn(of_before, before[pixel], kept_roles_[before[pixel]]);
      }
      segments_.ids.push_back(segment);
      ++segments_.areas[segment];
      ++pixel;
    }
  }

  struct Estimated {
    std::size_t pixel;
    float z_m;
  };
  const Intrinsics& K_;
  SegmentMap& segments_;
  cv::Mat3f lab_;  // empty: no colour
  NewSegments new_;
  std::vector<Estimated> estimated_;
  std::vector<SegmentRole> kept_roles_;  // of segments by depth that stay, by their id
  std::uint8_t support_number_ = 0;
};

}  // namespace

void segmentOnSupports(std::span<const Support> supports, std::span<const Eigen::Vector3f> color_lab,
                       const Intrinsics& K, SegmentMap& segments) {
  if (segments.ids.empty() || segments.width != K.width || segments.height != K.height) return;
  SupportSegmenter(color_lab, K, segments).run(supports);
}

void addEstimatedSurface(const SegmentMap& segments, RenderedView& view) {
  if (segments.is_estimated.empty()) return;
  if (view.is_estimated.empty()) view.is_estimated.assign(segments.ids.size(), 0);
  const Eigen::Isometry3f T_world_camera = view.T_world_camera.cast<float>();
  for (int v = 0; v < view.K.height; ++v) {
    for (int u = 0; u < view.K.width; ++u) {
      const std::size_t pixel = view.K.indexOf(u, v);
      if (segments.is_estimated[pixel] == 0) continue;
      const Eigen::Vector3f point =
          view.K.backProject(static_cast<float>(u), static_cast<float>(v), segments.depths_m[pixel]);
      view.vertices_world[pixel] << T_world_camera * point, 1;
      view.is_estimated[pixel] = 1;
    }
  }
}

}  // namespace scantrove
