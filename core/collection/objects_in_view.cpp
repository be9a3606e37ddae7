#include "core/collection/objects_in_view.h"

#include <map>
#include <utility>
#include <vector>

#include "core/collection/bounds_in_color.h"

namespace scantrove {
namespace {

/// A part of the object's pixels that makes a component count for its rectangle: fewer are stray labels.
constexpr double kMinPart = 0.01;

/// Connected pixels of an object.
struct Part {
  int pixels = 0;
  BoundsInColor bounds;
};

/// What one image shows of an object.
struct Sight {
  RegionSet regions;
  int pixels = 0;
  std::vector<Part> parts;

  [[nodiscard]] BoundsInColor bounds() const {
    BoundsInColor all;
    for (const Part& part : parts)
      if (part.pixels >= kMinPart * pixels) all.add(part.bounds);
    return all;
  }
};

/// The object of each pixel that colour shows, with their regions.
class ObjectPixels {
 public:
  ObjectPixels(const RenderedView& view, const SurfaceInColor& in_color,
               const std::function<ObjectId(RegionId)>& object_of)
      : K_(view.K), in_color_(in_color), objects_(view.regions.size()) {
    std::map<RegionId, ObjectId> known;
    for (int v = 0; v < K_.height; ++v) {
      for (int u = 0; u < K_.width; ++u) {
        const RegionId region = view.regions[K_.indexOf(u, v)];
        if (!region || in_color.hidden.at<std::uint8_t>(v, u) != 0) continue;
        const auto [entry, is_first] = known.try_emplace(region);
        if (is_first) entry->second = object_of(region);
        if (!entry->second) continue;
        objects_[K_.indexOf(u, v)] = entry->second;
        if (is_first) sights_[entry->second].regions.add(region);
      }
    }
  }

  /// By object. Takes the pixels.
  std::map<ObjectId, Sight> sights() {
    for (int v = 0; v < K_.height; ++v) {
      for (int u = 0; u < K_.width; ++u) {
        const ObjectId object = objects_[K_.indexOf(u, v)];
        if (!object) continue;
        Sight& sight = sights_.at(object);
        sight.parts.push_back(takePart(u, v));
        sight.pixels += sight.parts.back().pixels;
      }
    }
    return std::move(sights_);
  }

 private:
  /// The connected pixels of the object at (u, v), which are none's afterwards.
  Part takePart(int u, int v) {
    const ObjectId object = std::exchange(objects_[K_.indexOf(u, v)], {});
    Part part;
    open_.assign(1, {u, v});
    while (!open_.empty()) {
      const cv::Point at = open_.back();
      open_.pop_back();
      ++part.pixels;
      part.bounds.add(in_color_.places.at<cv::Vec2f>(at));
      for (const cv::Point& step : {cv::Point{1, 0}, cv::Point{-1, 0}, cv::Point{0, 1}, cv::Point{0, -1}}) {
        const cv::Point next = at + step;
        if (!K_.isInside(next.x, next.y) || objects_[K_.indexOf(next.x, next.y)] != object) continue;
        objects_[K_.indexOf(next.x, next.y)] = {};
        open_.push_back(next);
      }
    }
    return part;
  }

  const Intrinsics& K_;
  const SurfaceInColor& in_color_;
  std::vector<ObjectId> objects_;  // by pixel
  std::map<ObjectId, Sight> sights_;
  std::vector<cv::Point> open_;
};

}  // namespace

std::vector<SeenObject> objectsInView(const RenderedView& view, const SurfaceInColor& in_color,
                                      const std::function<ObjectId(RegionId)>& object_of, int least_pixels) {
  std::vector<SeenObject> seen;
  for (auto& [object, sight] : ObjectPixels(view, in_color, object_of).sights()) {
    if (sight.pixels < least_pixels) continue;
    SeenObject one;
    one.object = object;
    one.box = sight.bounds().box({view.K.width, view.K.height});
    one.regions = std::move(sight.regions);
    seen.push_back(std::move(one));
  }
  return seen;
}

}  // namespace scantrove
