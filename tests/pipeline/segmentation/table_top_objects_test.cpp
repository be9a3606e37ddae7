#include <gtest/gtest.h>

#include <map>
#include <opencv2/imgcodecs.hpp>

#include "core/fusion/dense_map.h"
#include "core/fusion/depth_preprocessor.h"
#include "core/segmentation/graph_segmenter.h"
#include "core/segmentation/upsample_segments.h"
#include "tests/support/recordings.h"

namespace scantrove {
namespace {

constexpr Intrinsics kCamera{525, 525, 319.5F, 239.5F, 640, 480};
constexpr int kImages = 45;
constexpr int kMinArea_px = 200;

/// Segments of one frame as in a scan (filter, map, raycast, segment), at the resolution of the depth image.
std::vector<std::uint32_t> segmentsOf(ComputeContext& compute, const cv::Mat& depth) {
  const FusionParams fusion;
  auto preprocessor = DepthPreprocessor::create(compute, kCamera, fusion);
  auto map = DenseMap::create(compute, fusion);
  auto segmenter = GraphSegmenter::create(compute);
  EXPECT_TRUE(preprocessor && map && segmenter);
  RgbdFrame frame;
  frame.depth = depth;
  const DepthPyramid& pyramid = (*preprocessor)->process(frame);
  (*map)->integrate(pyramid, Eigen::Isometry3d::Identity());
  SurfaceMaps surface;
  (*map)->raycast(Eigen::Isometry3d::Identity(), pyramid.levels[0].K, surface);
  const SegmentMap segments = (*segmenter)->segment(surface, {});
  const std::span<const std::uint16_t> readings(depth.ptr<std::uint16_t>(), depth.total());
  return DepthUpsampler(segments.depths_m, segments.width, segments.height,
                        {depth.cols, depth.rows, readings, frame.meters_per_unit})
      .apply(segments.ids);
}

/// For each true object (label / 10 >= 2), the best intersection over union with a segment.
std::vector<double> bestOverlaps(const cv::Mat& labels, const std::vector<std::uint32_t>& segments) {
  std::map<int, int> object_area;
  std::map<std::uint32_t, int> segment_area;
  std::map<int, std::map<std::uint32_t, int>> common;
  for (std::size_t i = 0; i < segments.size(); ++i) {
    const int object = labels.ptr<std::uint16_t>()[i] / 10;
    ++object_area[object];
    ++segment_area[segments[i]];
    ++common[object][segments[i]];
  }
  std::vector<double> result;
  for (const auto& [object, area] : object_area) {
    if (object < 2 || area < kMinArea_px) continue;
    double best = 0;
    for (const auto& [segment, both] : common[object]) {
      if (segment != 0)
        best = std::max(best, static_cast<double>(both) / (area + segment_area[segment] - both));
    }
    result.push_back(best);
  }
  return result;
}

TEST(TableTopObjects, SegmentsOfSingleFramesMatchObjects) {
  SCANTROVE_NEED_RECORDING(folder, "mosd");
  auto compute = ComputeContext::create({});
  ASSERT_TRUE(compute) << compute.error().message();
  double sum = 0;
  std::size_t objects = 0;
  for (int image = 0; image < kImages; ++image) {
    const std::string name = (folder / ("learn" + std::to_string(image))).string();
    const cv::Mat depth = cv::imread(name + "-depth.png", cv::IMREAD_UNCHANGED);
    const cv::Mat labels = cv::imread(name + "-label.png", cv::IMREAD_UNCHANGED);
    ASSERT_EQ(depth.type(), CV_16UC1) << name;
    ASSERT_EQ(labels.type(), CV_16UC1) << name;
    for (const double overlap : bestOverlaps(labels, segmentsOf(**compute, depth))) {
      sum += overlap;
      ++objects;
    }
  }
  ASSERT_GT(objects, 100U);
  const double mean = sum / static_cast<double>(objects);
  RecordProperty("mean_best_iou", std::to_string(mean));
  std::cout << "mean best IoU of " << objects << " objects: " << mean << '\n';
  EXPECT_GE(mean, 0.70);
}

}  // namespace
}  // namespace scantrove
