// Fits the trees of WholenessEvidence::logOdds() to random scenes with exact truth. A sample is a region, a
// part of one, or a set of these, in a frame of a scan that has ended: what RegionJudge says of it, and
// whether it is one whole thing there (IoU > 0.6). Prints how well the trees do on scenes that they were not
// fitted to, and core/discovery/wholeness_trees.h.
//
//   wholeness_fit --cache DIR --rooms 161-164,171-174 --tables 161-164,171-174 > wholeness_trees.h
#include <cmath>
#include <cstdio>
#include <limits>
#include <map>
#include <numeric>
#include <set>

#include "core/discovery/boosted_tree.h"
#include "core/discovery/region_judge.h"
#include "tests/benchmarks/scene_scan.h"

namespace scantrove::benchmarks {
namespace {

constexpr double kWholeOverlap = 0.6;  // as `scantrove evaluate catalogue` counts
constexpr std::size_t kTrees = 120;
constexpr double kLearningRate = 0.1, kRidge = 1;
constexpr int kLeastSamples = 40;  // of a leaf
constexpr std::size_t kBins = 64;  // of a feature's values, as many in each
constexpr std::size_t kFolds = 8;
constexpr std::size_t kNeighbourLikeness = 14, kTouchingLikeness = 15;  // of WholenessEvidence::features()

using Features = std::array<float, WholenessEvidence::kFeatures>;

struct Sample {
  std::size_t scene = 0;
  Features x{};
  bool is_whole = false;
};

/// Keeps what a judge says of a frame, beside what is true there.
class Recorder final : public CandidateSource {
 public:
  /// `finer`: of whose regions the judge is; only what holds a part of a region is kept then. Null: all.
  Recorder(RegionJudge judge, std::set<int> things, const FinerRegions* finer)
      : judge_(std::move(judge)), things_(std::move(things)), finer_(finer) {}

  void nextFrame(std::size_t scene, cv::Mat truth) {
    scene_ = scene;
    truth_ = std::move(truth);
  }
  std::vector<Candidate> find(const DiscoveryInput& input) override {
    const cv::Mat1i instances = truth_;
    std::map<int, int> visible;
    std::map<RegionId, std::map<int, int>> shared;
    std::map<RegionId, int> pixels;
    for (std::size_t i = 0; i < input.regions.regions.size(); ++i) {
      const int instance = instances(static_cast<int>(i));
      ++visible[instance];
      ++shared[input.regions.regions[i]][instance];
      ++pixels[input.regions.regions[i]];
    }
    for (const auto& [hypothesis, evidence] : judge_.judge(input)) {
      if (finer_ != nullptr && !finer_->holdsPart(hypothesis.regions)) continue;
      int mask = 0;
      std::map<int, int> of;
      for (const RegionId region : hypothesis.regions) {
        mask += pixels[region];
        for (const auto& [instance, count] : shared[region]) of[instance] += count;
      }
      const bool is_whole = std::ranges::any_of(of, [&](const auto& entry) {
        const auto& [instance, count] = entry;
        return things_.contains(instance) && count > kWholeOverlap * (mask + visible[instance] - count);
      });
      samples.push_back({scene_, evidence.features(), is_whole});
    }
    return {};
  }
  [[nodiscard]] const RegionCensus& census() const override { return judge_.census(); }

  std::vector<Sample> samples;

 private:
  RegionJudge judge_;
  std::set<int> things_;
  const FinerRegions* finer_;
  std::size_t scene_ = 0;
  cv::Mat truth_;
};

/// Samples by feature and bin, so that splits are found by sums over bins.
class Bins {
 public:
  explicit Bins(const std::vector<Sample>& samples) {
    for (std::size_t f = 0; f < limits_.size(); ++f) {
      std::vector<float> values;
      for (const Sample& sample : samples) values.push_back(sample.x[f]);
      std::ranges::sort(values);
      for (std::size_t b = 1; b < kBins; ++b) {
        const std::size_t at = b * values.size() / kBins;
        const float limit = (values[at - 1] + values[at]) / 2;
        if (limit < values.back() && (limits_[f].empty() || limit > limits_[f].back()))
          limits_[f].push_back(limit);
      }
      for (const Sample& sample : samples) bins_[f].push_back(binOf(f, sample.x[f]));
    }
  }
  [[nodiscard]] std::size_t of(std::size_t feature, std::size_t sample) const {
    return bins_[feature][sample];
  }
  /// The highest value of each bin but the last.
  [[nodiscard]] const std::vector<float>& limits(std::size_t feature) const { return limits_[feature]; }

