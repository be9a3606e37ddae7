#include "core/segmentation/upsample_segments.h"

#include "core/base/check.h"

namespace scantrove {
namespace {

/// For each of `size` target pixels the source pixel whose cell holds its centre: floor((t + 0.5) * source /
/// size).
std::vector<std::size_t> nearest(int source, int size) {
  std::vector<std::size_t> result(static_cast<std::size_t>(size));
  for (std::size_t t = 0; t < result.size(); ++t) {
    result[t] = (2 * t + 1) * static_cast<std::size_t>(source) / (2 * static_cast<std::size_t>(size));
  }
  return result;
}

}  // namespace

SegmentMap upsample(const SegmentMap& segments, int width, int height) {
  SCANTROVE_CHECK(width >= 0 && height >= 0);
  SegmentMap result;
  result.width = width;
  result.height = height;
  result.ids.assign(static_cast<std::size_t>(width) * static_cast<std::size_t>(height), 0);
  result.areas.assign(segments.areas.empty() ? 1 : segments.areas.size(), 0);
  if (segments.ids.empty()) {
    result.areas[0] = width * height;
    return result;
  }
  const std::vector<std::size_t> source_x = nearest(segments.width, width);
  const std::vector<std::size_t> source_y = nearest(segments.height, height);
  std::size_t target = 0;
  for (const std::size_t y : source_y) {
    const std::uint32_t* row = segments.ids.data() + y * static_cast<std::size_t>(segments.width);
    for (const std::size_t x : source_x) {
      result.ids[target++] = row[x];
      ++result.areas[row[x]];
    }
  }
  return result;
}

}  // namespace scantrove
