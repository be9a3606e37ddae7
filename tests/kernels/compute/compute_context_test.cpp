#include "core/compute/compute_context.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <chrono>
#include <numeric>

#include "core/compute/kernel_types.h"
#include "embedded/compute_test_kernels.h"
#include "tests/support/each_device.h"

namespace scantrove {
namespace {

using test::onEachDevice;
using testing::HasSubstr;

TEST(Buffer, ReadsBackWhatWasWritten) {
  onEachDevice([](ComputeContext& compute) {
    Buffer<int> buffer(compute.context(), 10);
    EXPECT_EQ(buffer.size(), 10U);
    buffer.fill(compute.queue(), 7);
    const std::vector<int> part{1, 2, 3};
    buffer.write(compute.queue(), part, 4);
    EXPECT_EQ(buffer.read(compute.queue()), (std::vector<int>{7, 7, 7, 7, 1, 2, 3, 7, 7, 7}));
    buffer.fill(compute.queue(), 9, 0, 2);
    std::vector<int> first(3);
    buffer.read(compute.queue(), std::span<int>(first));
    EXPECT_EQ(first, (std::vector<int>{9, 9, 7}));
  });
}

TEST(Buffer, CanBeEmptyAndCopiesShareTheMemory) {
  onEachDevice([](ComputeContext& compute) {
    Buffer<float> empty(compute.context(), 0);
    EXPECT_TRUE(empty.read(compute.queue()).empty());
    empty.fill(compute.queue(), 1.0F);
    Buffer<float> a(compute.context(), 2);
    Buffer<float> b = a;
    b.fill(compute.queue(), 5.0F);
    EXPECT_EQ(a.read(compute.queue()), (std::vector<float>{5, 5}));
  });
}

TEST(BufferDeathTest, StopsTheProgram_WhenAccessedBeyondItsEnd) {
  auto compute = ComputeContext::create({});
  ASSERT_TRUE(compute) << compute.error().message();
  Buffer<int> buffer((*compute)->context(), 4);
  const std::vector<int> two{1, 2};
  EXPECT_DEATH(buffer.write((*compute)->queue(), two, 3), "internal error");
}

TEST(Kernel, RoundsGlobalUpToLocalAndSkipsEmptyRanges) {
  onEachDevice([](ComputeContext& compute) {
    auto kernel = compute.kernel(kernels::scale_values, "scale_values");
    ASSERT_TRUE(kernel) << kernel.error().message();
    constexpr int kCount = 37;
    std::vector<float> values(kCount);
    std::iota(values.begin(), values.end(), 1.0F);
    Buffer<float> in(compute.context(), kCount), out(compute.context(), kCount);
    Buffer<cl_int> visits(compute.context(), 1);
    in.write(compute.queue(), values);
    visits.fill(compute.queue(), 0);
    kernel->launch(cl::NDRange(kCount), cl::NDRange(16), in, out, visits, 2.0F, kCount);
    EXPECT_EQ(visits.read(compute.queue())[0], 48);
    const std::vector<float> scaled = out.read(compute.queue());
    for (int i = 0; i < kCount; ++i) {
      EXPECT_EQ(scaled[static_cast<std::size_t>(i)], 2 * values[static_cast<std::size_t>(i)]);
    }
    kernel->launch(cl::NDRange(0), cl::NDRange(16), in, out, visits, 2.0F, kCount);
    EXPECT_EQ(visits.read(compute.queue())[0], 48);
  });
}

TEST(Kernel, RoundsBothAxesUp) {
  onEachDevice([](ComputeContext& compute) {
    auto kernel = compute.kernel(kernels::scale_values, "mark_pixels");
    ASSERT_TRUE(kernel) << kernel.error().message();
    const int width = 13, height = 7;
    Buffer<cl_int> image(compute.context(), static_cast<std::size_t>(width * height));
    kernel->launch(cl::NDRange(width, height), cl::NDRange(8, 4), image, width, height);
    const auto pixels = image.read(compute.queue());
    for (int i = 0; i < width * height; ++i) {
      EXPECT_EQ(pixels[static_cast<std::size_t>(i)], 1000 * (i / width) + i % width);
    }
  });
}

TEST(Kernel, TransformsPointsAsTheHostDoes) {
  onEachDevice([](ComputeContext& compute) {
    auto kernel = compute.kernel(kernels::scale_values, "move_point");
    ASSERT_TRUE(kernel) << kernel.error().message();
    const Eigen::Isometry3d T =
        Eigen::Translation3d(1, -2, 3) * Eigen::AngleAxisd(0.7, Eigen::Vector3d(1, 2, 3).normalized());
    const Eigen::Vector3d expected = T * Eigen::Vector3d(0.5, 0.25, 2);
    Buffer<cl_float4> point(compute.context(), 1);
    point.fill(compute.queue(), toKernel(0.5F, 0.25F, 2, 1));
    kernel->launch(cl::NDRange(1), cl::NullRange, point, toKernel(T));
    const cl_float4 moved = point.read(compute.queue())[0];
    for (int axis = 0; axis < 3; ++axis)
      EXPECT_NEAR(moved.s[axis], expected[axis], 1e-6);  // one float rounding
  });
}

TEST(ComputeContext, BuildsOneFileWithDifferentOptions) {
  onEachDevice([](ComputeContext& compute) {
    Buffer<float> values(compute.context(), 3);
    values.fill(compute.queue(), 1.0F);
    for (const char* options : {"-DOFFSET=10.0f", "-DOFFSET=100.0f", "-DOFFSET=10.0f"}) {
      auto kernel = compute.kernel(kernels::scale_values, "add_offset", options);
      ASSERT_TRUE(kernel) << kernel.error().message();
      kernel->launch(cl::NDRange(3), cl::NullRange, values, 3);
    }
    EXPECT_EQ(values.read(compute.queue()), (std::vector<float>{121, 121, 121}));
  });
}

TEST(ComputeContext, NamesFileAndLine_WhenABuildFails) {
  onEachDevice([](ComputeContext& compute) {
    const auto kernel = compute.kernel(kernels::broken_kernel, "broken_kernel", "-DSOME_OPTION=1");
    ASSERT_FALSE(kernel);
    const std::string message = kernel.error().message();
    // NVIDIA's compiler ignores line numbers of #line, but its message includes the file name.
    EXPECT_THAT(message, HasSubstr(compute.isCpu() ? "test_kernels/broken_kernel.cl:7"
                                                   : "test_kernels/broken_kernel.cl"));
    EXPECT_THAT(message, HasSubstr("no_such_value"));
    EXPECT_THAT(message, HasSubstr("-DSOME_OPTION=1"));
    EXPECT_THAT(message, HasSubstr(compute.deviceName()));
  });
}

/// A unique build option, so that no driver cache contains the kernel.
std::string uniqueOption() {
  return "-DNEVER_BUILT=" + std::to_string(std::chrono::steady_clock::now().time_since_epoch().count());
}

TEST(ComputeContext, PrintsNothing_WhenABuildSucceeds) {
  onEachDevice([](ComputeContext& compute) {
    testing::internal::CaptureStderr();
    const auto kernel = compute.kernel(kernels::remarked_kernel, "count_up", uniqueOption());
    EXPECT_EQ(testing::internal::GetCapturedStderr(), "");
    ASSERT_TRUE(kernel) << kernel.error().message();
  });
}

// Processors only: a GPU's driver compiles this small kernel too fast for a message, or in another process.
TEST(ComputeContext, ReportsCompilingOnce_WhenADriverCacheIsEmpty) {
  const std::vector<DeviceInfo> devices = listDevices();
  const auto processor = std::ranges::find(devices, false, &DeviceInfo::is_gpu);
  if (processor == devices.end())
    GTEST_SKIP() << "no processor among the OpenCL devices: install pocl-opencl-icd";
  const std::string options = uniqueOption();
  int calls = 0;
  const auto build = [&](const std::vector<std::string>& all_options) {
    auto compute = ComputeContext::create(
        {.device = std::to_string(processor->index), .on_compiling = [&] { ++calls; }});
    ASSERT_TRUE(compute) << compute.error().message();
    for (const std::string& each : all_options) {
      const auto kernel = (*compute)->kernel(kernels::remarked_kernel, "count_up", each);
      ASSERT_TRUE(kernel) << kernel.error().message();
    }
  };
  build({options, options + "0"});
  EXPECT_EQ(calls, 1);
  build({options, options + "0"});
  EXPECT_EQ(calls, 1) << "the driver has both in its cache";
}

TEST(ComputeContext, NamesTheKernel_WhenItsFileLacksIt) {
  auto compute = ComputeContext::create({});
  ASSERT_TRUE(compute) << compute.error().message();
  const auto kernel = (*compute)->kernel(kernels::scale_values, "sing_a_song");
  ASSERT_FALSE(kernel);
  EXPECT_THAT(kernel.error().message(), HasSubstr("sing_a_song"));
  EXPECT_THAT(kernel.error().message(), HasSubstr("scale_values.cl"));
}

TEST(ComputeContext, MeasuresKernelsOnRequestOnly) {
  for (const bool profiling : {false, true}) {
    auto compute = ComputeContext::create({.device = "", .profiling = profiling});
    ASSERT_TRUE(compute) << compute.error().message();
    auto kernel = (*compute)->kernel(kernels::scale_values, "mark_pixels");
    ASSERT_TRUE(kernel) << kernel.error().message();
    Buffer<cl_int> image((*compute)->context(), 64);
    kernel->launch(cl::NDRange(8, 8), cl::NullRange, image, 8, 8);
    (*compute)->finish();
    EXPECT_EQ((*compute)->kernelTimes().count("mark_pixels"), profiling ? 1U : 0U);
  }
}

TEST(KernelSource, HoldsIncludesBetweenLineDirectives) {
  const std::string text(kernels::broken_kernel.text);
  EXPECT_EQ(kernels::broken_kernel.path, "tests/kernels/compute/test_kernels/broken_kernel.cl");
  EXPECT_THAT(text, HasSubstr("#line 1 \"tests/kernels/compute/test_kernels/broken_kernel.cl\""));
  EXPECT_THAT(text, HasSubstr("#line 1 \"core/compute/kernels/common.clh\""));
  EXPECT_THAT(text, HasSubstr("#line 3 \"tests/kernels/compute/test_kernels/broken_kernel.cl\""));
}

}  // namespace
}  // namespace scantrove