 private:
  [[nodiscard]] std::size_t binOf(std::size_t feature, float value) const {
    return static_cast<std::size_t>(std::ranges::lower_bound(limits_[feature], value) -
                                    limits_[feature].begin());
  }
  std::array<std::vector<float>, WholenessEvidence::kFeatures> limits_;
  std::array<std::vector<std::size_t>, WholenessEvidence::kFeatures> bins_;
};

/// Sums of the loss' first and second derivatives.
struct Slope {
  double first = 0, second = 0;
  int count = 0;
  void operator+=(const Slope& other) {
    first += other.first;
    second += other.second;
    count += other.count;
  }
  [[nodiscard]] Slope without(const Slope& other) const {
    return {first - other.first, second - other.second, count - other.count};
  }
  [[nodiscard]] double gain() const { return first * first / (second + kRidge); }
  [[nodiscard]] float value() const { return static_cast<float>(-kLearningRate * first / (second + kRidge)); }
};

/// Logistic loss, Newton's step in each leaf (Friedman 2001; Chen and Guestrin 2016).
class Boosting {
 public:
  Boosting(const std::vector<Sample>& samples) : samples_(samples), bins_(samples), odds_(samples.size()) {
    const auto whole = static_cast<double>(std::ranges::count(samples, true, &Sample::is_whole));
    prior = static_cast<float>(std::log(whole / (static_cast<double>(samples.size()) - whole)));
    std::ranges::fill(odds_, prior);
    for (std::size_t i = 0; i < kTrees; ++i) addTree();
  }
  [[nodiscard]] double oddsOf(const Features& x) const {
    return std::accumulate(
        trees.begin(), trees.end(), static_cast<double>(prior),
        [&](double sum, const BoostedTree& tree) { return sum + static_cast<double>(tree.valueOf(x)); });
  }

  float prior = 0;
  std::vector<BoostedTree> trees;

 private:
  [[nodiscard]] Slope slopeAt(std::size_t i) const {
    const double p = 1 / (1 + std::exp(-static_cast<double>(odds_[i])));
    return {p - (samples_[i].is_whole ? 1 : 0), p * (1 - p), 1};
  }
  void addTree() {
    std::vector<Slope> slopes;
    for (std::size_t i = 0; i < samples_.size(); ++i) slopes.push_back(slopeAt(i));
    BoostedTree tree{};
    std::vector<std::vector<std::size_t>> nodes(BoostedTree::kSplits + BoostedTree::kLeaves);
    nodes[0].resize(samples_.size());
    std::iota(nodes[0].begin(), nodes[0].end(), std::size_t{0});
    for (std::size_t node = 0; node < BoostedTree::kSplits; ++node) {
      tree.splits[node] = bestSplit(nodes[node], slopes);
      const auto [feature, most] = tree.splits[node];
      for (const std::size_t i : nodes[node]) {
        const bool is_left = samples_[i].x[static_cast<std::size_t>(feature)] <= most;
        nodes[2 * node + (is_left ? 1 : 2)].push_back(i);
      }
    }
    for (std::size_t leaf = 0; leaf < BoostedTree::kLeaves; ++leaf) {
      Slope all;
      for (const std::size_t i : nodes[BoostedTree::kSplits + leaf]) all += slopes[i];
      tree.leaves[leaf] = all.value();
    }
    for (std::size_t i = 0; i < samples_.size(); ++i) odds_[i] += tree.valueOf(samples_[i].x);
    trees.push_back(tree);
  }
  /// Where nothing is gained all go to the left.
  [[nodiscard]] BoostedTree::Split bestSplit(const std::vector<std::size_t>& node,
                                             const std::vector<Slope>& slopes) const {
    BoostedTree::Split best{0, std::numeric_limits<float>::max()};
    double most = 0;
    for (std::size_t feature = 0; feature < WholenessEvidence::kFeatures; ++feature) {
      const std::vector<float>& limits = bins_.limits(feature);
      std::vector<Slope> sums(limits.size() + 1);
      Slope all;
      for (const std::size_t i : node) {
        sums[bins_.of(feature, i)] += slopes[i];
        all += slopes[i];
      }
      Slope left;
      for (std::size_t bin = 0; bin < limits.size(); ++bin) {
        left += sums[bin];
        const Slope right = all.without(left);
        if (left.count < kLeastSamples || right.count < kLeastSamples) continue;
        const double gain = left.gain() + right.gain() - all.gain();
        if (gain <= most) continue;
        most = gain;
        best = {static_cast<std::int8_t>(feature), limits[bin]};
      }
    }
    return best;
  }

