#include "core/capture/lzfse_decoder.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <array>
#include <bit>
#include <vector>

#include "tests/support/zip_bytes.h"

namespace scantrove {
namespace {

using namespace test;
using testing::HasSubstr;

constexpr std::size_t kPlenty = 1 << 20;

std::string decoded(const std::string& bytes) {
  const auto result = decodeLzfse(bytes, kPlenty, "x");
  return result ? *result : "error: " + result.error().what;
}

std::string lzvn(const std::string& payload, std::size_t length) {
  return "bvxn" + littleEndianBytes(length, 4) + littleEndianBytes(payload.size(), 4) + payload + "bvx$";
}

TEST(LzfseDecoder, ReadsStoredBlocks) {
  EXPECT_EQ(decoded(storedLzfse("depth")), "depth");
  EXPECT_EQ(decoded("bvx-" + littleEndianBytes(2, 4) + "ab" + storedLzfse("cd")), "abcd");
  EXPECT_EQ(decoded("bvx$"), "");
}

// Opcodes by hand, from their bits.
TEST(LzfseDecoder, ReadsLzvnOpcodes) {
  EXPECT_EQ(decoded(lzvn("\xE3"
                         "abc",
                         3)),
            "abc")
      << "literals only";
  EXPECT_EQ(decoded(lzvn(std::string("\xE0\x04", 2) + std::string(20, 'z'), 20)), std::string(20, 'z'))
      << "many literals: 16 and the byte";
  // 2 literals, match of 3 + 1 at the distance of 2: LL = 10, MMM = 001, DDD = 000, D8 = 2.
  EXPECT_EQ(decoded(lzvn(std::string("\x88\x02"
                                     "ab",
                                     4),
                         6)),
            "ababab");
  // The same with 16 bits of distance: DDD = 111.
  EXPECT_EQ(decoded(lzvn(std::string("\x8F\x02\x00"
                                     "ab",
                                     5),
                         6)),
            "ababab");
  // 101LLMMM DDDDDDMM D8: LL = 10, length 00001 + 3, distance 2.
  EXPECT_EQ(decoded(lzvn(std::string("\xB0\x09\x00"
                                     "ab",
                                     5),
                         6)),
            "ababab");
  // Then one literal and 3 at the last distance (LL = 01, MMM = 000, 110), then a match of 5 at that
  // distance.
  EXPECT_EQ(decoded(lzvn(std::string("\x88\x02"
                                     "ab"
                                     "\x46"
                                     "c"
                                     "\xF5",
                                     7),
                         15)),
            "abababcbcbcbcbc");
}

TEST(LzfseDecoder, RefusesDamagedData) {
  for (const std::string& bytes :
       {std::string(), std::string("bvx-"), std::string("bvx2 and more that is none"),
        storedLzfse("depth").substr(0, 10),
        lzvn("\x88\x09"
             "ab",
             6),  // beyond the start
        lzvn("\xE3"
             "abc",
             4),
        lzvn("\x70", 4), lzvn("\x06", 4), std::string(64, 'b'),
        "bvx2" + littleEndianBytes(64, 4) + std::string(80, '\xFF')})
    EXPECT_THAT(decoded(bytes), testing::StartsWith("error: x"));
}

TEST(LzfseDecoder, AllocatesNoMoreThanAllowed) {
  const auto result = decodeLzfse("bvx-" + littleEndianBytes(0xFFFFFFF0, 4) + "x", 100, "rgbd/0.depth");
  ASSERT_FALSE(result);
  EXPECT_THAT(result.error().what, HasSubstr("rgbd/0.depth"));
}

/// Writes bits from low to high; the decoder reads them from the end.
class BitWriter {
 public:
  void push(std::uint32_t value, unsigned count) {
    for (unsigned i = 0; i < count; ++i) bits_.push_back((value >> i & 1U) != 0);
  }
  [[nodiscard]] std::string bytes() const {
    std::string bytes((bits_.size() + 7) / 8, '\0');
    for (std::size_t i = 0; i < bits_.size(); ++i) {
      if (bits_[i]) bytes[i / 8] = static_cast<char>(static_cast<unsigned char>(bytes[i / 8]) | 1U << i % 8);
    }
    return bytes;
  }
  /// Used bits of the last byte, less 1.
  [[nodiscard]] unsigned lastBits() const {
    return bits_.empty() ? 7 : static_cast<unsigned>((bits_.size() + 7) % 8);
  }

