#pragma once
#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <vector>

namespace cv {
class Mat;
}

namespace scantrove {

/// Painted pixels of an image as run lengths, row by row.
struct PaintedPixels {
  int width = 0, height = 0;
  /// Lengths of runs of pixels, alternately not painted and painted. Only the first may be 0. The rest of the
  /// image is not painted; empty: nothing is.
  std::vector<std::uint32_t> runs = {};

  /// `mask`: CV_8UC1, nonzero = painted.
  [[nodiscard]] static PaintedPixels of(const cv::Mat& mask);
  /// CV_8UC1, height x width, 255 = painted.
  [[nodiscard]] cv::Mat mask() const;

  [[nodiscard]] bool isEmpty() const { return runs.empty(); }

  /// The runs as LEB128 numbers.
  [[nodiscard]] std::string toBytes() const;
  /// None: malformed, or the runs exceed `width` x `height` pixels. Needs memory in proportion to `bytes`.
  [[nodiscard]] static std::optional<PaintedPixels> fromBytes(int width, int height,
                                                              std::span<const char> bytes);

  bool operator==(const PaintedPixels&) const = default;
};

}  // namespace scantrove
