// Scenes and images of each seed stay as they are: sampled data, models and expectations depend on them.
#include <gtest/gtest.h>

#include <ostream>
#include <string>

#include "core/base/checksum.h"
#include "core/synthetic/synthetic_source.h"

namespace scantrove {
namespace {

/// CRC-32 of the pixels of one frame. The expected values are those of the program before the hard generation
/// (commit 912b847f, g++ 12 on x86-64), from the images of `scantrove record demo:SCENE`.
struct FrameChecksums {
  const char* scene;
  int frame;
  std::uint32_t depth, instances, color;
};

void PrintTo(const FrameChecksums& checksums, std::ostream* out) { *out << checksums.scene; }

std::uint32_t checksumOf(const cv::Mat& image) {
  EXPECT_TRUE(image.isContinuous());
  return crc32Of({image.ptr<char>(), image.total() * image.elemSize()});
}

class EarlierSceneTest : public testing::TestWithParam<FrameChecksums> {};
INSTANTIATE_TEST_SUITE_P(
    Kinds, EarlierSceneTest,
    testing::Values(FrameChecksums{"tabletop", 40, 0x226e6580, 0x7acb3992, 0xbd962c41},
                    FrameChecksums{"room", 40, 0xed0fa4e5, 0xaa54c2dd, 0xf368f29f},
                    FrameChecksums{"wall", 40, 0xae36d404, 0x2884bbb1, 0xfadf6e4d},
                    FrameChecksums{"corridor", 40, 0xd69e6c14, 0x48b01984, 0xc39b4ea8},
                    FrameChecksums{"room:7", 40, 0x280b634a, 0xa456b0c4, 0xd9051406},
                    FrameChecksums{"tabletop:7", 40, 0xc2216bce, 0x0bd1e0ac, 0x3c1d4722},
                    FrameChecksums{"room:7:uneven", 40, 0x7e116d8a, 0x8cf092cc, 0x40363682},
                    FrameChecksums{"tabletop:7:drab", 40, 0xc2216bce, 0x0bd1e0ac, 0x8cf3cb86},
                    FrameChecksums{"sweep:3", 40, 0x26294ad5, 0xf8089e5e, 0x669f5993},
                    FrameChecksums{"moving:3", 180, 0x1ab68490, 0xd474abb3, 0x54066b9a}));

TEST_P(EarlierSceneTest, HasTheSameFramesAsEver) {
  SourceOptions options;
  options.start = GetParam().frame;
  options.frames = 1;
  const auto source = makeSyntheticSource(GetParam().scene, options);
  ASSERT_TRUE(source) << source.error().message();
  const RgbdFrame frame = (*source)->next().frame;
  EXPECT_EQ(checksumOf(frame.depth), GetParam().depth);
  EXPECT_EQ(checksumOf(frame.instances), GetParam().instances);
  EXPECT_EQ(checksumOf(frame.color), GetParam().color);
}

}  // namespace
}  // namespace scantrove
