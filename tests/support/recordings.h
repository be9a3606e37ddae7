#pragma once
#include <gtest/gtest.h>

#include <cstdlib>
#include <filesystem>
#include <string>

#include "tests/support/source_tree.h"

namespace scantrove::test {

/// The folder of real recordings: SCANTROVE_DATA, else ../shared/data beside the source tree.
inline std::filesystem::path recordingsFolder() {
  if (const char* const given = std::getenv("SCANTROVE_DATA"); given != nullptr && *given != '\0') {
    return given;
  }
  return sourceTree() / ".." / "shared" / "data";
}

}  // namespace scantrove::test

/// Declares `variable`, the path of the recording `name` (a folder or file in the recordings folder), or
/// skips the test and names the missing path.
#define SCANTROVE_NEED_RECORDING(variable, name)                                         \
  const std::filesystem::path variable = ::scantrove::test::recordingsFolder() / (name); \
  if (!std::filesystem::exists(variable)) {                                              \
    GTEST_SKIP() << "There is no recording " << variable                                 \
                 << ". Set SCANTROVE_DATA to the folder that has it.";                   \
  }
