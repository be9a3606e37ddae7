#pragma once
#include <filesystem>
#include <memory>
#include <opencv2/core/mat.hpp>
#include <string>
#include <vector>

#include "core/base/result.h"

namespace scantrove {

/// Where a labelled image of NYUv2 comes from.
struct NyuOrigin {
  std::string scene;       ///< such as bedroom_0001; not empty
  std::string depth_file;  ///< raw depth image, such as bedroom_0001/d-1294886360.208451-2996770081.pgm
};

/// The labelled images of NYUv2: `nyu_depth_v2_labeled.mat`, which MATLAB 7.3 stores as HDF5. MATLAB counts
/// columns first, so HDF5 has every image transposed; this class returns images as they are seen. One thread.
class NyuLabeledFile {
 public:
  /// Reads sizes and origins; images are read one by one. Error: names the file, and what is missing,
  /// damaged or beyond the limits (8192 pixels a side, 100,000 images).
  [[nodiscard]] static Result<NyuLabeledFile> open(const std::filesystem::path& file);
  NyuLabeledFile(NyuLabeledFile&&) noexcept;
  NyuLabeledFile& operator=(NyuLabeledFile&&) noexcept;
  ~NyuLabeledFile();

  /// One for each image.
  [[nodiscard]] const std::vector<NyuOrigin>& origins() const { return origins_; }
  [[nodiscard]] cv::Size imageSize() const { return size_; }

  /// Class of each pixel; 0: not labelled. `image` counts from 0. Error: names the file and the image.
  [[nodiscard]] Result<cv::Mat1w> labels(std::size_t image) const;
  /// Instance within its class of each pixel; 0: none.
  [[nodiscard]] Result<cv::Mat1w> instances(std::size_t image) const;
  /// Depth seen from the colour camera in metres, with estimates where the camera has no reading.
  [[nodiscard]] Result<cv::Mat1f> depth(std::size_t image) const;

 private:
  struct Contents;
  explicit NyuLabeledFile(std::unique_ptr<Contents> contents);

  std::unique_ptr<Contents> contents_;
  std::vector<NyuOrigin> origins_;
  cv::Size size_;
};

}  // namespace scantrove
