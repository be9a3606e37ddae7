// Containers that are cut or damaged anywhere: each opens with what is whole, or is refused with a sentence.
#include "tests/fuzz/mutation.h"
#include "tests/support/captured_log.h"
#include "tests/unit/capture/container_fixture.h"

namespace scantrove {
namespace {

using namespace test;

/// Reads at most some frames.
void openAndRead(const std::filesystem::path& file) {
  constexpr int kMostFrames = 10;
  const auto source = openInput(file.string(), {});
  if (!source) {
    EXPECT_NE(source.error().what.find(file.filename().string()), std::string::npos) << source.error().what;
    EXPECT_TRUE(source.error().what.ends_with('.')) << source.error().what;
    return;
  }
  for (int i = 0; i < kMostFrames; ++i) {
    const FrameRead read = (*source)->next();
    if (read.status == FrameRead::Status::end) break;
    if (read.status == FrameRead::Status::skipped) {
      EXPECT_FALSE(read.error.what.empty());
    }
  }
}

void expectSentences(const std::string& whole, const std::string& name) {
  const CapturedLog log;  // of warnings
  const TemporaryFolder folder;
  constexpr int kCuts = 100, kMutations = 1000;
  const auto tryBytes = [&](const std::string& bytes) {
    std::filesystem::remove(folder / name);
    openAndRead(folder.write(name, bytes));
  };
  for (int i = 0; i < kCuts; ++i) {
    const std::size_t bytes = whole.size() * static_cast<std::size_t>(i) / kCuts;
    SCOPED_TRACE("cut after " + std::to_string(bytes) + " bytes");
    tryBytes(whole.substr(0, bytes));
  }
  Mutator mutator({whole}, 20240301);
  for (int i = 0; i < kMutations && !testing::Test::HasFailure(); ++i) {
    SCOPED_TRACE("mutation " + std::to_string(i));
    tryBytes(mutator.next());
  }
}

TEST(DamagedContainer, IsReadOrRefused_WhenABag) {
  expectSentences(bagBytes(registeredFrames(false), "lz4"), "damaged.bag");
  expectSentences(bagBytes(registeredFrames(false), "none", 4, false), "killed.bag");
}

TEST(DamagedContainer, IsReadOrRefused_WhenADatabase) {
  const TemporaryFolder folder;
  writeRosbag2(folder / "whole.db3", registeredFrames(true));
  expectSentences(readText(folder / "whole.db3"), "damaged.db3");
  writeRosbag2(folder / "whole.db3", registeredFrames(true), "zstd");
  expectSentences(readText(folder / "whole.db3"), "compressed.db3");
}

TEST(DamagedContainer, IsReadOrRefused_WhenMcap) {
  expectSentences(mcapBytes(registeredFrames(true), {"zstd", 4, true, true, "cdr"}), "damaged.mcap");
  expectSentences(mcapBytes(registeredFrames(true), {"", 0, false, true, "cdr"}), "unchunked.mcap");
}

TEST(DamagedContainer, IsReadOrRefused_WhenMatroska) {
  const std::string pixels(std::size_t{2} * 320 * 288, '\3');
  const std::string calibration =
      R"({"CalibrationInformation":{"Cameras":[{"Location":"CALIBRATION_CameraLocationD0","Intrinsics":)"
      R"({"ModelParameters":[0.5,0.5,0.5,0.5,0,0,0,0,0,0,0,0,0,0]},"Rt":{"Rotation":[1,0,0,0,1,0,0,0,1],)"
      R"("Translation":[0,0,0]}}]}})";
  expectSentences(matroskaBytes({{"DEPTH", "b16g", 320, 288, {{0, pixels}, {33, pixels}}}}, calibration),
                  "damaged.mkv");
}

/// sensor_msgs/Image whose rows are `step` bytes apart.
std::string imageWithStep(std::uint32_t step) {
  return RosBytes(false)
      .header(kFirstStamp_ns, "optical")
      .put(std::uint32_t{36})
      .put(std::uint32_t{48})
      .text("16UC1")
      .put(std::uint8_t{0})
      .put(step)
      .list(std::string(std::size_t{step} * 36, '\1'))
      .message();
}

TEST(DamagedContainer, IsRefused_WhenRowsOfDepthAreNotWholeNumbersApart) {
  const TemporaryFolder folder;
  ContainerMessages messages = registeredFrames(false, 1);
  for (ContainerMessage& message : messages)
    if (message.topic == "/camera/depth/image_raw") message.data = imageWithStep(97);
  EXPECT_NE(openContainerError(folder.write("odd.bag", bagBytes(messages))).find("damaged"),
            std::string::npos);
  for (ContainerMessage& message : messages)
    if (message.topic == "/camera/depth/image_raw") message.data = imageWithStep(98);
  EXPECT_EQ(openContainerError(folder.write("even.bag", bagBytes(messages))), "opened");
}

TEST(DamagedContainer, IsRefused_WhenNamesOfTopicsWouldFillTheMemory) {
  const TemporaryFolder folder;
  ContainerMessages messages = registeredFrames(false);
  messages.push_back({"/" + std::string(5000, 'n'), "std_msgs/String", kFirstStamp_ns, "text"});
  const auto bag = folder.write("names.bag", bagBytes(messages, "bz2"));
  EXPECT_NE(openContainerError(bag).find("more than 4096 bytes"), std::string::npos);
  const auto mcap = folder.write("names.mcap", mcapBytes(messages, {"zstd", 4, true, true, "ros1"}));
  EXPECT_NE(openContainerError(mcap).find("more than 4096 bytes"), std::string::npos);
}

TEST(DamagedContainer, IsRefused_WhenAttachmentsWouldFillTheMemory) {
  const TemporaryFolder folder;
  const std::string attached = ebmlElement(0x1941A469, std::string(std::size_t{20} << 20, '\0'));
  const std::string whole = matroskaBytes({{"DEPTH", "b16g", 2, 2, {{0, "12345678"}}}}, "{}");
  EXPECT_NE(openContainerError(folder.write("large.mkv", whole + attached + attached)).find("attachments"),
            std::string::npos);
}

}  // namespace
}  // namespace scantrove
