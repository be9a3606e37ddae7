// Fits the coefficients of BorderEvidence::logOdds() to scenes whose truth is known, and reports how merging does:
//   border_evidence_fit [--set key=value] SCENE...      e.g. demo:room demo:tabletop:3
// For every border of the evidence graph, at every 20th frame: do its two fragments belong to the same thing?
#include <CLI/CLI.hpp>
#include <cmath>
#include <iostream>
#include <map>
#include <opencv2/imgproc.hpp>

#include "core/evaluation/label_grid.h"
#include "core/exchange/label_image_writer.h"
#include "core/evaluation/overlap_metrics.h"
#include "core/evaluation/segmentation_metrics.h"
#include "core/labeling/graph_merger.h"
#include "core/scan/open_source.h"
#include "core/scan/param_registry.h"
#include "core/scan/scan_pipeline.h"

namespace {

using namespace scantrove;

struct Sample {
  Eigen::VectorXd features;
  bool are_one = false;
  double weight = 1;
};

struct Score {
  double single = 0, merged = 0;
  int small = 0, small_single = 0, small_merged = 0, large = 0, large_single = 0, large_merged = 0, images = 0;
  double oracle = 0;
  int small_oracle = 0, large_oracle = 0;
};

cv::Mat1i image(const auto& ids, const Intrinsics& K) {
  cv::Mat1i result(K.height, K.width);
  std::transform(ids.begin(), ids.end(), result.begin(), [](auto id) {
    if constexpr (requires { id.value; }) return static_cast<int>(id.value);
    else return static_cast<int>(id);
  });
  return result;
}

void countHalf(const cv::Mat1i& labels, const cv::Mat1i& truth, int& small, int& large, int* all_small, int* all_large) {
  const OverlapTable table = countOverlaps(labels, truth, 100);
  std::map<int, double> best;
  for (const auto& [pair, shared] : table.intersection) {
    const int united = table.instance_area.at(pair.first) + table.segment_area.at(pair.second) - shared;
    best[pair.first] = std::max(best[pair.first], static_cast<double>(shared) / united);
  }
  for (const auto& [instance, area] : table.instance_area) {
    const bool is_small = area <= 3750;
    if (all_small != nullptr) ++*(is_small ? all_small : all_large);
    if (best[instance] > 0.5) ++(is_small ? small : large);
  }
}

}  // namespace

