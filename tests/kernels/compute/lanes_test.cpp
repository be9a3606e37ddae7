#include "core/compute/lanes.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cstdlib>
#include <optional>
#include <string>
#include <vector>

#include "core/compute/device_choice.h"
#include "core/compute/kernel_types.h"
#include "embedded/compute_test_kernels.h"
#include "tests/support/each_device.h"

namespace scantrove {
namespace {

using testing::AnyOf;
using testing::ElementsAre;
using testing::HasSubstr;

class LanesTest : public testing::Test {
 protected:
  void SetUp() override {
    if (const char* set = std::getenv("SCANTROVE_LANES")) before_ = set;
    unsetenv("SCANTROVE_LANES");
    device_ = chooseDevice("").value();
  }
  void TearDown() override {
    before_ ? setenv("SCANTROVE_LANES", before_->c_str(), 1) : unsetenv("SCANTROVE_LANES");
  }

  std::optional<std::string> before_;
  cl::Device device_;
};

std::vector<std::size_t> sizesOf(const cl::NDRange& range) {
  return {range.get(), range.get() + range.dimensions()};
}

TEST_F(LanesTest, SuitTheDevice_ByDefault) {
  const bool is_cpu = (device_.getInfo<CL_DEVICE_TYPE>() & CL_DEVICE_TYPE_CPU) != 0;
  const int lanes = Lanes::choose(device_, 0).value().count();
  if (is_cpu)
    EXPECT_THAT(lanes, AnyOf(1, 4, 8, 16));
  else
    EXPECT_EQ(lanes, 1);
  for (const int requested : {1, 4, 8, 16})
    EXPECT_EQ(Lanes::choose(device_, requested).value().count(), requested);
}

TEST_F(LanesTest, FollowTheEnvironment_ByDefault) {
  setenv("SCANTROVE_LANES", "4", 1);
  EXPECT_EQ(Lanes::choose(device_, 0).value().count(), 4);
  EXPECT_EQ(Lanes::choose(device_, 8).value().count(), 8);
  setenv("SCANTROVE_LANES", "", 1);
  EXPECT_TRUE(Lanes::choose(device_, 0));
}

TEST_F(LanesTest, RefuseOtherNumbers) {
  for (const char* wrong : {"2", "0", "32", "-1", "eight", "8 lanes", "99999999999"}) {
    setenv("SCANTROVE_LANES", wrong, 1);
    const Result<Lanes> lanes = Lanes::choose(device_, 0);
    ASSERT_FALSE(lanes) << wrong;
    EXPECT_THAT(lanes.error().message(), HasSubstr("'" + std::string(wrong) + "'"));
  }
  EXPECT_FALSE(Lanes::choose(device_, 3));
}

TEST_F(LanesTest, CoverEveryPixel) {
  const auto of = [&](int lanes) { return Lanes::choose(device_, lanes).value(); };
  EXPECT_THAT(sizesOf(of(16).overRows(33, 5)), ElementsAre(3U, 5U));
  EXPECT_THAT(sizesOf(of(16).overEights(33, 5)), ElementsAre(5U, 5U));
  EXPECT_THAT(sizesOf(of(16).overBlocks(33, 5)), ElementsAre(5U, 3U));
  EXPECT_THAT(sizesOf(of(8).overBlocks(33, 5)), ElementsAre(5U, 5U));
  EXPECT_THAT(sizesOf(of(4).overEights(33, 5)), ElementsAre(9U, 5U));
  EXPECT_THAT(sizesOf(of(1).overBlocks(33, 5)), ElementsAre(33U, 5U));
}

TEST(Lanes, MasksAndGathersAreEqual_AtEveryWidth) {
  test::onEachWidth([](ComputeContext& compute) {
    auto kernel = compute.kernel(kernels::lane_operations, "pick_negative");
    ASSERT_TRUE(kernel) << kernel.error().message();
    constexpr int kCount = 64;
    std::vector<float> values;
    std::vector<cl_int> indices;
    for (int i = 0; i < kCount; ++i) {
      values.push_back(static_cast<float>(i % 5 == 0 ? -i : i));
      indices.push_back((7 * i + 3) % kCount);
    }
    Buffer<float> in(compute.context(), kCount), out(compute.context(), kCount);
    Buffer<cl_int> from(compute.context(), kCount), any(compute.context(), kCount);
    in.write(compute.queue(), values);
    from.write(compute.queue(), indices);
    const int lanes = compute.lanes().count();
    const auto items = static_cast<std::size_t>(kCount / lanes);
    kernel->launch(cl::NDRange(items), cl::NullRange, in, from, out, any);
    const std::vector<float> picked = out.read(compute.queue());
    const std::vector<cl_int> found = any.read(compute.queue());
    for (std::size_t item = 0; item < items; ++item) {
      bool has_negative = false;
      for (int lane = 0; lane < lanes; ++lane) {
        const int i = static_cast<int>(item) * lanes + lane;
        const float value = values[static_cast<std::size_t>(indices[static_cast<std::size_t>(i)])];
        const float block = static_cast<float>(100 * (lane / 8) + lane % 8);
        EXPECT_EQ(picked[static_cast<std::size_t>(i)], value < 0 && lane != 2 ? value : block) << i;
        has_negative |= value < 0;
      }
      EXPECT_EQ(found[item] != 0, has_negative) << item;
    }
  });
}

TEST(Lanes, GathersOfEverySizeReadTheirElements) {
  test::onEachWidth([](ComputeContext& compute) {
    auto kernel = compute.kernel(kernels::lane_operations, "gather_each");
    ASSERT_TRUE(kernel) << kernel.error().message();
    constexpr int kCount = 64;
    std::vector<cl_short> shorts;
    std::vector<cl_uchar> bytes;
    std::vector<cl_int> indices;
    for (int i = 0; i < kCount; ++i) {
      shorts.push_back(static_cast<cl_short>(i % 3 == 0 ? -32768 + i : 700 * i - 20000));  // of either sign
      bytes.push_back(static_cast<cl_uchar>(255 - 3 * i));
      indices.push_back(i == 0 ? kCount - 4 : (7 * i + 3) % (kCount - 3));
    }
    const auto uploaded = [&](const auto& values) {
      Buffer<std::decay_t<decltype(values.front())>> buffer(compute.context(), values.size());
      buffer.write(compute.queue(), values);
      return buffer;
    };
    Buffer<cl_int> of_shorts(compute.context(), kCount), of_bytes(compute.context(), kCount);
    Buffer<cl_uint> words(compute.context(), kCount);
    kernel->launch(cl::NDRange(static_cast<std::size_t>(kCount / compute.lanes().count())), cl::NullRange,
                   uploaded(shorts), uploaded(bytes), uploaded(indices), of_shorts, of_bytes, words);
    const std::vector<cl_int> short_values = of_shorts.read(compute.queue()),
                              byte_values = of_bytes.read(compute.queue());
    const std::vector<cl_uint> word_values = words.read(compute.queue());
    for (std::size_t i = 0; i < kCount; ++i) {
      const auto index = static_cast<std::size_t>(indices[i]);
      EXPECT_EQ(short_values[i], shorts[index]) << i;
      EXPECT_EQ(byte_values[i], bytes[index]) << i;
      const cl_uint word = bytes[index] | cl_uint{bytes[index + 1]} << 8U | cl_uint{bytes[index + 2]} << 16U |
                           cl_uint{bytes[index + 3]} << 24U;
      EXPECT_EQ(word_values[i], word) << i;
    }
  });
}

}  // namespace
}  // namespace scantrove
