#pragma once
#include <gtest/gtest.h>

#include "tests/unit/capture/tiny_recordings.h"

namespace scantrove::test {

/// The opened recording; null after a failure that the test reports.
inline std::unique_ptr<FrameSource> openBenchmark(const std::filesystem::path& path,
                                                  const SourceOptions& options = {}) {
  auto source = openSource(path.string(), options);
  if (source) return std::move(*source);
  ADD_FAILURE() << source.error().message();
  return nullptr;
}

/// A 4x4 pose without rotation.
inline std::string matrixText(double x, double y = 0) {
  return "1 0 0 " + std::to_string(x) + "\n0 1 0 " + std::to_string(y) + "\n0 0 1 0\n0 0 0 1\n";
}

}  // namespace scantrove::test
