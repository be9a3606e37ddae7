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

// A reader of untrusted input as a libFuzzer target; each *_fuzz.cpp defines both functions. The preset
// `fuzz` links them with libFuzzer; replay_test.cpp runs the seeds and fixed mutations in any build.
extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size);

namespace scantrove::test {

/// Small valid inputs, the start of mutations.
[[nodiscard]] std::vector<std::string> seeds();

/// Aborts the program when a reader violates a guarantee.
inline void require(bool condition, const char* guarantee) {
  if (condition) return;
  std::fprintf(stderr, "violated guarantee: %s\n", guarantee);
  std::abort();
}

inline std::span<const std::uint8_t> bytesOf(std::string_view text) {
  return {reinterpret_cast<const std::uint8_t*>(text.data()), text.size()};
}

/// Removes and writes a file: some file systems flush a file that is overwritten.
inline std::filesystem::path rewrite(const TemporaryFolder& folder, const std::string& name,
                                     const std::string& text) {
  std::filesystem::remove(folder / name);
  return folder.write(name, text);
}

/// The parts of an input for several files, separated by 0x1E, which no text has; missing parts are empty.
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
