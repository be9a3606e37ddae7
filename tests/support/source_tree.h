#pragma once
#include <filesystem>

namespace scantrove::test {

/// The root of the source tree of this build.
[[nodiscard]] std::filesystem::path sourceTree();

}  // namespace scantrove::test
