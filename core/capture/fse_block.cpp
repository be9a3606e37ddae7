#include <algorithm>
#include <array>
#include <bit>
#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include "core/capture/lzfse_block.h"

namespace scantrove {

namespace {

constexpr std::size_t kFixedHeaderBytes = 32;
/// Symbols and states of the four alphabets: literal lengths, match lengths, distances, literals.
constexpr std::size_t kLengthSymbols = 20, kDistanceSymbols = 64, kLiteralSymbols = 256;
constexpr unsigned kLengthStates = 64, kDistanceStates = 256, kLiteralStates = 1024;

/// Bits that follow the symbols of a length of literals, of a match, of a distance. A symbol stands for the
/// values from where the previous one ends.
constexpr std::array<std::uint8_t, kLengthSymbols> kLiteralLengthBits{0, 0, 0, 0, 0, 0, 0, 0, 0, 0,
                                                                      0, 0, 0, 0, 0, 0, 2, 3, 5, 8};
constexpr std::array<std::uint8_t, kLengthSymbols> kMatchLengthBits{0, 0, 0, 0, 0, 0, 0, 0, 0, 0,
                                                                    0, 0, 0, 0, 0, 0, 3, 5, 8, 11};
constexpr auto kDistanceBits = [] {
  std::array<std::uint8_t, kDistanceSymbols> bits{};
  for (std::size_t i = 0; i < bits.size(); ++i) bits[i] = static_cast<std::uint8_t>(i / 4);
  return bits;
}();

std::uint64_t littleEndian(std::string_view bytes, std::size_t at) {
  std::uint64_t value = 0;
  for (std::size_t i = 0; i < 8 && at + i < bytes.size(); ++i)
    value |= std::uint64_t{static_cast<unsigned char>(bytes[at + i])} << 8 * i;
  return value;
}

/// `count` bits of `value` from bit `first`.
constexpr std::uint32_t bitsOf(std::uint64_t value, unsigned first, unsigned count) {
  return static_cast<std::uint32_t>(value >> first & ((std::uint64_t{1} << count) - 1));
}

/// Reads bits from the end of its bytes to their start.
class BackwardBits {
 public:
  /// `unused`: bits of the last byte, at its top, that are not part of the stream.
  BackwardBits(std::string_view bytes, unsigned unused)
      : bytes_(bytes), at_(static_cast<std::int64_t>(bytes.size()) * 8 - unused) {}

  /// `count`: at most 32. 0 and a failed stream if there are not so many.
  std::uint32_t pull(unsigned count) {
    at_ -= count;
    if (at_ < 0) return 0;
    const auto at = static_cast<std::size_t>(at_);
    return bitsOf(littleEndian(bytes_, at / 8), static_cast<unsigned>(at % 8), count);
  }
  [[nodiscard]] bool isFailed() const { return at_ < 0; }

 private:
  std::string_view bytes_;
  std::int64_t at_;
};

/// What a state of the decoder stands for.
struct FseEntry {
  std::uint32_t base = 0;       ///< smallest value
  std::uint8_t extra_bits = 0;  ///< of the value, above `base`
  std::uint8_t state_bits = 0;  ///< of the next state, above `next`
  std::int32_t next = 0;
};

/// A decoder of one alphabet: a symbol of frequency f (of as many as there are states) has f states.
class FseTable {
 public:
  FseTable(std::span<const std::uint16_t> frequencies, unsigned states,
           std::span<const std::uint8_t> extra_bits)
      : states_(states) {
    entries_.reserve(states);
    std::uint32_t base = 0;
    for (std::size_t symbol = 0; symbol < frequencies.size(); ++symbol) {
      const unsigned extra = extra_bits.empty() ? 0 : extra_bits[symbol];
      addSymbol(frequencies[symbol], base, static_cast<std::uint8_t>(extra));
      base += 1U << extra;
    }
  }

  /// Whether there are no more symbols than states.
  [[nodiscard]] bool isValid() const { return entries_.size() <= states_; }

  /// The value of `state`, which becomes the next. Empty: the state has none.
  [[nodiscard]] std::optional<std::uint32_t> decode(std::uint32_t& state, BackwardBits& bits) const {
    if (state >= entries_.size()) return std::nullopt;
    const FseEntry& entry = entries_[state];
    state = static_cast<std::uint32_t>(entry.next + static_cast<std::int32_t>(bits.pull(entry.state_bits)));
    return entry.base + bits.pull(entry.extra_bits);
  }

 private:
  void addSymbol(unsigned frequency, std::uint32_t base, std::uint8_t extra) {
    if (frequency == 0 || frequency > states_) return;
    const int shift = std::bit_width(states_) - std::bit_width(frequency);
    const unsigned wide = (2 * states_ >> shift) - frequency;  // states that need all `shift` bits
    for (unsigned j = 0; j < frequency && entries_.size() <= states_; ++j) {
      const bool is_wide = j < wide;
      const int bits = is_wide ? shift : shift - 1;
      const auto next =
          is_wide ? static_cast<std::int32_t>((frequency + j) << shift) - static_cast<std::int32_t>(states_)
                  : static_cast<std::int32_t>((j - wide) << bits);
      entries_.push_back({base, extra, static_cast<std::uint8_t>(bits), next});
    }
  }

  unsigned states_;
  std::vector<FseEntry> entries_;
};

/// The frequencies in a header: a prefix code of 2 to 14 bits each, lowest bit first.
class FrequencyReader {
 public:
  explicit FrequencyReader(std::string_view bytes) : bytes_(bytes) {}

  [[nodiscard]] bool read(std::span<std::uint16_t> frequencies) {
    for (std::uint16_t& frequency : frequencies) frequency = next();
    return at_ <= bytes_.size() * 8;
  }

