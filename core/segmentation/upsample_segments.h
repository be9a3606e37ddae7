#pragma once
#include <cstdint>
#include <span>
#include <vector>

namespace scantrove {

/// A depth image of the same view at the resolution that is wanted.
struct DepthGuide {
  int width = 0;
  int height = 0;
  std::span<const std::uint16_t> depth;  ///< width * height, row by row; 0 = no reading
  float meters_per_unit = 0.001F;
};

/// Brings images of ids (segments, or regions of the same frame) to the resolution of a depth image. A pixel
/// with a reading takes the id of that pixel with a surface, at most 3 around its nearest, which is closest
/// in image and depth together: outlines follow the depth image, and the surface that the map misses along
/// depth edges is given back. Pixels without reading take the nearest.
class DepthUpsampler {
 public:
  /// `depths_m`: width * height, row by row, 0 = no surface. It and the guide's image outlive the upsampler.
  DepthUpsampler(std::span<const float> depths_m, int width, int height, const DepthGuide& guide);

  /// `ids`: width * height, 0 = none; segments or regions. Result: guide.width * guide.height.
  template <class Id>
  [[nodiscard]] std::vector<Id> apply(std::span<const Id> ids) const;
  template <class Id>
  [[nodiscard]] std::vector<Id> apply(const std::vector<Id>& ids) const {
    return apply(std::span<const Id>(ids));
  }

 private:
  static constexpr std::int32_t kNone = -1;
  /// A pixel around the nearest one. The exact place lies up to half a pixel off the nearest in x and y.
  struct Offset {
    int x, y;
    float least_distance_px;  // from the exact place
  };
  [[nodiscard]] static std::vector<Offset> searchOrder();
  /// The closest of the pixels that `is_usable(pixel)` for pixel (u, v) of the guide, or kNone.
  template <class Usable>
  [[nodiscard]] std::int32_t closest(int u, int v, const Usable& is_usable) const;

  std::span<const float> depths_m_;
  int width_, height_;
  DepthGuide guide_;
  std::vector<Offset> order_;               // from the inside out
  std::vector<int> nearest_x_, nearest_y_;  // for each column and row of the guide
  std::vector<std::int32_t> closest_;       // for each pixel of the guide, whatever its id
};

}  // namespace scantrove
