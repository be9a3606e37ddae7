#include "core/collection/objects_in_view.h"

#include <map>
#include <utility>

#include "core/collection/bounds_in_color.h"

namespace scantrove {
namespace {

/// What one image shows of an object.
struct Sight {
  RegionSet regions;
  int pixels = 0;
  BoundsInColor bounds;
};

}  // namespace

std::vector<SeenObject> objectsInView(const RenderedView& view, const SurfaceInColor& in_color,
                                      const std::function<ObjectId(RegionId)>& object_of, int least_pixels) {
  std::map<RegionId, ObjectId> objects;
  std::map<ObjectId, Sight> sights;
  std::size_t pixel = 0;
  for (int v = 0; v < view.K.height; ++v) {
    for (int u = 0; u < view.K.width; ++u) {
      const RegionId region = view.regions[pixel++];
      if (!region || in_color.hidden.at<std::uint8_t>(v, u) != 0) continue;
      const auto [known, is_first] = objects.try_emplace(region);
      if (is_first) known->second = object_of(region);
      if (!known->second) continue;
      Sight& sight = sights[known->second];
      if (is_first) sight.regions.add(region);
      ++sight.pixels;
      sight.bounds.add(in_color.places.at<cv::Vec2f>(v, u));
    }
  }
  std::vector<SeenObject> seen;
  for (auto& [object, sight] : sights) {
    if (sight.pixels < least_pixels) continue;
    SeenObject one;
    one.object = object;
    one.regions = std::move(sight.regions);
    one.box = sight.bounds.box({view.K.width, view.K.height});
    seen.push_back(std::move(one));
  }
  return seen;
}

}  // namespace scantrove
