#pragma once
#include "core/capture/open_input.h"
#include "tests/fuzz/fuzz_target.h"

namespace scantrove::test {

/// Opens the bytes as a file of this name and reads some frames.
inline void readContainer(const std::uint8_t* data, std::size_t size, const char* name) {
  constexpr int kMostFrames = 5;
  static const TemporaryFolder folder;
  const auto file = rewrite(folder, name, {reinterpret_cast<const char*>(data), size});
  const auto source = openInput(file.string(), {});
  if (!source) {
    require(source.error().what.find(name) != std::string::npos, "an error names the file");
    return;
  }
  for (int i = 0; i < kMostFrames; ++i) {
    const FrameRead read = (*source)->next();
    if (read.status == FrameRead::Status::end) break;
    require(read.status != FrameRead::Status::skipped || !read.error.what.empty(),
            "a skipped frame says why");
  }
}

}  // namespace scantrove::test
