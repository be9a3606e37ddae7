#pragma once
#include <cstdint>
#include <span>
#include <vector>

namespace scantrove {

/// A depth image of the same view at the target resolution.
struct DepthGuide {
  int width = 0;
  int height = 0;
  std::span<const std::uint16_t> depth;  ///< width * height, row by row; 0 = no reading
  float meters_per_unit = 0.001F;
};

/// Upsamples images of ids (segments or regions of one frame) to the resolution of a depth image. A pixel
/// with a reading takes the id of the closest surface pixel in image and depth together, up to 3 pixels from
/// its nearest one. So outlines follow the depth image, and surface missing from the map along depth edges
/// gets ids. Pixels without reading take the nearest id.
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
  /// A pixel around the nearest one. The exact position is up to half a pixel off the nearest in x and y.
  struct Offset {
    int x, y;
    float least_distance_px;  // from the exact position
  };
  [[nodiscard]] static std::vector<Offset> searchOrder();
  /// The closest pixel with `is_usable(pixel)` for pixel (u, v) of the guide, or kNone.
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
