// LZFSE data: blocks of all kinds.
#include "core/capture/lzfse_decoder.h"

#include "tests/fuzz/fuzz_target.h"
#include "tests/support/zip_bytes.h"

namespace scantrove::test {

std::vector<std::string> seeds() {
  const std::string lzvn(
      "\x88\x02"
      "ab\x46"
      "c\xF5",
      7);
  // A header of entropy codes: sizes and states, then frequencies, literals and matches.
  const std::string fse = "bvx2" + littleEndianBytes(316, 4) + littleEndianBytes(0x7000010000100004, 8) +
                          littleEndianBytes(0x3000020000000000, 8) + littleEndianBytes(32 + 90, 8) +
                          std::string(90, '\x2F') + std::string(3, '\x55');
  return {storedLzfse("depth"),
          "bvxn" + littleEndianBytes(15, 4) + littleEndianBytes(lzvn.size(), 4) + lzvn + "bvx$",
          fse + "bvx$"};
}

}  // namespace scantrove::test

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  using namespace scantrove;
  constexpr std::size_t kMaxBytes = 1 << 16;
  const auto decoded = decodeLzfse({reinterpret_cast<const char*>(data), size}, kMaxBytes, "input");
  test::require(decoded ? decoded->size() <= kMaxBytes : !decoded.error().what.empty(),
                "decoded data is no larger than allowed, an error has words");
  return 0;
}
