// Databases of rosbag2: SQLite's pages, and CDR messages.
#include "tests/fuzz/container_fuzz.h"
#include "tests/fuzz/small_recording.h"

namespace scantrove::test {

std::vector<std::string> seeds() {
  const TemporaryFolder folder;
  std::vector<std::string> databases;
  for (const bool is_compressed : {false, true}) {
    writeRosbag2(folder / "a.db3", smallRecording(true, is_compressed), is_compressed ? "zstd" : "");
    databases.push_back(readText(folder / "a.db3"));
  }
  return databases;
}

}  // namespace scantrove::test

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  scantrove::test::readContainer(data, size, "input.db3");
  return 0;
}
