#include "core/dataset/scan_prefix.h"

#include <spdlog/fmt/fmt.h>

#include <algorithm>
#include <cstddef>
#include <map>
#include <set>
#include <span>

#include "core/base/checksum.h"
#include "core/dataset/export_text.h"

namespace scantrove {
namespace {

constexpr std::size_t kLongestPrefix_bytes = 60, kChecksum_bytes = 9;  // "-0123abcd"

/// Cuts UTF-8 text between characters.
std::string shortened(std::string text, std::size_t bytes) {
  if (text.size() <= bytes) return text;
  const auto continues = [](char byte) { return (static_cast<unsigned char>(byte) & 0xC0U) == 0x80U; };
  while (bytes > 0 && continues(text[bytes])) --bytes;
  text.resize(bytes);
  return text;
}

std::string withChecksum(const std::string& prefix, const std::string& name) {
  const std::string start = shortened(prefix, kLongestPrefix_bytes - kChecksum_bytes);
  return fmt::format("{}-{:08x}", start, crc32Of(std::span(name.data(), name.size())));
}

/// The name as a file name, which may be the same for several names.
std::string safePrefix(const std::string& name) {
  constexpr std::size_t kNumber = 7;  // "000000_"
  const std::string numbered = safeFileName(0, name);
  std::string safe = numbered.size() > kNumber ? numbered.substr(kNumber) : "";
  if (safe.empty()) safe = "scan";
  if (safe.front() == '.' || safe.front() == '-') safe.front() = '_';
  return safe == name && safe.size() <= kLongestPrefix_bytes ? safe : withChecksum(safe, name);
}

std::string lowerCase(std::string text) {
  std::ranges::transform(text, text.begin(),
                         [](char c) { return c >= 'A' && c <= 'Z' ? static_cast<char>(c - 'A' + 'a') : c; });
  return text;
}

}  // namespace

std::vector<std::string> scanPrefixes(const std::vector<std::string>& names) {
  std::vector<std::string> prefixes;
  std::map<std::string, int> uses;  // without the case of letters, as some file systems compare
  for (const std::string& name : names) {
    prefixes.push_back(safePrefix(name));
    ++uses[lowerCase(prefixes.back())];
  }
  std::set<std::string> taken;
  for (std::size_t i = 0; i < names.size(); ++i) {
    std::string& prefix = prefixes[i];
    if (uses.at(lowerCase(prefix)) > 1 && prefix == names[i]) prefix = withChecksum(prefix, names[i]);
    const std::string first = prefix;
    for (int number = 2; !taken.insert(lowerCase(prefix)).second; ++number)
      prefix = fmt::format("{}-{}", first, number);
  }
  return prefixes;
}

}  // namespace scantrove
