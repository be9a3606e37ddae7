#pragma once
#include <filesystem>
#include <memory>
#include <opencv2/core/mat.hpp>

#include "core/base/result.h"

namespace scantrove {

/// Pictures of a video file (MP4, MOV, Matroska; H.264, HEVC, MJPEG, ...), decoded by libavcodec as they are
/// asked for. Nothing but the file itself is opened. One thread at a time.
class VideoFrames {
 public:
  /// Opens nothing yet; frame() does.
  explicit VideoFrames(std::filesystem::path file);
  VideoFrames(const VideoFrames&) = delete;
  VideoFrames& operator=(const VideoFrames&) = delete;
  ~VideoFrames();

  /// The picture at `position`, counted from 0 in order of presentation: CV_8UC3, BGR, as stored (a tag that
  /// rotates the display is ignored). Decodes all pictures between the last one and this; a smaller position
  /// starts over. Error: names the file; damaged, too large (see image_header.h), or the video is shorter.
  [[nodiscard]] Result<cv::Mat> frame(int position);

 private:
  class Decoder;
  std::filesystem::path file_;
  std::unique_ptr<Decoder> decoder_;
  int next_ = 0;  ///< position of the picture that the decoder returns next
  cv::Mat last_;  ///< of position next_ - 1
};

}  // namespace scantrove
