#include "core/exchange/part_name.h"

#include <cstdint>
#include <iomanip>
#include <random>
#include <sstream>
#include <string_view>

namespace scantrove {
namespace {

constexpr std::string_view kMark = ".scantrove-";
constexpr std::string_view kEnd = ".part";
constexpr std::size_t kRandomLetters = 16, kChecksumLetters = 8;

std::string hexadecimal(std::uint64_t number, std::size_t letters) {
  std::ostringstream text;
  text << std::hex << std::setfill('0') << std::setw(static_cast<int>(letters)) << number;
  return text.str();
}

std::string checksumOf(std::string_view text) {
  std::uint32_t hash = 2166136261U;  // FNV-1a
  for (const char letter : text) hash = (hash ^ static_cast<unsigned char>(letter)) * 16777619U;
  return hexadecimal(hash, kChecksumLetters);
}

}  // namespace

std::filesystem::path makePartName(const std::filesystem::path& path) {
  std::random_device random;
  const std::uint64_t number = (static_cast<std::uint64_t>(random()) << 32U) | random();
  const std::string start = "." + path.filename().string() + std::string(kMark);
  const std::string named = start + hexadecimal(number, kRandomLetters);
  return path.parent_path() / (named + checksumOf(named) + std::string(kEnd));
}

bool isPartName(const std::string& name) {
  const std::size_t ending = kChecksumLetters + kEnd.size();
  if (name.size() <= kMark.size() + kRandomLetters + ending || name.front() != '.') return false;
  const std::string named = name.substr(0, name.size() - ending);
  const std::size_t mark_at = named.size() - kRandomLetters - kMark.size();
  return named.compare(mark_at, kMark.size(), kMark) == 0 &&
         name.substr(named.size()) == checksumOf(named) + std::string(kEnd);
}

}  // namespace scantrove
