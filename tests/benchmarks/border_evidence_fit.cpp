// Fits the logistic models of BorderEvidence::logOdds() to random scenes with exact truth, with colour and
// without. A sample is a border of the evidence graph in view at every 20th frame: its features, and whether
// the fragments to both sides are of one thing. Prints how well the models do on scenes that they were not
// fitted to, and their coefficients as border_evidence.cpp takes them.
//
//   border_evidence_fit --cache DIR --rooms 1-4,5:uneven --tables 1-4,5:uneven [--stride 2] [--set key=value]
#include <Eigen/Cholesky>
#include <cmath>
#include <cstdio>
#include <map>
#include <set>

#include "tests/benchmarks/scene_scan.h"

namespace scantrove::benchmarks {
namespace {

constexpr int kLeastPixels = 20;      // of a fragment in view, for its thing to be known
constexpr double kLeastPurity = 0.7;  // part of them that are of one thing
constexpr double kRidge = 1;          // on each coefficient but the intercept
constexpr int kNewtonSteps = 30;

struct Sample {
  std::size_t scene = 0;
  Eigen::VectorXd x;  ///< 1, then the features
  bool are_one = false;
};

/// The true instance of each fragment in view that is clearly of one.
std::map<FragmentId, int> instancesOf(const std::vector<FragmentId>& fragments, const cv::Mat& truth) {
  std::map<FragmentId, std::map<int, int>> pixels;
  auto fragment = fragments.begin();
  for (const int instance : cv::Mat1i(truth)) ++pixels[*fragment++][instance];
  pixels.erase(FragmentId{});
  std::map<FragmentId, int> instances;
  for (const auto& [id, of] : pixels) {
    int all = 0;
    for (const auto& [instance, count] : of) all += count;
    const auto most = std::ranges::max_element(of, {}, [](const auto& entry) { return entry.second; });
    if (most->first == 0 || all < kLeastPixels || most->second < kLeastPurity * all) continue;
    instances[id] = most->first;
  }
  return instances;
}

void collect(const ScanPipeline& pipeline, const EvidenceGraph& graph, const FrameResult& result,
             const cv::Mat& truth, std::size_t scene, std::vector<Sample>& samples) {
  const std::map<FragmentId, int> instances = instancesOf(result.regions.fragments, truth);
  const std::vector<cl_int>& voxels = pipeline.voxelsOfFragments();
  for (const auto& [fragment, instance] : instances) {
    for (const EvidenceGraph::Link& link : graph.linksOf(fragment)) {
      const auto other = instances.find(link.other);
      if (link.other < fragment || other == instances.end()) continue;
      const auto features =
          graph.border(link.border).features(voxels[fragment.value], voxels[link.other.value]);
      Sample sample{scene, Eigen::VectorXd::Ones(features.size() + 1), instance == other->second};
      std::ranges::copy(features, sample.x.begin() + 1);
      samples.push_back(std::move(sample));
    }
  }
}

Result<std::vector<Sample>> collectSamples(const SceneOptions& options) {
  std::vector<Sample> samples;
  const auto scenes = scanForEvidence(
      options, [&](std::size_t scene, const ScanPipeline& pipeline, const EvidenceGraph& graph,
                   const FrameResult& result,
                   const cv::Mat& truth) { collect(pipeline, graph, result, truth, scene, samples); });
  if (!scenes) return fail(scenes.error());
  return samples;
}

/// Logistic regression by Newton's method. Coefficients: the intercept, then one a feature.
Eigen::VectorXd fitted(const std::vector<Sample>& samples) {
  const Eigen::Index size = samples.front().x.size();
  Eigen::VectorXd ridge = Eigen::VectorXd::Constant(size, kRidge);
  ridge[0] = 0;
  Eigen::VectorXd beta = Eigen::VectorXd::Zero(size);
  for (int step = 0; step < kNewtonSteps; ++step) {
    Eigen::MatrixXd hessian = ridge.asDiagonal();
    Eigen::VectorXd gradient = -ridge.cwiseProduct(beta);
    for (const Sample& sample : samples) {
      const double p = 1 / (1 + std::exp(-beta.dot(sample.x)));
      gradient += ((sample.are_one ? 1 : 0) - p) * sample.x;
      hessian += p * (1 - p) * sample.x * sample.x.transpose();
    }
    beta += hessian.ldlt().solve(gradient);
  }
  return beta;
}

struct Quality {
  double loss = 0;   ///< mean of -log of the probability that the model gave to what is true
  double right = 0;  ///< part of the samples whose side it is on
};

/// Each scene judged by the model that is fitted to the others.
Quality leaveOneSceneOut(const std::vector<Sample>& samples) {
  std::set<std::size_t> scenes;
  for (const Sample& sample : samples) scenes.insert(sample.scene);
  Quality quality;
  const double share = 1 / static_cast<double>(samples.size());
  for (const std::size_t scene : scenes) {
    std::vector<Sample> others;
    std::ranges::copy_if(samples, std::back_inserter(others),
                         [&](const Sample& sample) { return sample.scene != scene; });
    const Eigen::VectorXd beta = fitted(others);
    for (const Sample& sample : samples) {
      if (sample.scene != scene) continue;
      const double odds = beta.dot(sample.x);
      quality.loss += share * std::log1p(std::exp(sample.are_one ? -odds : odds));
      if ((odds > 0) == sample.are_one) quality.right += share;
    }
  }
  return quality;
}

/// `features`: how many of them the model knows; the others get the coefficient 0.
void report(const char* name, std::vector<Sample> samples, Eigen::Index features) {
  for (Sample& sample : samples) sample.x.conservativeResize(features + 1);
  const Quality quality = leaveOneSceneOut(samples);
  std::printf("\n%s: on scenes left out, loss %.3f, right %.3f\n", name, quality.loss, quality.right);
  const Eigen::VectorXd beta = fitted(samples);
  std::printf("{%.2fF, {", beta[0]);
  for (Eigen::Index i = 0; i < static_cast<Eigen::Index>(BorderEvidence::kFeatures); ++i) {
    std::printf("%s%.2fF", i == 0 ? "" : ", ", i < features ? beta[i + 1] : 0);
  }
  std::printf("}}\n");
}

Result<void> run(const SceneOptions& options) {
  const auto samples = collectSamples(options);
  if (!samples) return fail(samples.error());
  std::set<std::size_t> scenes;
  for (const Sample& sample : *samples) scenes.insert(sample.scene);
  if (scenes.size() < 2) return fail("One scene must be left out of the fit.", "Choose at least two.");
  const auto ones = std::ranges::count(*samples, true, &Sample::are_one);
  std::printf("\n%zu borders, %td within one thing\n", samples->size(), ones);
  report("with colour", *samples, BorderEvidence::kFeatures);
  report("without colour", *samples, BorderEvidence::kFeatures - 1);  // its feature is the last
  return {};
}

}  // namespace
}  // namespace scantrove::benchmarks

int main(int argc, char** argv) {
  using namespace scantrove::benchmarks;
  SceneOptions options;
  options.every = 20;
  return withScenes(argc, argv, "Fits what borders between fragments say, on random scenes", options,
                    [&] { return run(options); });
}
