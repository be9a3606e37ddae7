// The structure of an .oni file, which is checked before OpenNI2 opens the file. For records inside, see the
// test of damaged recordings in tests/unit/capture.
#include "core/capture/oni_file.h"
#include "tests/fuzz/fuzz_target.h"
#include "tests/support/oni_bytes.h"

namespace scantrove::test {

std::vector<std::string> seeds() { return {oniBytes(), oniBytes("ExtendedSerialization")}; }

}  // namespace scantrove::test

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  using namespace scantrove;
  static const test::TemporaryFolder folder;
  const auto file = test::rewrite(folder, "input.oni", {reinterpret_cast<const char*>(data), size});
  const auto checked = checkOniFile(file);
  test::require(checked || checked.error().what.starts_with(file.string()), "an error names the file");
  return 0;
}
