#pragma once
#include <filesystem>
#include <memory>
#include <opencv2/core/mat.hpp>

#include "core/base/result.h"

namespace scantrove {

/// Writes a WebM video (VP9, else VP8) of images of one size. One thread.
class VideoWriter {
 public:
  /// Creates `file`, which must not exist. Error: names it; no encoder, or it cannot be written.
  [[nodiscard]] static Result<VideoWriter> create(const std::filesystem::path& file, int width, int height,
                                                  int frames_per_second);
  VideoWriter(VideoWriter&&) noexcept;
  VideoWriter& operator=(VideoWriter&&) noexcept;
  ~VideoWriter();

  /// Adds the next image: CV_8UC3, BGR, of the video's size.
  [[nodiscard]] Result<void> add(const cv::Mat& image);
  /// Writes what is left, and the end of the file. Nothing may be added then.
  [[nodiscard]] Result<void> finish();

 private:
  class Encoder;
  explicit VideoWriter(std::unique_ptr<Encoder> encoder);
  std::unique_ptr<Encoder> encoder_;
};

}  // namespace scantrove
