#pragma once
// libjpeg's headers need these before them.
#include <cstddef>
#include <cstdio>

#include <csetjmp>

#include <jpeglib.h>

namespace scantrove {

/// libjpeg leaves a function that fails by longjmp, so whatever calls it between setjmp and its return has no
/// object with a destructor.
struct JpegErrorHandler {
  jpeg_error_mgr base;
  std::jmp_buf on_error;
  char reason[JMSG_LENGTH_MAX];
};

[[noreturn]] inline void leaveJpeg(j_common_ptr jpeg) {
  auto* const handler = reinterpret_cast<JpegErrorHandler*>(jpeg->err);
  jpeg->err->format_message(jpeg, handler->reason);
  std::longjmp(handler->on_error, 1);
}

}  // namespace scantrove
