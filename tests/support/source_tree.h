#pragma once
#include <filesystem>

namespace scantrove::test {

/// The root of the source tree that the tests were built from.
[[nodiscard]] std::filesystem::path sourceTree();

}  // namespace scantrove::test
