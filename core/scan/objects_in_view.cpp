#include "core/scan/objects_in_view.h"

#include <algorithm>
#include <map>
#include <utility>

namespace scantrove {
namespace {

/// Of an object, in one image.
struct Sight {
  RegionSet regions;
  int pixels = 0;
  cv::Point2f first{1, 1}, last{0, 0};  // of the colour image, in fractions

  void add(const cv::Vec2f& place) {
    ++pixels;
    first = {std::min(first.x, place[0]), std::min(first.y, place[1])};
    last = {std::max(last.x, place[0]), std::max(last.y, place[1])};
  }
};

}  // namespace

std::vector<SeenObject> objectsInView(const RegionMap& regions, const SurfaceInColor& in_color,
                                      const std::function<ObjectId(RegionId)>& object_of, int least_pixels) {
  std::map<RegionId, ObjectId> objects;
  std::map<ObjectId, Sight> sights;
  std::size_t pixel = 0;
  for (int v = 0; v < regions.height; ++v) {
    for (int u = 0; u < regions.width; ++u) {
      const RegionId region = regions.regions[pixel++];
      if (!region || in_color.hidden.at<std::uint8_t>(v, u) != 0) continue;
      const auto [known, is_first] = objects.try_emplace(region);
      if (is_first) known->second = object_of(region);
      if (!known->second) continue;
      Sight& sight = sights[known->second];
      if (is_first) sight.regions.add(region);
      sight.add(in_color.places.at<cv::Vec2f>(v, u));
    }
  }
  const cv::Point2f half_pixel(0.5F / static_cast<float>(regions.width),
                               0.5F / static_cast<float>(regions.height));
  std::vector<SeenObject> seen;
  for (auto& [object, sight] : sights) {
    if (sight.pixels < least_pixels) continue;
    SeenObject one;
    one.object = object;
    one.regions = std::move(sight.regions);
    one.box = {sight.first - half_pixel, sight.last + half_pixel};
    seen.push_back(std::move(one));
  }
  return seen;
}

}  // namespace scantrove
