#include "core/capture/lzfse_block.h"

#include <cstdint>

namespace scantrove {

namespace {

constexpr unsigned kSmallestMatch = 3;  ///< added to the lengths of opcodes with a distance
constexpr unsigned kLongLength = 16;    ///< added to lengths that have a byte of their own

/// Reads opcodes. Their bits, from the highest:
///   LLMMMDDD D8         L literals, match of M + 3 at a distance of 11 bits (the low three not 110, 111)
///   LLMMM110            the same at the last distance
///   LLMMM111 D16        the same at a distance of 16 bits
///   101LLMMM DDDDDDMM D8   five bits of length, low two in the second byte; distance of 14 bits
///   1110LLLL, 11100000 L8  literals only;  1111MMMM, 11110000 M8  a match only, at the last distance
/// 00000110 ends the block; 00001110 and 00010110 do nothing; others are undefined.
class LzvnReader {
 public:
  explicit LzvnReader(std::string_view payload) : payload_(payload) {}

  [[nodiscard]] bool decode(std::size_t end, std::string& decoded) {
    while (decoded.size() < end) {
      if (!readOpcode() || literals_ > payload_.size() || literals_ > end - decoded.size()) return false;
      decoded += payload_.substr(0, literals_);
      payload_.remove_prefix(literals_);
      if (!appendMatch(decoded, length_, distance_, end)) return false;
    }
    return true;
  }

 private:
  /// Sets what the next opcode says, and steps over its bytes. False: truncated, undefined, or the end.
  [[nodiscard]] bool readOpcode() {
    literals_ = length_ = 0;
    const unsigned opcode = byteAt(0);
    if (opcode >= 0xF0) return readLength(opcode & 0xFU, length_);
    if (opcode >= 0xE0) return readLength(opcode & 0xFU, literals_);
    if (opcode == 0x0E || opcode == 0x16) return skip(1);
    const bool is_medium = opcode >= 0xA0 && opcode < 0xC0;
    if ((opcode >= 0x70 && opcode < 0x80) || (opcode >= 0xD0 && opcode < 0xE0)) return false;
    if (!is_medium && opcode < 0x40 && (opcode & 7U) == 6)
      return false;  // no literals: the end, or undefined
    if (is_medium) {
      const unsigned second = byteAt(1);
      literals_ = opcode >> 3U & 3U;
      length_ = ((opcode & 7U) << 2U | (second & 3U)) + kSmallestMatch;
      distance_ = second >> 2U | byteAt(2) << 6U;
      return skip(3);
    }
    literals_ = opcode >> 6U;
    length_ = (opcode >> 3U & 7U) + kSmallestMatch;
    const unsigned kind = opcode & 7U;
    if (kind == 6) return skip(1);
    distance_ = kind == 7 ? byteAt(1) | byteAt(2) << 8U : kind << 8U | byteAt(1);
    return skip(kind == 7 ? 3 : 2);
  }

  /// A length of four bits, or, where they are 0, of the next byte.
  [[nodiscard]] bool readLength(unsigned bits, unsigned& length) {
    length = bits != 0 ? bits : byteAt(1) + kLongLength;
    return skip(bits != 0 ? 1 : 2);
  }

  [[nodiscard]] unsigned byteAt(std::size_t i) const {
    return i < payload_.size() ? static_cast<unsigned char>(payload_[i]) : 0U;
  }
  [[nodiscard]] bool skip(std::size_t count) {
    if (count > payload_.size()) return false;
    payload_.remove_prefix(count);
    return true;
  }

  std::string_view payload_;
  unsigned literals_ = 0, length_ = 0, distance_ = 0;
};

}  // namespace

bool decodeLzvnBlock(std::string_view payload, std::size_t end, std::string& decoded) {
  return LzvnReader(payload).decode(end, decoded);
}

}  // namespace scantrove
