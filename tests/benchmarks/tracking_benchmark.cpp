// Tracking and relocalisation on recordings with true poses, with depth filter, tracker and map only.
// `--there-and-back`: plays the recording forwards and backwards; distance between the two poses of a frame.
// `--kidnap N`: after 200 frames, N times the lens is covered for ten frames and the camera moves to a known
// place; counts relocalisations within five frames. `--strangers PATH`: frames of another place after the
// recording; none may be located. `--explain`: distances of the readings to maps made with the estimated and
// with the recorded poses. Where the former are smaller, the recorded poses cannot judge the last
// millimetres.
#include <spdlog/fmt/fmt.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <cmath>
#include <iostream>
#include <optional>

#include "core/evaluation/trajectory_metrics.h"
#include "core/scan/open_source.h"
#include "core/synthetic/hash_stream.h"
#include "tests/support/tracking_rig.h"

namespace scantrove {
namespace {

constexpr int kSeenBefore = 200;  // frames before the first kidnapping
constexpr int kCovered = 10;
constexpr int kElsewhere = 20;
constexpr int kInTime = 5;
constexpr double kWrong_m = 0.10;

struct Options {
  std::vector<std::string> recordings;
  std::string strangers;
  std::vector<float> intrinsics;
  int stride = 1;
  int frames = 0;
  int start = 0;
  int kidnap = 0;
  std::uint32_t seed = 1;
  bool there_and_back = false;
  bool without_color = false;
  bool explain = false;
  bool verbose = false;
};

/// A frame shown to the tracker, with its result.
struct Shown {
  RgbdFrame frame;
  PoseEstimate pose;
};

std::vector<RgbdFrame> readAll(const std::string& recording, const Options& options, Intrinsics& K) {
  SourceOptions which;
  which.stride = options.stride;
  which.start = options.start;
  if (options.frames > 0) which.frames = options.frames;
  if (const auto& f = options.intrinsics; f.size() == 4)
    which.intrinsics = Intrinsics{f[0], f[1], f[2], f[3], 0, 0};
  auto source = openSource(recording, which);
  if (!source) throw std::runtime_error(source.error().message());
  K = (*source)->info().intrinsics;
  std::vector<RgbdFrame> frames;
  for (;;) {
    FrameRead read = (*source)->next();
    if (read.status == FrameRead::Status::end || read.status == FrameRead::Status::failed) return frames;
    if (read.status != FrameRead::Status::frame) continue;
    if (options.without_color) read.frame.color.release();
    frames.push_back(std::move(read.frame));
  }
}

RgbdFrame covered(const RgbdFrame& like) {
  RgbdFrame frame = like;
  frame.depth = cv::Mat::zeros(like.depth.size(), like.depth.type());
  if (!like.color.empty()) frame.color = cv::Mat::zeros(like.color.size(), like.color.type());
  frame.T_world_camera.reset();
  return frame;
}

/// The order in which frames are shown; -1: covered.
std::vector<int> orderOf(const std::vector<RgbdFrame>& frames, const Options& options) {
  std::vector<int> order;
  const int count = static_cast<int>(frames.size());
  const int first = options.kidnap > 0 ? std::min(kSeenBefore, count) : count;
  for (int i = 0; i < first; ++i) order.push_back(i);
  if (options.there_and_back) {
    for (int i = count - 1; i >= 0; --i) order.push_back(i);
  }
  synthetic::HashStream random(options.seed, 1);
  for (int k = 0; k < options.kidnap; ++k) {
    for (int i = 0; i < kCovered; ++i) order.push_back(-1);
    const int way = k % 2 == 0 ? 1 : -1;
    const int from = random.between(kElsewhere, first - 1 - kElsewhere);
    for (int i = 0; i < kElsewhere; ++i) order.push_back(from + way * i);
  }
  return order;
}

/// Position errors of the usable poses after alignment; negative: not usable, or no truth.
std::vector<double> errorsOf(const std::vector<Shown>& shown, double& ate_m) {
  std::vector<PosePair> pairs;
  std::vector<double> errors_m(shown.size(), -1);
  for (std::size_t i = 0; i < shown.size(); ++i) {
    const auto time = static_cast<double>(i);
    if (shown[i].pose.usable() && shown[i].frame.T_world_camera)
      pairs.push_back({{time, shown[i].pose.T_world_camera}, {time, *shown[i].frame.T_world_camera}});
  }
  if (pairs.size() < 3) return errors_m;
  ate_m = absoluteTrajectoryError(pairs).rmse;
  const Eigen::Isometry3d T = alignRigidly(pairs);
  for (const PosePair& pair : pairs)
    errors_m[static_cast<std::size_t>(pair.truth.timestamp_s)] =
        ((T * pair.estimate.T_world_camera).translation() - pair.truth.T_world_camera.translation()).norm();
  return errors_m;
}

void reportKidnappings(const std::vector<Shown>& shown, int kidnappings) {
  const std::size_t length = kCovered + kElsewhere;
  const std::size_t first = shown.size() - length * static_cast<std::size_t>(kidnappings);
  int in_time = 0;
  std::string after;
  for (std::size_t k = 0; k < static_cast<std::size_t>(kidnappings); ++k) {
    int lost = 0;
    while (lost < kElsewhere &&
           !shown[first + k * length + kCovered + static_cast<std::size_t>(lost)].pose.usable())
      ++lost;
    in_time += lost < kInTime ? 1 : 0;
    after += fmt::format(" {}", lost);
  }
  std::cout << fmt::format("  found again within {} frames: {} of {}; frames lost:{}\n", kInTime, in_time,
                           kidnappings, after);
}

void reportWayBack(const std::vector<Shown>& shown, bool verbose) {
  double sum = 0, farthest = 0;
  int both = 0;
  for (std::size_t i = 0; i < shown.size() / 2; ++i) {
    const Shown& there = shown[i];
    const Shown& back = shown[shown.size() - 1 - i];
    if (!there.pose.usable() || !back.pose.usable()) continue;
    const double apart =
        (there.pose.T_world_camera.translation() - back.pose.T_world_camera.translation()).norm();
    sum += apart;
    farthest = std::max(farthest, apart);
    ++both;
    if (verbose)
      std::cout << fmt::format("  {}: back {:.1f} mm off, drift {:.1f} mm\n", i, 1000 * apart,
                               1000 * back.pose.drift_m.value_or(0));
  }
  std::cout << fmt::format("  the same frame on the way back: {:.1f} mm off on average, {:.1f} at most\n",
                           1000 * sum / std::max(both, 1), 1000 * farthest);
}

void report(const std::string& name, const std::vector<Shown>& shown, const std::vector<double>& track_ms,
            const Options& options) {
  int with_truth = 0, usable = 0, relocalized = 0, wrong = 0;
  double ate_m = 0, farthest_m = 0;
  const std::vector<double> errors_m = errorsOf(shown, ate_m);
  std::string lost;
  for (std::size_t i = 0; i < shown.size(); ++i) {
    if (shown[i].frame.depth.empty() || !shown[i].frame.T_world_camera) continue;
    ++with_truth;
    usable += shown[i].pose.usable() ? 1 : 0;
    relocalized += shown[i].pose.state == TrackingState::relocalized ? 1 : 0;
    wrong += errors_m[i] > kWrong_m ? 1 : 0;
    farthest_m = std::max(farthest_m, errors_m[i]);
    if (!shown[i].pose.usable()) lost += fmt::format(" {}", shown[i].frame.index);
    if (options.verbose)
      std::cout << fmt::format("{} {} inliers {:.2f} free {} rmse {:.1f} mm, off {:.1f} mm, {:.1f} ms\n",
                               shown[i].frame.index, toString(shown[i].pose.state),
                               shown[i].pose.inlier_fraction, shown[i].pose.free_directions,
                               1000 * shown[i].pose.rmse_m, 1000 * errors_m[i], track_ms[i]);
  }
  const DurationSummary time = summarize(track_ms);
  std::cout << fmt::format(
      "{}: tracked {} of {} ({:.1f} %), relocalised {}, ATE {:.1f} mm, at most {:.1f}, wrong {}; track "
      "{:.1f} ms, p95 {:.1f}\n",
      name, usable, with_truth, 100.0 * usable / std::max(with_truth, 1), relocalized, 1000 * ate_m,
      1000 * farthest_m, wrong, time.median_ms, time.p95_ms);
  if (!lost.empty()) std::cout << "  lost:" << lost << '\n';
  if (options.kidnap > 0) reportKidnappings(shown, options.kidnap);
  if (options.there_and_back) reportWayBack(shown, options.verbose);
}

/// Distances of readings to a map made of them all, with the poses of `poseOf`. Readings farther than kFar_m
/// are counted separately: they lie at outlines, where a tiny shift changes the visible surface.
template <class PoseOf>
std::string distanceToMap(const std::vector<Shown>& shown, const Intrinsics& K, ComputeContext& compute,
                          const PoseOf& poseOf) {
  constexpr std::size_t kEvery = 10;
  constexpr double kFar_m = 0.05;
  const FusionParams params;
  const auto preprocessor = DepthPreprocessor::create(compute, K, params).value();
  const auto map = DenseMap::create(compute, params).value();
  for (const Shown& one : shown) {
    if (const auto pose = poseOf(one)) map->integrate(preprocessor->process(one.frame), *pose);
  }
  std::vector<double> off_m;
  std::size_t readings = 0, far = 0;
  SurfaceMaps surface;
  for (std::size_t i = 0; i < shown.size(); i += kEvery) {
    const auto pose = poseOf(shown[i]);
    if (!pose) continue;
    const DepthPyramid::Level& level = preprocessor->process(shown[i].frame).levels.front();
    map->raycast(*pose, level.K, surface);
    const std::vector<cl_float4> seen = level.vertices_camera.read(compute.queue());
    const std::vector<cl_float4> met = surface.vertices_world.read(compute.queue());
    const Eigen::Isometry3d T_camera_world = pose->inverse();
    for (std::size_t pixel = 0; pixel < seen.size(); ++pixel) {
      if (!(seen[pixel].s[3] > 0) || !(met[pixel].s[3] > 0)) continue;
      const Eigen::Vector3d there =
          T_camera_world * Eigen::Vector3f(met[pixel].s[0], met[pixel].s[1], met[pixel].s[2]).cast<double>();
      const double off = std::abs(there.z() - static_cast<double>(seen[pixel].s[2]));
      ++readings;
      if (off > kFar_m) {
        ++far;
      } else {
        off_m.push_back(off);
      }
    }
  }
  if (off_m.empty()) return "nothing to compare";
  double squares = 0;
  for (const double off : off_m) squares += off * off;
  std::ranges::nth_element(off_m, off_m.begin() + std::ssize(off_m) / 2);
  return fmt::format("median {:.2f} mm, RMS {:.2f} mm, over 5 cm {:.2f} %", 1000 * off_m[off_m.size() / 2],
                     1000 * std::sqrt(squares / static_cast<double>(off_m.size())),
                     100.0 * static_cast<double>(far) / static_cast<double>(readings));
}

void explain(const std::vector<Shown>& shown, const Intrinsics& K, ComputeContext& compute) {
  using Pose = std::optional<Eigen::Isometry3d>;
  const auto estimated = [](const Shown& one) {
    return one.pose.usable() ? Pose(one.pose.T_world_camera) : std::nullopt;
  };
  const auto recorded = [](const Shown& one) { return one.frame.T_world_camera; };
  std::cout << "  readings from a map made with the estimated poses: "
            << distanceToMap(shown, K, compute, estimated)
            << "\n  readings from a map made with the recording's:      "
            << distanceToMap(shown, K, compute, recorded) << '\n';
}

void run(const std::string& recording, const Options& options) {
  Intrinsics K;
  const std::vector<RgbdFrame> frames = readAll(recording, options, K);
  auto compute = ComputeContext::create({});
  if (!compute) throw std::runtime_error(compute.error().message());
  test::TrackingRig rig(**compute, K);
  std::vector<Shown> shown;
  for (const int which : orderOf(frames, options)) {
    RgbdFrame frame = which >= 0 ? frames[static_cast<std::size_t>(which)] : covered(frames.front());
    frame.index = static_cast<int>(shown.size());
    const PoseEstimate pose = rig.show(frame);
    shown.push_back({frame, pose});
    for (const auto& [index, late] : rig.takeLateFrames()) shown[static_cast<std::size_t>(index)].pose = late;
  }
  report(recording, shown, rig.trackTimes_ms(), options);
  if (options.explain) explain(shown, K, **compute);
  if (options.strangers.empty()) return;
  int found = 0, tried = 0;
  for (const RgbdFrame& frame : readAll(options.strangers, options, K)) {
    static_cast<void>(rig.show(covered(frame)));
    found += rig.show(frame).usable() ? 1 : 0;
    ++tried;
  }
  std::cout << fmt::format("  of {} frames of {}, {} were taken for this place\n", tried, options.strangers,
                           found);
}

}  // namespace
}  // namespace scantrove

int main(int argc, char** argv) {
  CLI::App app("Tracking and relocalisation on recordings");
  scantrove::Options options;
  app.add_option("recordings", options.recordings, "with true poses, or demo:...")->required();
  app.add_option("--stride", options.stride, "every N-th frame");
  app.add_option("--start", options.start, "first frame");
  app.add_option("--frames", options.frames, "only the first N");
  app.add_option("--intrinsics", options.intrinsics, "fx,fy,cx,cy")->delimiter(',')->expected(4);
  app.add_option("--kidnap", options.kidnap, "so many times");
  app.add_option("--seed", options.seed, "of the places to which it is kidnapped");
  app.add_option("--strangers", options.strangers, "a recording of another place");
  app.add_flag("--there-and-back", options.there_and_back, "then backwards");
  app.add_flag("--without-color", options.without_color, "depth alone");
  app.add_flag("--explain", options.explain, "whose poses fit the readings better");
  app.add_flag("--verbose", options.verbose, "a line for each frame");
  CLI11_PARSE(app, argc, argv);
  try {
    for (const std::string& recording : options.recordings) scantrove::run(recording, options);
  } catch (const std::exception& error) {
    std::cerr << error.what() << '\n';
    return 1;
  }
  return 0;
}
