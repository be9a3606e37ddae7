#pragma once
#include <opencv2/core/mat.hpp>
#include <span>
#include <vector>

#include "core/texturing/texture_surface.h"

namespace scantrove {

/// How well views show each face. The ideas are those of Waechter, Moehrle and Goesele 2014.
class ViewRatings {
 public:
  struct Rating {
    float quality = 0;  ///< comparable between views of one face
    ViewNumber view = kNoView;
  };
  /// More views of one face than these are forgotten, the worst first.
  static constexpr std::size_t kMaxPerFace = 8;

  /// `surface` outlives this.
  explicit ViewRatings(const TextureSurface& surface);

  /// Rates a view whose image (CV_8UC3, of the size of K) is at hand. It shows a face if all of the face is
  /// in front of other surface, away from the rim of the image, and seen from less than 80 degrees. The
  /// quality is the area in the image times sharpness and the cosine of the angle; it is less where the
  /// colour differs from that of the vertices, and beside nearer surface.
  void add(ViewNumber number, const TextureView& view, const cv::Mat& image);

  /// The views that show the face, best first.
  [[nodiscard]] std::span<const Rating> of(std::uint32_t face) const {
    return {ratings_.data() + kMaxPerFace * face, counts_[face]};
  }
  [[nodiscard]] std::size_t faces() const { return counts_.size(); }

 private:
  void insert(std::uint32_t face, const Rating& rating);

  const TextureSurface& surface_;
  std::vector<Rating> ratings_;  // kMaxPerFace for each face, the first of them in use
  std::vector<std::uint8_t> counts_;
};

}  // namespace scantrove
