#pragma once
#include <gtest/gtest.h>

#include <filesystem>
#include <functional>

#include "core/exchange/recording_writer.h"
#include "core/synthetic/synthetic_source.h"

namespace scantrove::test {

/// The synthetic table top in 320 x 240 pixels, without noise.
inline SyntheticOptions smallRecording() {
  SyntheticOptions options;
  options.K = {262.5F, 262.5F, 159.5F, 119.5F, 320, 240};
  options.noise = false;
  options.tremor = false;
  return options;
}

/// Writes `frames` synthetic frames as a recording in `folder`, each after `change`.
inline void writeRecording(const std::filesystem::path& folder, const SyntheticOptions& options, int frames,
                           const std::function<void(RgbdFrame&)>& change) {
  const auto source = makeSyntheticSource(options);
  ASSERT_TRUE(source) << source.error().message();
  auto writer = RecordingWriter::create(folder, (*source)->info());
  ASSERT_TRUE(writer) << writer.error().message();
  for (int i = 0; i < frames; ++i) {
    FrameRead read = (*source)->next();
    ASSERT_EQ(read.status, FrameRead::Status::frame);
    change(read.frame);
    const auto added = writer->add(read.frame);
    ASSERT_TRUE(added) << added.error().message();
  }
}

}  // namespace scantrove::test
