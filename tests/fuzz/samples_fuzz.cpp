// Sample files of the models' trainer (tools/train), with and without a last line that confirms them.
#include <spdlog/fmt/fmt.h>

#include "core/base/checksum.h"
#include "tests/fuzz/fuzz_target.h"
#include "tests/unit/training/made_samples.h"

namespace scantrove::test {

std::vector<std::string> seeds() {
  train::SceneSamples empty = madeSamples();
  empty.objectness.clear();
  empty.borders.clear();
  return {train::textOf(madeSamples()), train::textOf(empty), "scantrove samples 2\n"};
}

namespace {

void checkParsed(std::string_view text) {
  const auto samples = train::parseSamples(text, "samples.txt");
  require(samples || samples.error().what.find("samples.txt") != std::string::npos,
          "an error names the file");
  if (!samples) return;
  const std::string written = train::textOf(*samples);
  const auto again = train::parseSamples(written, "samples.txt");
  require(again && train::textOf(*again) == written, "samples are read as they were written");
}

}  // namespace
}  // namespace scantrove::test

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  using namespace scantrove;
  const std::string text(reinterpret_cast<const char*>(data), size);
  test::checkParsed(text);
  // What a checksum would stop is tried, too.
  const std::string before = text.substr(0, text.rfind("end "));
  test::checkParsed(before + fmt::format("end {:08x}\n", crc32Of(before)));
  return 0;
}
