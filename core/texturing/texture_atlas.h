#pragma once
#include <functional>
#include <map>
#include <opencv2/core/mat.hpp>
#include <span>
#include <utility>
#include <vector>

#include "core/texturing/atlas_plan.h"

namespace scantrove {

/// An image at the sizes that textures need, each computed once.
class ResizedImages {
 public:
  explicit ResizedImages(cv::Mat image) : image_(std::move(image)) {}
  [[nodiscard]] const cv::Mat& at(const cv::Size& size);

 private:
  cv::Mat image_;
  std::map<std::pair<int, int>, cv::Mat> resized_;
};

/// What is added to the colours at the corners of a face: one column for each, blue, green, red.
using CornerOffsets = std::function<Eigen::Matrix3f(std::uint32_t face)>;

/// The texture of some faces of a surface, which outlives it.
class TextureAtlas {
 public:
  TextureAtlas(const ViewedSurface& viewed, TextureCharts cut, AtlasPlan plan);

  /// Copies the charts of a view from its image.
  void paint(ViewNumber view, ResizedImages& image);
  /// Adds offsets, interpolated within faces, then repeats the rims of charts. `offsets` may be empty.
  void finish(const CornerOffsets& offsets);

  /// CV_8UC3, BGR.
  [[nodiscard]] const cv::Mat& image() const { return image_; }
  [[nodiscard]] const TextureCharts& cut() const { return cut_; }
  [[nodiscard]] const AtlasPlan& plan() const { return plan_; }
  /// Of `faces`, all of this texture, in their order.
  [[nodiscard]] std::vector<FaceTexture> textureOf(std::span<const std::uint32_t> faces) const;

 private:
  /// Texels of the corners of a chart's face; centres are integers.
  [[nodiscard]] FaceTexture texelsOf(std::size_t chart, std::uint32_t face,
                                     const ViewProjection& projection) const;
  void paintCells();
  [[nodiscard]] FaceTexture cellOf(std::size_t number) const;
  void levelChart(std::size_t chart, const CornerOffsets& offsets, cv::Mat& is_covered);
  void repeatRim(const cv::Rect& rect, cv::Mat& is_covered);

  const ViewedSurface& viewed_;
  TextureCharts cut_;
  AtlasPlan plan_;
  cv::Mat image_;
};

}  // namespace scantrove