  const std::vector<Sample>& samples_;
  Bins bins_;
  std::vector<float> odds_;
};

/// Samples judged by trees that are fitted to other scenes.
void reportOnOthers(const std::vector<Sample>& samples) {
  double loss = 0;
  int right = 0;
  std::vector<std::pair<double, bool>> judged;
  for (std::size_t fold = 0; fold < kFolds; ++fold) {
    std::vector<Sample> others;
    std::ranges::copy_if(samples, std::back_inserter(others),
                         [&](const Sample& sample) { return sample.scene % kFolds != fold; });
    const Boosting boosting(others);
    for (const Sample& sample : samples) {
      if (sample.scene % kFolds != fold) continue;
      const double odds = boosting.oddsOf(sample.x);
      loss += std::log1p(std::exp(sample.is_whole ? -odds : odds));
      right += (odds > 0) == sample.is_whole ? 1 : 0;
      judged.emplace_back(odds, sample.is_whole);
    }
  }
  std::ranges::sort(judged);
  double below = 0, ordered = 0;  // samples that are not whole, and pairs in the right order
  for (const auto& [odds, is_whole] : judged) (is_whole ? ordered : below) += is_whole ? below : 1;
  const auto all = static_cast<double>(samples.size());
  std::fprintf(stderr, "on scenes left out: loss %.3f, right %.3f, area under the curve %.3f\n", loss / all,
               right / all, ordered / (below * (all - below)));
}

std::string inCpp(float value) {
  std::string text = fmt::format("{:.4g}", value);
  if (text.find_first_of(".e") == std::string::npos) text += ".0";
  return text + "F";
}

float medianOf(std::size_t feature, const std::vector<Sample>& samples) {
  std::vector<float> values;
  for (const Sample& sample : samples) values.push_back(sample.x[feature]);
  const auto middle = values.begin() + static_cast<std::ptrdiff_t>(values.size() / 2);
  std::ranges::nth_element(values, middle);
  return *middle;
}

void print(const Boosting& boosting, const std::vector<Sample>& samples, const SceneOptions& options) {
  std::printf(
      "#pragma once\n#include <array>\n\n#include \"core/discovery/boosted_tree.h\"\n\n"
      "namespace scantrove {\n\n// clang-format off\n// By wholeness_fit to demo:room:%s and "
      "demo:tabletop:%s.\n",
      fmt::format("{}", fmt::join(options.rooms, ",")).c_str(),
      fmt::format("{}", fmt::join(options.tables, ",")).c_str());
  std::printf(
      "inline constexpr float kWholenessPrior = %s;\n// Medians, for what has no colour.\n"
      "inline constexpr float kUsualNeighbourLikeness = %s, kUsualTouchingLikeness = %s;\n"
      "inline constexpr std::array<BoostedTree, %zu> kWholenessTrees{{\n",
      inCpp(boosting.prior).c_str(), inCpp(medianOf(kNeighbourLikeness, samples)).c_str(),
      inCpp(medianOf(kTouchingLikeness, samples)).c_str(), boosting.trees.size());
  for (const BoostedTree& tree : boosting.trees) {
    std::vector<std::string> splits, leaves;
    for (const auto& [feature, most] : tree.splits) {
      const bool is_split = most < std::numeric_limits<float>::max();
      splits.push_back(
          fmt::format("{{{}, {}}}", static_cast<int>(feature), is_split ? inCpp(most) : "1e30F"));
    }
    for (const float leaf : tree.leaves) leaves.push_back(inCpp(leaf));
    std::printf("    {{{%s}}, {%s}},\n", fmt::format("{}", fmt::join(splits, ", ")).c_str(),
                fmt::format("{}", fmt::join(leaves, ", ")).c_str());
  }
  std::printf("}};\n// clang-format on\n\n}  // namespace scantrove\n");
}

Result<std::set<int>> thingsOf(const std::string& scene) {
  SourceOptions first;
  first.frames = 1;
  const auto source = makeSyntheticSource(scene, first);
  if (!source) return fail(source.error());
  std::set<int> things;
  for (const InstanceName& instance : (*source)->info().instances) {
    if (instance.is_object) things.insert(instance.id);
  }
  return things;
}

/// Scans the scene, then looks at it again from frames of the scan.
Result<void> collect(const std::string& name, std::size_t scene, const std::filesystem::path& recording,
                     const SceneOptions& options, ComputeContext& compute, std::vector<Sample>& samples) {
  const Result<std::set<int>> things = thingsOf(name);
  if (!things) return fail(things.error());
  struct Place {
    Eigen::Isometry3d T_world_camera;
    cv::Mat truth;
  };
  std::map<int, Place> places;  // by RgbdFrame::index
  const auto scan =
      scanScene(recording, {}, options, compute,
                [&](const ScanPipeline&, int index, const FrameResult& result, const cv::Mat& truth) {
                  places[index] = {result.pose.T_world_camera, truth.clone()};
                });
  if (!scan) return fail(scan.error());
  const FinerRegions finer = scan->pipeline->finerRegions();
  std::vector<Recorder> recorders;
  for (const auto& [table, of] :
       {std::pair(&scan->pipeline->regionTable(), static_cast<const FinerRegions*>(nullptr)),
        std::pair(&finer.table(), &finer)}) {
    Result<RegionSamples> known = scan->pipeline->sampleRegions(*table);
    if (!known) return fail(known.error());
    recorders.emplace_back(RegionJudge({}, std::move(*known)), *things, of);
  }
  const auto source = openSource(recording.string(), {});
  if (!source) return fail(source.error());
  for (FrameRead read = (*source)->next(); read.status == FrameRead::Status::frame;
       read = (*source)->next()) {
    const auto place = places.find(read.frame.index);
    if (place == places.end()) continue;
    ScanPipeline::SeenAgain seen = scan->pipeline->seeAgain(read.frame, place->second.T_world_camera);
    for (Recorder& recorder : recorders) {
      recorder.nextFrame(scene, place->second.truth);
      const bool are_parts = &recorder != &recorders.front();
      static_cast<void>(scan->pipeline->findAgain(seen, recorder,
                                                  are_parts ? finer.table() : scan->pipeline->regionTable()));
    }
  }
  std::fprintf(stderr, "%-18s %zu samples, %zu of parts\n", name.c_str(), recorders[0].samples.size(),
               recorders[1].samples.size());
  for (Recorder& recorder : recorders) std::ranges::move(recorder.samples, std::back_inserter(samples));
  return {};
}

Result<void> run(const SceneOptions& options) {
  auto compute = ComputeContext::create({});
  if (!compute) return fail(compute.error());
  const SceneCache cache(options.cache);
  std::vector<std::string> scenes = options.scenesOf("room");
  std::ranges::copy(options.scenesOf("tabletop"), std::back_inserter(scenes));
  if (scenes.size() < 2) return fail("One scene must be left out of the fit.", "Choose at least two.");
  std::vector<Sample> samples;
  for (std::size_t scene = 0; scene < scenes.size(); ++scene) {
    const auto recording = cache.recordingOf(scenes[scene]);
    if (!recording) return fail(recording.error());
    SCANTROVE_TRY(collect(scenes[scene], scene, *recording, options, **compute, samples));
  }
  std::fprintf(stderr, "%zu samples, %td whole\n", samples.size(),
               std::ranges::count(samples, true, &Sample::is_whole));
  reportOnOthers(samples);
  print(Boosting(samples), samples, options);
  return {};
}

}  // namespace
}  // namespace scantrove::benchmarks

int main(int argc, char** argv) {
  using namespace scantrove::benchmarks;
  SceneOptions options;
  options.every = 15;
  return withScenes(argc, argv, "Fits the trees that say what is one whole thing, on random scenes", options,
                    [&] { return run(options); });
}
