#include "core/session/recording_part.h"

#include <gtest/gtest.h>

namespace scantrove {
namespace {

TEST(RecordingPart, IsTheWhole_WithoutChoice) { EXPECT_EQ(partInWords({}), kWholeRecording); }

TEST(RecordingPart, SaysWhatIsChosen) {
  SourceOptions options;
  options.start = 250;
  EXPECT_EQ(partInWords(options), "from frame 250");
  options.stride = 3;
  options.frames = 100;
  options.loops = 2;
  EXPECT_EQ(partInWords(options), "from frame 250, one of 3, 100 frames, 2 times");
}

}  // namespace
}  // namespace scantrove
