#include "core/compute/cached_kernels.h"

#include <elf.h>
#include <libdeflate.h>
#include <unistd.h>

#include <charconv>
#include <cstdint>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <map>
#include <string>
#include <string_view>
#include <system_error>

#include "core/base/regular_file.h"
#include "core/base/text.h"

namespace scantrove {
namespace {

namespace fs = std::filesystem;

constexpr const char* kRecord = "scantrove-checksums";

bool isCompleteLibrary(std::string_view bytes) {
  Elf64_Ehdr header;
  if (bytes.size() < sizeof(header)) return false;
  std::memcpy(&header, bytes.data(), sizeof(header));
  if (std::memcmp(header.e_ident, ELFMAG, SELFMAG) != 0) return false;
  if (header.e_ident[EI_CLASS] != ELFCLASS64) return true;  // not written by this system's PoCL
  // Linkers write the section table last.
  const std::uint64_t table = std::uint64_t{header.e_shentsize} * header.e_shnum;
  return header.e_shnum > 0 && header.e_shoff <= bytes.size() && table <= bytes.size() - header.e_shoff;
}

/// Bitcode is a sequence of blocks of 32-bit words: one header word (bits 0-1: 1, "enter"), the length, the
/// contents.
bool isCompleteBitcode(std::string_view bytes) {
  constexpr std::uint32_t kMagic = 0xDEC04342, kEnter = 1;
  const auto word = [&](std::size_t at) {
    std::uint32_t value = 0;
    std::memcpy(&value, bytes.data() + at, sizeof(value));
    return value;
  };
  if (bytes.size() < 12 || bytes.size() % 4 != 0 || word(0) != kMagic) return false;
  std::size_t at = 4;
  while (bytes.size() - at >= 8 && (word(at) & 3U) == kEnter) {
    const std::uint64_t length = std::uint64_t{4} * word(at + 4);
    if (length > bytes.size() - at - 8) return false;
    at += 8 + length;
  }
  return at == bytes.size();
}

bool isComplete(const fs::path& file, std::string_view bytes) {
  return file.extension() == ".so" ? isCompleteLibrary(bytes) : isCompleteBitcode(bytes);
}

/// Compiled kernels below `cache`; unreadable folders set `failure`.
std::vector<fs::path> kernelsBelow(const fs::path& cache, std::error_code& failure) {
  std::vector<fs::path> kernels;
  for (fs::recursive_directory_iterator entry(cache, failure), end; !failure && entry != end;
       entry.increment(failure)) {
    const fs::path extension = entry->path().extension();
    if (extension == ".so" || extension == ".bc") kernels.push_back(entry->path());
  }
  return kernels;
}

std::uint32_t checksumOf(std::string_view bytes) { return libdeflate_crc32(0, bytes.data(), bytes.size()); }

/// Lines "CHECKSUM PATH" by path.
std::map<std::string, std::uint32_t, std::less<>> readRecord(const fs::path& cache) {
  std::map<std::string, std::uint32_t, std::less<>> record;
  const auto text = readFile(cache / kRecord);
  for (const std::string_view line : text ? splitLines(*text) : std::vector<std::string_view>()) {
    std::uint32_t sum = 0;
    const auto [end, failure] = std::from_chars(line.data(), line.data() + line.size(), sum, 16);
    const auto used = static_cast<std::size_t>(end - line.data());
    if (failure == std::errc{} && used == 8 && line.size() > 9) record.emplace(line.substr(9), sum);
  }
  return record;
}

}  // namespace

bool isCompleteKernel(const fs::path& file) {
  const auto bytes = readFile(file);
  return bytes && isComplete(file, *bytes);
}

Result<std::vector<fs::path>> damagedKernels(const fs::path& cache) {
  std::vector<fs::path> damaged;
  const auto record = readRecord(cache);
  std::error_code failure;
  for (const fs::path& file : kernelsBelow(cache, failure)) {
    const auto bytes = readFile(file);
    const auto recorded = record.find(file.lexically_relative(cache).string());
    const bool is_as_recorded = bytes && (recorded == record.end() || recorded->second == checksumOf(*bytes));
    // Another program may have removed it.
    std::error_code ignored;
    if ((!is_as_recorded || !isComplete(file, *bytes)) && fs::exists(fs::symlink_status(file, ignored)))
      damaged.push_back(file);
  }
  if (failure) return fail("Cannot read " + cache.string() + ": " + failure.message() + ".");
  return damaged;
}

void recordKernels(const fs::path& cache) {
  std::error_code failure;
  std::string text;
  for (const fs::path& file : kernelsBelow(cache, failure)) {
    const auto bytes = readFile(file);
    if (!bytes || !isComplete(file, *bytes)) continue;
    char sum[9];
    std::snprintf(sum, sizeof(sum), "%08x", checksumOf(*bytes));
    text.append(sum).append(" ").append(file.lexically_relative(cache).string()).append("\n");
  }
  if (const auto recorded = readFile(cache / kRecord); recorded && *recorded == text) return;
  std::string part = (cache / kRecord).string() + ".XXXXXX";
  const int file = ::mkstemp(part.data());
  if (file < 0) return;
  const bool is_written = ::write(file, text.data(), text.size()) == static_cast<ssize_t>(text.size());
  if (::close(file) == 0 && is_written && !failure) fs::rename(part, cache / kRecord, failure);
  if (!is_written || failure) fs::remove(part, failure);
}

}  // namespace scantrove