 private:
  std::uint16_t next() {
    const auto code = static_cast<std::uint32_t>(littleEndian(bytes_, at_ / 8) >> at_ % 8);
    const auto take = [&](unsigned length, std::uint32_t value) {
      at_ += length;
      return static_cast<std::uint16_t>(value);
    };
    switch (code & 7U) {  // the low bits say how many there are
      case 0:
      case 4:
        return take(2, 0);
      case 2:
      case 6:
        return take(2, 1);
      case 1:
        return take(3, 2);
      case 5:
        return take(3, 3);
      case 3:
        return take(5, 4 + (code >> 3U & 3U));
      default:
        return (code & 8U) == 0 ? take(8, 8 + (code >> 4U & 0xFU)) : take(14, 24 + (code >> 4U & 0x3FFU));
    }
  }

  std::string_view bytes_;
  std::size_t at_ = 0;  ///< bits
};

/// The fixed part of a block's header.
struct FseHeader {
  std::uint32_t literals, literal_bytes, matches, literal_bits, match_bytes, match_bits, header_bytes;
  std::array<std::uint32_t, 4> literal_states;
  std::uint32_t length_state, match_state, distance_state;
};

FseHeader headerOf(std::string_view block) {
  const std::uint64_t a = littleEndian(block, 8), b = littleEndian(block, 16), c = littleEndian(block, 24);
  return {.literals = bitsOf(a, 0, 20),
          .literal_bytes = bitsOf(a, 20, 20),
          .matches = bitsOf(a, 40, 20),
          .literal_bits = bitsOf(a, 60, 3),
          .match_bytes = bitsOf(b, 40, 20),
          .match_bits = bitsOf(b, 60, 3),
          .header_bytes = bitsOf(c, 0, 32),
          .literal_states = {bitsOf(b, 0, 10), bitsOf(b, 10, 10), bitsOf(b, 20, 10), bitsOf(b, 30, 10)},
          .length_state = bitsOf(c, 32, 10),
          .match_state = bitsOf(c, 42, 10),
          .distance_state = bitsOf(c, 52, 10)};
}

/// Fields of bits hold the number of used bits of the last byte, less 1: 7 means all.
constexpr unsigned unusedBits(std::uint32_t field) { return 7 - field; }

/// Four decoders take turns. Empty: damaged.
std::optional<std::string> decodeLiterals(const FseHeader& header, std::string_view bytes,
                                          const FseTable& table) {
  std::string literals;
  literals.reserve(header.literals);
  BackwardBits bits(bytes, unusedBits(header.literal_bits));
  auto states = header.literal_states;
  for (std::uint32_t i = 0; i < header.literals; ++i) {
    const auto value = table.decode(states[i % 4], bits);
    if (!value || bits.isFailed()) return std::nullopt;
    literals += static_cast<char>(*value);
  }
  return literals;
}

struct MatchTables {
  FseTable lengths, matches, distances;
};

bool decodeMatches(const FseHeader& header, std::string_view bytes, std::string_view literals,
                   const MatchTables& tables, std::size_t end, std::string& decoded) {
  BackwardBits bits(bytes, unusedBits(header.match_bits));
  std::uint32_t length_state = header.length_state, match_state = header.match_state,
                distance_state = header.distance_state, distance = 0;
  for (std::uint32_t i = 0; i < header.matches; ++i) {
    const auto length = tables.lengths.decode(length_state, bits);
    const auto match = tables.matches.decode(match_state, bits);
    const auto new_distance = tables.distances.decode(distance_state, bits);
    if (!length || !match || !new_distance || bits.isFailed()) return false;
    if (*new_distance != 0) distance = *new_distance;
    if (*length > literals.size() || *length > end - decoded.size()) return false;
    decoded += literals.substr(0, *length);
    literals.remove_prefix(*length);
    if (!appendMatch(decoded, *match, distance, end)) return false;
  }
  return true;
}

}  // namespace

bool decodeFseBlock(std::string_view block, std::size_t end, std::string& decoded, std::size_t& block_bytes) {
  if (block.size() < kFixedHeaderBytes) return false;
  const FseHeader header = headerOf(block);
  block_bytes = std::size_t{header.header_bytes} + header.literal_bytes + header.match_bytes;
  if (header.header_bytes < kFixedHeaderBytes || block_bytes > block.size()) return false;
  std::array<std::uint16_t, 2 * kLengthSymbols + kDistanceSymbols + kLiteralSymbols> frequencies{};
  const std::string_view tables = block.substr(kFixedHeaderBytes, header.header_bytes - kFixedHeaderBytes);
  if (!tables.empty() && !FrequencyReader(tables).read(frequencies)) return false;
  const std::span<const std::uint16_t> all(frequencies);
  const FseTable literal_table(all.last(kLiteralSymbols), kLiteralStates, {});
  const MatchTables match_tables{
      FseTable(all.first(kLengthSymbols), kLengthStates, kLiteralLengthBits),
      FseTable(all.subspan(kLengthSymbols, kLengthSymbols), kLengthStates, kMatchLengthBits),
      FseTable(all.subspan(2 * kLengthSymbols, kDistanceSymbols), kDistanceStates, kDistanceBits)};
  if (!literal_table.isValid() || !match_tables.lengths.isValid() || !match_tables.matches.isValid() ||
      !match_tables.distances.isValid())
    return false;
  const auto literals =
      decodeLiterals(header, block.substr(header.header_bytes, header.literal_bytes), literal_table);
  const std::string_view matches =
      block.substr(std::size_t{header.header_bytes} + header.literal_bytes, header.match_bytes);
  return literals && decodeMatches(header, matches, *literals, match_tables, end, decoded);
}

}  // namespace scantrove
