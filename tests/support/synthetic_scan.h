#pragma once
#include <gtest/gtest.h>

#include <cmath>
#include <memory>
#include <opencv2/imgproc.hpp>
#include <vector>

#include "core/evaluation/segmentation_metrics.h"
#include "core/evaluation/trajectory_metrics.h"
#include "core/pipeline/mapping_pipeline.h"
#include "core/segmentation/upsample_segments.h"
#include "core/synthetic/synthetic_source.h"

namespace scantrove::test {

/// Runs the mapping pipeline on a synthetic scene, without a catalogue.
class SyntheticScan {
 public:
  struct Frame {
    PoseEstimate pose;
    Eigen::Isometry3d true_pose;
    cv::Mat segments;   ///< S_t, CV_32SC1, working resolution
    cv::Mat regions;    ///< S_cloud,t as known at the frame, CV_32SC1
    cv::Mat instances;  ///< truth, CV_32SC1, working resolution
  };

  explicit SyntheticScan(const SyntheticOptions& options, const MappingParams& params = {},
                         PoseUse poses = PoseUse::none) {
    auto source = makeSyntheticSource(options);
    EXPECT_TRUE(source) << (source ? "" : source.error().message());
    source_ = std::move(*source);
    auto compute = ComputeContext::create({});
    EXPECT_TRUE(compute) << (compute ? "" : compute.error().message());
    compute_ = std::move(*compute);
    auto pipeline = MappingPipeline::create(*compute_, {options.K, params, poses});
    EXPECT_TRUE(pipeline) << (pipeline ? "" : pipeline.error().message());
    pipeline_ = std::move(*pipeline);
  }

  /// Processes all frames.
  void run() {
    for (;;) {
      FrameRead read = source_->next();
      if (read.status != FrameRead::Status::frame) break;
      Result<FrameResult> result = pipeline_->processFrame(read.frame);
      ASSERT_TRUE(result) << result.error().message();
      Frame frame;
      frame.pose = result->pose;
      frame.true_pose = source_->pose(read.frame.index);
      const Intrinsics& K = pipeline_->workingIntrinsics();
      frame.segments = image(result->segments.ids, K);
      frame.regions = image(result->view.regions, K);
      cv::resize(read.frame.instances, frame.instances, {K.width, K.height}, 0, 0, cv::INTER_NEAREST);
      frame.instances.convertTo(frame.instances, CV_32S);
      frames.push_back(std::move(frame));
    }
  }

  /// ATE RMSE in metres over the usable frames.
  [[nodiscard]] double trajectoryError() const {
    std::vector<PosePair> pairs;
    for (const Frame& frame : frames) {
      const double time = static_cast<double>(pairs.size());
      if (frame.pose.usable()) pairs.push_back({{time, frame.pose.T_world_camera}, {time, frame.true_pose}});
    }
    return absoluteTrajectoryError(pairs).rmse;
  }

  /// Regions of the map in a frame, as in labels-final/: surface without a label takes the nearest one.
  [[nodiscard]] cv::Mat finalRegions(const Frame& frame) const {
    const auto view =
        pipeline_->readout().renderView(frame.pose.T_world_camera, pipeline_->workingIntrinsics());
    EXPECT_TRUE(view) << view.error().message();
    std::vector<std::uint16_t> depth_mm;
    const cv::Mat1f z_m = view->depth().z_m;
    for (const float z : z_m) depth_mm.push_back(static_cast<std::uint16_t>(std::lround(1000 * z)));
    const DepthUpsampler upsampler({z_m.ptr<float>(), z_m.total()}, view->K.width, view->K.height,
                                   {view->K.width, view->K.height, depth_mm, 0.001F});
    return image(upsampler.apply(view->regions), pipeline_->workingIntrinsics());
  }

  /// Labels with at least `share` of the labelled pixels of `instance`.
  [[nodiscard]] static std::vector<int> labelsOf(const cv::Mat& labels, const cv::Mat& instances,
                                                 int instance, double share) {
    std::map<int, int> count;
    int total = 0;
    for (int i = 0; i < static_cast<int>(labels.total()); ++i) {
      const int label = labels.ptr<int>()[i];
      if (instances.ptr<int>()[i] != instance || label == 0) continue;
      ++count[label];
      ++total;
    }
    std::vector<int> result;
    for (const auto& [label, pixels] : count) {
      if (pixels >= share * total) result.push_back(label);
    }
    return result;
  }

  std::vector<Frame> frames;
  [[nodiscard]] const SyntheticSource& source() const { return *source_; }
  [[nodiscard]] MappingPipeline& pipeline() { return *pipeline_; }

 private:
  static int numberOf(std::uint32_t segment) { return static_cast<int>(segment); }
  static int numberOf(RegionId region) { return static_cast<int>(region.value); }
  template <class Id>
  static cv::Mat image(const std::vector<Id>& ids, const Intrinsics& K) {
    cv::Mat result(K.height, K.width, CV_32SC1, cv::Scalar(0));
    std::ranges::transform(ids, result.begin<int>(), [](Id id) { return numberOf(id); });
    return result;
  }

  std::unique_ptr<SyntheticSource> source_;
  std::unique_ptr<ComputeContext> compute_;
  std::unique_ptr<MappingPipeline> pipeline_;
};

}  // namespace scantrove::test
