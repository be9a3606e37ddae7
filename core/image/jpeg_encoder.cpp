#include "core/image/jpeg_encoder.h"

#include <turbojpeg.h>

#include <memory>
#include <stdexcept>
#include <type_traits>

#include "core/base/check.h"

namespace scantrove {

std::string encodeJpeg(const cv::Mat& bgr, int quality) {
  SCANTROVE_CHECK(bgr.type() == CV_8UC3 && !bgr.empty());
  const std::unique_ptr<std::remove_pointer_t<tjhandle>, decltype(&tjDestroy)> encoder(tjInitCompress(),
                                                                                       &tjDestroy);
  unsigned char* bytes = nullptr;
  unsigned long size = 0;
  const int result = tjCompress2(encoder.get(), bgr.data, bgr.cols, static_cast<int>(bgr.step), bgr.rows,
                                 TJPF_BGR, &bytes, &size, TJSAMP_420, quality, TJFLAG_ACCURATEDCT);
  const std::unique_ptr<unsigned char, decltype(&tjFree)> owned(bytes, &tjFree);
  if (result != 0)
    throw std::runtime_error(std::string("an image could not be encoded (") + tjGetErrorStr2(encoder.get()) +
                             ")");
  return {reinterpret_cast<const char*>(bytes), size};
}

}  // namespace scantrove
