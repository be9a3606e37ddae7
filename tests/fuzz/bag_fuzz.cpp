// ROS 1 bags: records, chunks, messages.
#include "tests/fuzz/container_fuzz.h"
#include "tests/fuzz/small_recording.h"

namespace scantrove::test {

std::vector<std::string> seeds() {
  return {bagBytes(smallRecording(false)), bagBytes(smallRecording(false, true), "lz4"),
          bagBytes(smallRecording(false), "bz2", 2, false)};
}

}  // namespace scantrove::test

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  scantrove::test::readContainer(data, size, "input.bag");
  return 0;
}
