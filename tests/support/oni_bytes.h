#pragma once
#include <cstdint>
#include <string>

namespace scantrove::test {

/// The bytes of a value, as in an .oni file.
template <class Value>
std::string raw(Value value) {
  return {reinterpret_cast<const char*>(&value), sizeof value};
}

/// A zero-terminated text after its length.
inline std::string oniText(const std::string& text) {
  return raw(static_cast<std::uint32_t>(text.size() + 1)) + text + '\0';
}

inline std::string oniRecord(std::uint32_t type, const std::string& fields, const std::string& payload = {}) {
  const auto fields_bytes = static_cast<std::uint32_t>(28 + fields.size());
  return std::string("NIR\0", 4) + raw(type) + raw(std::uint32_t{1}) + raw(fields_bytes) +
         raw(static_cast<std::uint32_t>(payload.size())) + raw(std::uint64_t{0}) + fields + payload;
}

/// An .oni file with one node, one property, one image of an unknown format, and its end.
inline std::string oniBytes(const std::string& property = "Mirror",
                            const std::string& value = raw(std::uint64_t{1})) {
  const std::string header = "NI10" + raw(std::uint32_t{0x00010001}) + raw(std::uint32_t{0}) +
                             raw(std::uint64_t{33333}) + raw(std::uint32_t{1});
  return header + oniRecord(0x0D, oniText("Depth1") + std::string(32, 'f')) +
         oniRecord(0x03, oniText(property) + raw(static_cast<std::uint32_t>(value.size())) + value) +
         oniRecord(0x0A, std::string(12, 't'), std::string(300, 'p')) + oniRecord(0x0B, "");
}

}  // namespace scantrove::test
