#include <gtest/gtest.h>

#include <random>

#include "core/compute/kernel_types.h"
#include "core/fusion/depth_plane.h"
#include "embedded/fusion_kernels.h"
#include "tests/reference/depth_reference.h"
#include "tests/support/each_device.h"

namespace scantrove::test {
namespace {

using reference::DepthImage;

// Floats of a few metres are rounded to 2.4e-7 m; a dozen operations on differences stay below this.
constexpr double kTolerance_m = 3e-6;

/// Slanted ground, a step, camera noise and holes.
DepthImage testImage(int width, int height, unsigned seed) {
  std::mt19937 random(seed);
  std::normal_distribution<double> noise(0.0, 1.0);
  std::uniform_real_distribution<double> uniform(0.0, 1.0);
  DepthImage image(width, height);
  for (int v = 0; v < height; ++v) {
    for (int u = 0; u < width; ++u) {
      double z = 1.0 + 2.0 * v / height + 0.3 * u / width;
      if (u > width / 3 && u < width / 2 && v > height / 4) z = 0.8;
      z += 0.0015 * z * z * noise(random);
      image.at(u, v) = uniform(random) < 0.05 ? 0.0F : static_cast<float>(z);
    }
  }
  return image;
}

std::size_t indexIn(const DepthPlane& plane, int u, int v) {
  return static_cast<std::size_t>((v + PLANE_PAD) * plane.stride + u + PLANE_PAD);
}

DepthPlane planeOf(ComputeContext& compute, const DepthImage& image) {
  DepthPlane plane(compute, image.width, image.height);
  std::vector<float> all(plane.meters.size(), 0.0F);
  for (int v = 0; v < image.height; ++v) {
    for (int u = 0; u < image.width; ++u) all[indexIn(plane, u, v)] = image.at(u, v);
  }
  plane.meters.write(compute.queue(), all);
  return plane;
}

DepthImage read(ComputeContext& compute, const DepthPlane& plane) {
  const std::vector<float> all = plane.meters.read(compute.queue());
  DepthImage image(plane.width, plane.height);
  double inside = 0, everything = 0;
  for (const float z : all) everything += static_cast<double>(z);
  for (int v = 0; v < plane.height; ++v) {
    for (int u = 0; u < plane.width; ++u) {
      inside += static_cast<double>(image.at(u, v) = all[indexIn(plane, u, v)]);
    }
  }
  EXPECT_NEAR(inside, everything, 1e-6) << "the border of zeros was overwritten";
  return image;
}

void expectSame(const DepthImage& actual, const DepthImage& expected) {
  for (int v = 0; v < expected.height; ++v) {
    for (int u = 0; u < expected.width; ++u) {
      ASSERT_NEAR(actual.at(u, v), expected.at(u, v), kTolerance_m) << "pixel " << u << ", " << v;
    }
  }
}

Kernel kernelOf(ComputeContext& compute, const KernelSource& source, const char* name,
                const char* options = "") {
  auto kernel = compute.kernel(source, name, options);
  EXPECT_TRUE(kernel) << kernel.error().message();
  return *kernel;
}

TEST(ConvertDepth, KeepsTheRangeAndDropsTheRest) {
  onEachDevice([](ComputeContext& compute) {
    const std::vector<cl_ushort> units{0, 1, 299, 300, 301, 4999, 5000, 5001, 65534, 65535};
    Buffer<cl_ushort> input(compute.context(), units.size());
    Buffer<cl_float> output(compute.context(), units.size());
    input.write(compute.queue(), units);
    Kernel kernel = kernelOf(compute, kernels::fusion, "convert_depth");
    kernel.launch(cl::NDRange(units.size()), cl::NDRange(4), input, static_cast<cl_int>(units.size()), 0.001F,
                  0.3F, 5.0F, output);
    const std::vector<float> z = output.read(compute.queue());
    for (std::size_t i = 0; i < units.size(); ++i) {
      EXPECT_EQ(z[i], reference::convertDepth(units[i], 0.001F, 0.3F, 5.0F)) << units[i];
    }
  });
}

TEST(HalveDepth, MatchesTheFormula) {
  onEachWidth([](ComputeContext& compute) {
    Kernel kernel = kernelOf(compute, kernels::fusion, "halve_depth");
    for (const auto& [width, height] : {std::pair(640, 480), {317, 233}, {33, 34}, {2, 2}}) {
      const DepthImage large = testImage(width, height, 7);
      DepthPlane small(compute, width / 2, height / 2);
      const cl::NDRange items = compute.lanes().overEights(small.width, small.height);
      const cl::NDRange group = compute.lanes().rowGroup();
      const DepthImage expected = reference::reduceDepth(large, small.width, small.height, 2, 2);

      Buffer<cl_float> image(compute.context(), large.z.size());
      image.write(compute.queue(), large.z);
      kernel.launch(items, group, image, cl_int{width}, cl_int{0}, cl_int{small.width}, cl_int{small.height},
                    cl_int{small.stride}, small.meters);
      expectSame(read(compute, small), expected);

      const DepthPlane plane = planeOf(compute, large);
      kernel.launch(items, group, plane.meters, cl_int{plane.stride}, cl_int{PLANE_PAD}, cl_int{small.width},
                    cl_int{small.height}, cl_int{small.stride}, small.meters);
      expectSame(read(compute, small), expected);
    }
  });
}

DepthImage reduced(ComputeContext& compute, const DepthImage& large, int width, int height) {
  Buffer<cl_float> image(compute.context(), large.z.size());
  image.write(compute.queue(), large.z);
  DepthPlane small(compute, width, height);
  Kernel kernel = kernelOf(compute, kernels::reduce_depth, "reduce_depth");
  kernel.launch(cl::NDRange(static_cast<std::size_t>(width), static_cast<std::size_t>(height)), cl::NullRange,
                image, cl_int{large.width}, cl_int{large.height}, cl_int{width}, cl_int{height},
                cl_int{small.stride}, small.meters);
  return read(compute, small);
}

DepthImage mirrored(const DepthImage& image, bool mirror_u, bool mirror_v) {
  DepthImage result(image.width, image.height);
  for (int v = 0; v < image.height; ++v) {
    for (int u = 0; u < image.width; ++u) {
      result.at(u, v) = image.at(mirror_u ? image.width - 1 - u : u, mirror_v ? image.height - 1 - v : v);
    }
  }
  return result;
}

/// Image sizes of cameras, and their reduced sizes.
struct Reduction {
  int width, height, small_width, small_height;
};
constexpr Reduction kReductions[] = {{317, 233, 317, 233}, {317, 233, 100, 74},   {320, 240, 80, 60},
                                     {640, 480, 320, 240}, {848, 480, 320, 181},  {424, 240, 320, 181},
                                     {641, 480, 320, 240}, {1024, 768, 320, 240}, {8192, 64, 320, 3}};

TEST(ReduceDepth, MatchesTheFormula_AtAnyRatio) {
  onEachDevice([](ComputeContext& compute) {
    for (const Reduction& c : kReductions) {
      SCOPED_TRACE(c.width);
      const DepthImage large = testImage(c.width, c.height, 11);
      expectSame(reduced(compute, large, c.small_width, c.small_height),
                 reference::reduceDepth(large, c.small_width, c.small_height,
                                        static_cast<double>(c.width) / static_cast<double>(c.small_width),
                                        static_cast<double>(c.height) / static_cast<double>(c.small_height)));
    }
  });
}

TEST(ReduceDepth, GivesMirroredDepth_WhenImageIsMirrored) {
  onEachDevice([](ComputeContext& compute) {
    for (const Reduction& c : kReductions) {
      SCOPED_TRACE(c.width);
      const DepthImage large = testImage(c.width, c.height, 13);
      const DepthImage expected = reduced(compute, large, c.small_width, c.small_height);
      for (const auto& [u, v] : {std::pair(true, false), {false, true}, {true, true}}) {
        expectSame(reduced(compute, mirrored(large, u, v), c.small_width, c.small_height),
                   mirrored(expected, u, v));
      }
    }
  });
}

TEST(FilterDepth, MatchesTheFormula) {
  onEachWidth([](ComputeContext& compute) {
    Kernel kernel = kernelOf(compute, kernels::fusion, "filter_depth");
    for (const auto& [width, height] : {std::pair(320, 240), {317, 233}, {5, 3}}) {
      const DepthImage image = testImage(width, height, 3);
      const DepthPlane input = planeOf(compute, image);
      DepthPlane output(compute, width, height);
      kernel.launch(compute.lanes().overRows(width, height), compute.lanes().rowGroup(), input.meters,
                    cl_int{width}, cl_int{height}, cl_int{input.stride}, 0.008F, 0.008F, output.meters);
      expectSame(read(compute, output), reference::filterDepth(image, 0.008, 0.008));
    }
  });
}

TEST(BuildSurface, MatchesTheFormula) {
  onEachDevice([](ComputeContext& compute) {
    Kernel kernel = kernelOf(compute, kernels::fusion, "build_surface");
    for (const auto& [width, height] : {std::pair(320, 240), {317, 233}, {1, 1}}) {
      const Intrinsics K{290,   291,   static_cast<float>(width) / 2, static_cast<float>(height) / 2,
                         width, height};
      const DepthImage image = testImage(width, height, 5);
      const DepthPlane plane = planeOf(compute, image);
      const auto pixels = static_cast<std::size_t>(K.pixels());
      Buffer<cl_float4> vertices(compute.context(), pixels), normals(compute.context(), pixels);
      kernel.launch(cl::NDRange(static_cast<std::size_t>(width), static_cast<std::size_t>(height)),
                    cl::NullRange, plane.meters, cl_int{width}, cl_int{height}, cl_int{plane.stride},
                    toKernel(K.fx, K.fy, K.cx, K.cy), vertices, normals);
      const auto actual_v = vertices.read(compute.queue());
      const auto actual_n = normals.read(compute.queue());
      const reference::Surface expected = reference::buildSurface(image, K);
      for (std::size_t i = 0; i < pixels; ++i) {
        for (Eigen::Index k = 0; k < 4; ++k) {
          const auto c = static_cast<std::size_t>(k);
          ASSERT_NEAR(static_cast<double>(actual_v[i].s[c]), expected.vertices[i](k), kTolerance_m)
              << "vertex " << i;
          // Differences of a few mm have rounding errors of 2.4e-7 m, so angles have about 1e-4.
          ASSERT_NEAR(static_cast<double>(actual_n[i].s[c]), expected.normals[i](k), 5e-4) << "normal " << i;
        }
      }
    }
  });
}

}  // namespace
}  // namespace scantrove::test
