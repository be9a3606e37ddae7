// The stream of the app Record3D over USB: messages, their headers and images.
#include "core/capture/live/record3d_message.h"
#include "tests/fuzz/fuzz_target.h"
#include "tests/support/record3d_bytes.h"

namespace scantrove::test {

std::vector<std::string> seeds() {
  Record3dBytes with_confidence, of_faces;
  with_confidence.confidence = std::string(12, '\2');
  of_faces.device = 0;
  of_faces.other.clear();
  return {Record3dBytes().bytes(), with_confidence.bytes() + of_faces.bytes()};
}

}  // namespace scantrove::test

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  using namespace scantrove;
  const std::string_view bytes(reinterpret_cast<const char*>(data), size);
  Record3dMessages messages;
  messages.add(bytes.substr(0, size / 2));
  messages.add(bytes.substr(size / 2));
  while (true) {
    const auto message = messages.next();
    test::require(message || !message.error().what.empty(), "an error has words");
    if (!message || !*message) return 0;
    const auto frame = decodeRecord3dMessage(**message, "frame");
    if (!frame) {
      test::require(!frame.error().what.empty(), "an error has words");
      continue;
    }
    test::require(!frame->color.empty() && frame->depth_m.type() == CV_32FC1 && !frame->depth_m.empty(),
                  "a frame has colour and depth");
    test::require(frame->confidence.empty() || frame->confidence.size() == frame->depth_m.size(),
                  "confidence has the size of depth");
    test::require(frame->color_K.width == frame->color.cols && frame->color_K.height == frame->color.rows,
                  "the camera has the size of the colour image");
    test::require(!frame->pose || frame->pose->matrix().allFinite(), "a pose is finite");
  }
}
