#pragma once
#include <filesystem>
#include <opencv2/core/mat.hpp>
#include <opencv2/dnn/dnn.hpp>
#include <optional>
#include <string>
#include <vector>

#include "core/base/result.h"
#include "core/catalogue/view_descriptor.h"

namespace scantrove {

/// A network of the user that turns the picture of an object into a vector; optional evidence of recognition.
/// `FILE.onnx` is read by OpenCV. `FILE.json` beside it says what the network takes:
///
///     {"input": [224, 224], "mean": [123.7, 116.3, 103.5], "scale": 0.0171, "rgb": true, "unrelated": 0.8}
///
/// input: width and height in pixels. mean: subtracted from each channel (0 .. 255) before multiplying by
/// scale, in the network's order of channels. rgb: that order is red, green, blue (default), else blue,
/// green, red. unrelated: the cosine distance of unrelated objects, 1 by default. One thread.
class AppearanceNetwork {
 public:
  /// Takes up to seconds. Error: a file is missing or invalid, or the network has a layer that OpenCV does
  /// not know.
  [[nodiscard]] static Result<AppearanceNetwork> load(const std::filesystem::path& file);

  /// SHA-256 of both files, in hexadecimal digits.
  [[nodiscard]] const std::string& hash() const { return hash_; }

  /// `color` (CV_8UC3 BGR) and `mask` (CV_8UC1) share any size. The background is the mean, and the picture
  /// is padded with it to the network's shape. None: no colour, no object pixel, or a vector of length 0.
  [[nodiscard]] std::optional<NetworkVector> describe(const cv::Mat& color, const cv::Mat& mask);

  /// Cosine distance relative to that of unrelated objects: 0 = the same. None: a vector is missing, or
  /// another network's.
  [[nodiscard]] std::optional<float> distance(const std::optional<NetworkVector>& a,
                                              const std::optional<NetworkVector>& b) const;

 private:
  struct Input {
    cv::Size size_px;
    cv::Scalar mean;  // in the network's order of channels
    double scale = 1;
    bool is_rgb = true;
    float unrelated = 1;
  };

  [[nodiscard]] static Result<Input> readInput(const std::filesystem::path& file, const std::string& json);
  /// The output for a picture of the network's size; throws std::exception.
  [[nodiscard]] std::vector<float> run(const cv::Mat& picture);

  cv::dnn::Net net_;
  Input input_;
  std::string hash_;
};

}  // namespace scantrove
