// A library of its own, which other_formats.cpp loads.
#include <cstdio>
#include <exception>
#include <opencv2/core/utils/logger.hpp>
#include <opencv2/imgcodecs.hpp>

#include "core/image/other_formats_abi.h"

extern "C" [[gnu::visibility("default")]] int scantroveDecodeOtherFormat(const std::uint8_t* bytes,
                                                                         std::size_t size, int to_color,
                                                                         void* image, char* reason,
                                                                         std::size_t reason_size) {
  // What OpenCV would print we say better ourselves.
  cv::utils::logging::setLogLevel(cv::utils::logging::LOG_LEVEL_SILENT);
  try {
    const cv::Mat input(1, static_cast<int>(size), CV_8UC1, const_cast<std::uint8_t*>(bytes));
    const int how = to_color != 0 ? cv::IMREAD_COLOR | cv::IMREAD_IGNORE_ORIENTATION : cv::IMREAD_UNCHANGED;
    cv::Mat& decoded = *static_cast<cv::Mat*>(image);
    decoded = cv::imdecode(input, how);
    if (!decoded.empty()) return 0;
    std::snprintf(reason, reason_size, "it is damaged");
  } catch (const std::exception& exception) {
    std::snprintf(reason, reason_size, "%s", exception.what());
  }
  return 1;
}