int main(int argc, char** argv) {
  CLI::App app;
  std::vector<std::string> scenes, settings;
  int stride = 1, frames = 0;
  bool fit = false;
  app.add_option("scenes", scenes)->required();
  app.add_option("--set", settings);
  app.add_option("--stride", stride);
  app.add_option("--frames", frames);
  app.add_flag("--fit", fit);
  std::string csv_path;
  app.add_option("--csv", csv_path);
  CLI11_PARSE(app, argc, argv);
  std::vector<Sample> samples;
  std::FILE* csv = csv_path.empty() ? nullptr : std::fopen(csv_path.c_str(), "w");
  auto compute = ComputeContext::create({});
  Score mean;
  double ratio_sum = 0;
  for (const std::string& scene : scenes) {
    ScanParams params;
    for (const std::string& setting : settings) {
      if (auto r = applySetting(params, setting); !r) return std::cerr << r.error().message() << '\n', 1;
    }
    SourceOptions options;
    options.stride = stride;
    if (frames > 0) options.frames = frames;
    auto source = openSource(scene, options);
    if (!source) return std::cerr << source.error().message() << '\n', 1;
    auto pipeline = ScanPipeline::create(**compute, {(*source)->info().intrinsics, params, false, nullptr, 0});
    std::map<std::uint32_t, std::map<int, int>> truth_of;
    Score score;
    int frame = 0, lost = 0;
    for (;; ++frame) {
      FrameRead read = (*source)->next();
      if (read.status != FrameRead::Status::frame) break;
      auto result = (*pipeline)->processFrame(read.frame);
      if (!result) return std::cerr << result.error().message() << '\n', 1;
      if (!result->pose.usable()) {
        ++lost;
        continue;
      }
      const Intrinsics& K = (*pipeline)->workingIntrinsics();
      if (frame % 5 != 4) continue;
      cv::Mat instances;
      if (read.frame.instances.empty()) {
        std::array<char, 40> name{};
        std::snprintf(name.data(), name.size(), "/frame-%06d.instance.png", read.frame.index);
        const auto stored = readLabelImage(scene + name.data());
        if (!stored) return std::cerr << stored.error().message() << "\n", 1;
        read.frame.instances = *stored;
      }
      cv::resize(read.frame.instances, instances, {K.width, K.height}, 0, 0, cv::INTER_NEAREST);
      const cv::Mat1i truth = toLabelGrid(instances);
      const cv::Mat1i segments = image(result->segments.ids, K), regions = image(result->regions.regions, K);
      const auto single = evaluateSegmentation(segments, truth), merged = evaluateSegmentation(regions, truth);
      score.single += single.boundary_error;
      score.merged += merged.boundary_error;
      ++score.images;
      countHalf(segments, truth, score.small_single, score.large_single, &score.small, &score.large);
      countHalf(regions, truth, score.small_merged, score.large_merged, nullptr, nullptr);
      // The best that any partition of these fragments could be.
      std::map<int, std::map<int, int>> held;
      const cv::Mat1i parts = image(result->regions.fragments, K);
      for (int p = 0; p < K.pixels(); ++p) ++held[parts.ptr<int>()[p]][truth.ptr<int>()[p]];
      cv::Mat1i best = parts.clone();
      for (int& part : best) {
        if (part == 0) continue;
        const auto& of = held[part];
        part = 1 + std::max_element(of.begin(), of.end(), [](auto& a, auto& b) { return a.second < b.second; })->first;
      }
      score.oracle += evaluateSegmentation(best, truth).boundary_error;
      countHalf(best, truth, score.small_oracle, score.large_oracle, nullptr, nullptr);
      if (frame % 20 == 19 && fit) {
        truth_of.clear();
        for (int p = 0; p < K.pixels(); ++p) {
          const FragmentId f = result->regions.fragments[static_cast<std::size_t>(p)];
          if (f) ++truth_of[f.value][truth.ptr<int>()[p]];
        }
        if (csv != nullptr) {
          std::map<int, int> instance_area, unlabelled;
          for (int p = 0; p < K.pixels(); ++p) ++instance_area[truth.ptr<int>()[p]];
          for (auto& [id, area] : instance_area) std::fprintf(csv, "I,%s,%d,%d,%d\n", scene.c_str(), frame, id, area);
          for (auto& [f, of] : truth_of)
            for (auto& [id, count] : of) std::fprintf(csv, "F,%s,%d,%u,%d,%d\n", scene.c_str(), frame, f, id, count);
        }
        const auto& graph = dynamic_cast<const GraphMerger&>((*pipeline)->regionMerger()).graph();
        const auto majority = [&](std::uint32_t f, double& purity) {
          int most = 0, n = 0, total = 0;
          for (auto& [id, c] : truth_of[f]) {
            total += c;
            if (c > n) n = c, most = id;
          }
          purity = static_cast<double>(n) / total;
          return total < 20 ? 0 : most;
        };
        for (const auto& [f, unused] : truth_of) {
          double pa = 0, pb = 0;
          const int a = majority(f, pa);
          for (const auto& link : graph.linksOf(FragmentId{f})) {
            if (link.other.value < f || !truth_of.contains(link.other.value)) continue;
            const int b = majority(link.other.value, pb);
            if (csv != nullptr) {
              const auto& e = graph.border(link.border);
              const auto& vox = (*pipeline)->voxels();
              std::fprintf(csv, "E,%s,%d,%d,%g,%g,%g,%g,%g,%g,%g,%g,%g,%d,%d,%d,%d,%g,%g,%u,%u\n", scene.c_str(), frame, a == 0 || b == 0 || pa < 0.7 || pb < 0.7 ? -1 : a == b, e.looks, e.bridged, e.shared, e.bends, e.concavity_rad, e.turn_rad, e.folded, e.ridged, e.length_m, vox[f], vox[link.other.value], a, b, 0.0, static_cast<double>(e.color_shift.value_or(0)), f, link.other.value);
            }
            if (a == 0 || b == 0 || pa < 0.7 || pb < 0.7) continue;
            const auto x = graph.border(link.border).features((*pipeline)->voxels()[f], (*pipeline)->voxels()[link.other.value]);
            samples.push_back({Eigen::Map<const Eigen::VectorXf>(x.data(), static_cast<Eigen::Index>(x.size())).cast<double>(), a == b, 1});
          }
        }
      }
    }
    auto regions = (*pipeline)->regionCount();
    std::printf("%-22s n %3d lost %d err %.2f %.2f (%.2f) ratio %.3f | small %4d %.3f %.3f (%.3f) | large %4d %.3f %.3f (%.3f) | regions %d fragments %zu\n", scene.c_str(),
                frame, lost, score.single / score.images, score.merged / score.images, score.oracle / score.images, score.merged / score.single,
                score.small, 1.0 * score.small_single / score.small, 1.0 * score.small_merged / score.small, 1.0 * score.small_oracle / score.small, score.large,
                1.0 * score.large_single / score.large, 1.0 * score.large_merged / score.large, 1.0 * score.large_oracle / score.large, *regions,
                (*pipeline)->regionTable().regions().size());
    std::fflush(stdout);
    ratio_sum += score.merged / score.single;
    mean.small += score.small; mean.small_single += score.small_single; mean.small_merged += score.small_merged;
    mean.large += score.large; mean.large_single += score.large_single; mean.large_merged += score.large_merged;
  }
  std::printf("MEAN ratio %.3f small %.3f %.3f large %.3f %.3f\n", ratio_sum / static_cast<double>(scenes.size()),
              1.0 * mean.small_single / mean.small, 1.0 * mean.small_merged / mean.small,
              1.0 * mean.large_single / mean.large, 1.0 * mean.large_merged / mean.large);
  if (!fit) return 0;
  // Logistic regression with a little ridge, by Newton's method.
  const Eigen::Index n = samples.front().features.size();
  Eigen::VectorXd beta = Eigen::VectorXd::Zero(n + 1);
  for (int step = 0; step < 30; ++step) {
    Eigen::MatrixXd H = Eigen::MatrixXd::Identity(n + 1, n + 1) * 1.0;
    Eigen::VectorXd g = -beta;
    for (const Sample& s : samples) {
      Eigen::VectorXd x(n + 1);
      x << 1, s.features;
      const double p = 1 / (1 + std::exp(-beta.dot(x)));
      g += ((s.are_one ? 1 : 0) - p) * x;
      H += p * (1 - p) * x * x.transpose();
    }
    beta += H.ldlt().solve(g);
  }
  int right = 0, ones = 0;
  double loss = 0;
  const auto total = static_cast<double>(samples.size());
  for (const Sample& s : samples) {
    Eigen::VectorXd x(n + 1);
    x << 1, s.features;
    const double z = beta.dot(x);
    right += (z > 0) == s.are_one;
    ones += s.are_one;
    loss += std::log1p(std::exp(s.are_one ? -z : z));
  }
  std::cout << samples.size() << " samples, one " << ones << ", right " << right / total << " loss " << loss / total << "\n"
            << beta.transpose() << "\n";
}
