// MCAP files: records, chunks, messages.
#include "tests/fuzz/container_fuzz.h"
#include "tests/fuzz/small_recording.h"

namespace scantrove::test {

std::vector<std::string> seeds() {
  return {mcapBytes(smallRecording(true)),
          mcapBytes(smallRecording(true, true), {"zstd", 2, false, true, "cdr"}),
          mcapBytes(smallRecording(false), {"", 0, false, false, "ros1"})};
}

}  // namespace scantrove::test

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  scantrove::test::readContainer(data, size, "input.mcap");
  return 0;
}
