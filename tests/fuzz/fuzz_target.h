#pragma once
#include <cstddef>
#include <cstdint>
#include <cstdio>
#include <cstdlib>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "tests/support/temporary_folder.h"

// One reader of what comes from outside, in the form that libFuzzer drives; each *_fuzz.cpp defines both
// functions. The preset `fuzz` links them with libFuzzer; replay_test.cpp runs the seeds and seeded mutations
// of them anywhere.
extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size);

namespace scantrove::test {

/// Small inputs that the reader accepts, from which mutations start.
[[nodiscard]] std::vector<std::string> seeds();

/// Ends the program where a reader broke its promise.
inline void require(bool condition, const char* promise) {
  if (condition) return;
  std::fprintf(stderr, "broken promise: %s\n", promise);
  std::abort();
}

inline std::span<const std::uint8_t> bytesOf(std::string_view text) {
  return {reinterpret_cast<const std::uint8_t*>(text.data()), text.size()};
}

/// Writes a file anew. To write over it would have some file systems flush it to the disk every time.
inline std::filesystem::path rewrite(const TemporaryFolder& folder, const std::string& name,
                                     const std::string& text) {
  std::filesystem::remove(folder / name);
  return folder.write(name, text);
}

/// The parts of an input that stands for several files, separated by a byte that no text holds; missing parts
/// are empty.
inline std::vector<std::string> partsOf(std::string_view input, std::size_t count) {
  std::vector<std::string> parts(count);
  for (std::string& part : parts) {
    const std::size_t end = input.find('\x1E');
    part = input.substr(0, end);
    input.remove_prefix(end == std::string_view::npos ? input.size() : end + 1);
  }
  return parts;
}

}  // namespace scantrove::test