 private:
  std::vector<bool> bits_;
};

/// A block of `repeats` times `unit` (four letters, all different): literals, then one match. Each alphabet
/// has symbols of equal frequency, so that a state is symbol * frequency + rest and one step reads
/// log2(frequency) bits.
std::string fseBlock(const std::string& unit, unsigned match_bytes_to_add) {
  // Four letters of 256 states each: a state of 1,024 is letter * 256 + rest; a step reads 2 bits.
  // 1024 / 256 = 4 states a symbol step: next state = (256 + j) * 4 - 1024 + bits, j = place among the
  // letter's.
  BitWriter literals;
  std::array<unsigned, 4> states{};
  for (unsigned i = 0; i < 4; ++i) {
    states[i] = i * 256;  // symbol i, j = 0
    literals.push(0, 2);  // the state after it, which nobody uses
  }
  // Literal lengths: only symbol 4, match lengths: only symbol 19 (312 + 11 bits), distances: only symbol 4
  // (4 + 1 bit). One symbol has all states: no bits for the next state.
  BitWriter matches;
  matches.push(0, 1);                    // distance 4 + 0, read last
  matches.push(match_bytes_to_add, 11);  // length 312 + these
  std::string frequencies;
  BitWriter table;
  const auto frequency = [&](unsigned value) {  // the prefix code of the header
    if (value == 0) return table.push(0, 2);
    table.push(15, 4);  // 14 bits: 1111 and ten bits of value - 24
    table.push(value - 24, 10);
  };
  for (int i = 0; i < 20; ++i) frequency(i == 4 ? 64 : 0);
  for (int i = 0; i < 20; ++i) frequency(i == 19 ? 64 : 0);
  for (int i = 0; i < 64; ++i) frequency(i == 4 ? 256 : 0);
  std::vector<unsigned> letters(256, 0);
  for (const char letter : unit) letters[static_cast<unsigned char>(letter)] = 256;
  for (const unsigned value : letters) frequency(value);
  frequencies = table.bytes();
  const std::string literal_bytes = literals.bytes(), match_bytes = matches.bytes();
  const std::uint64_t a = 4 | std::uint64_t{literal_bytes.size()} << 20 | std::uint64_t{1} << 40 |
                          std::uint64_t{literals.lastBits()} << 60;
  std::uint64_t b = std::uint64_t{match_bytes.size()} << 40 | std::uint64_t{matches.lastBits()} << 60;
  for (unsigned i = 0; i < 4; ++i) b |= std::uint64_t{states[i]} << 10 * i;
  const std::uint64_t c = 32 + frequencies.size();  // all states 0
  return "bvx2" + littleEndianBytes(4 + 312 + match_bytes_to_add, 4) + littleEndianBytes(a, 8) +
         littleEndianBytes(b, 8) + littleEndianBytes(c, 8) + frequencies + literal_bytes + match_bytes +
         "bvx$";
}

TEST(LzfseDecoder, ReadsEntropyCodedBlocks) {
  for (const unsigned added : {0U, 4U, 1000U}) {
    std::string expected;
    while (expected.size() < 4 + 312 + added) expected += "abcd";
    EXPECT_EQ(decoded(fseBlock("abcd", added)), expected) << added;
  }
}

TEST(LzfseDecoder, RefusesTruncatedEntropyCodedBlocks) {
  const std::string block = fseBlock("abcd", 4);
  for (std::size_t size = 0; size + 4 < block.size(); size += 3)
    EXPECT_THAT(decoded(block.substr(0, size)), testing::StartsWith("error: x")) << size;
}

}  // namespace
}  // namespace scantrove
