// Fits the trees of BorderEvidence::logOdds() to random scenes with exact truth. A sample is a border of the
// evidence graph in view at every 10th frame: its features, and whether the fragments to both sides are of
// one thing. Prints how well the trees do on scenes that they were not fitted to, border by border and by the
// regions that they make, more and less cautious; and core/labeling/border_trees.h.
//
//   border_evidence_fit --cache DIR --rooms 161-164,261:drab --tables 161-164,401:uneven > border_trees.h
#include "tests/benchmarks/boosting.h"
#include "tests/benchmarks/region_replay.h"

namespace scantrove::benchmarks {
namespace {

constexpr std::size_t kFolds = 4;
using Trees = BoostedTrees<4>;
using Features = std::array<float, BorderEvidence::kFeatures>;

/// That frames see both as one, and the colours that they share, speak for it, folds, unlike colours and
/// those that all have against, whatever few samples say.
const BoostingParams kBoosting{.trees = 120,
                               .learning_rate = 0.12,
                               .ridge = 5,
                               .least_samples = 150,
                               .part_of_features = 0.7,
                               .directions = {0, 1, 1, 0, -1, 0, -1, 0, 0, -1, -1, 0, 1, 0, -1, 0}};

/// A camera may have no colour: every so many samples are heard once more without it.
constexpr std::size_t kColorlessOf = 4;
/// Real walls, floors and cupboards share their colours more often than those of the scenes do, and things
/// do: so many of the borders between two, of a thousand, get the colours of one within a thing that is
/// plain.
constexpr unsigned kAlikeOfThousand = 50, kLargeAlikeOfThousand = 500;
constexpr float kLarge = 5000;             // voxels of the smaller of the two
constexpr float kPlain = 10;               // at most so much chroma is shared
constexpr std::size_t kFewerVoxels = 7;    // of the features
constexpr std::size_t kSharedChroma = 13;  // likewise
/// A segment may lie over two things for a while, and over each alone from then on, which scenes hardly show:
/// so many of the borders between two things, of a thousand, were shared in up to kMostLeaked of their looks.
constexpr unsigned kLeakedOfThousand = 600;
constexpr float kMostLeaked = 0.4F;
constexpr std::array<std::size_t, 2> kOfSegments{1, 2};  // shared and bridged parts

class Samples {
 public:
  void add(const Scene& scene) {
    const Features unseen = BorderEvidence{}.features(0, 0);
    for (const Moment& moment : scene) {
      for (const Border& border : moment.borders) {
        const bool are_slivers = std::min(moment.voxels[border.a], moment.voxels[border.b]) < kSliverVoxels;
        if (!border.are_one || are_slivers) continue;
        Features x = border.features;
        if (*border.are_one) {
          if (x[kSharedChroma] < kPlain) within_.push_back(features_.size());
        } else {
          makeHarder(x);
        }
        add(x, *border.are_one);
        if (features_.size() % kColorlessOf != 0) continue;
        for (const std::size_t feature : BorderEvidence::kOfColor) x[feature] = unseen[feature];
        add(x, *border.are_one);
      }
    }
  }
  [[nodiscard]] Trees fit() const {
    std::vector<BoostingSample> samples;
    for (std::size_t i = 0; i < features_.size(); ++i) samples.push_back({features_[i], are_one_[i], 1});
    return Boosting<4>(samples, kBoosting).fitted();
  }
  [[nodiscard]] std::size_t size() const { return features_.size(); }

 private:
  [[nodiscard]] bool happens(unsigned of_thousand) { return random_() % 1000 < of_thousand; }

  /// Of a border between two things.
  void makeHarder(Features& x) {
    const bool are_large = x[kFewerVoxels] > kLarge;
    if (!within_.empty() && happens(are_large ? kLargeAlikeOfThousand : kAlikeOfThousand)) {
      const Features& other = features_[within_[random_() % within_.size()]];
      for (const std::size_t feature : BorderEvidence::kOfColor) x[feature] = other[feature];
    }
    if (happens(kLeakedOfThousand)) {
      const float leaked = kMostLeaked * static_cast<float>(random_() % 1000) / 1000;
      for (const std::size_t feature : kOfSegments) x[feature] = std::max(x[feature], leaked);
    }
  }
  void add(const Features& features, bool are_one) {
    features_.push_back(features);
    are_one_.push_back(are_one);
  }
  std::vector<Features> features_;
  std::vector<bool> are_one_;
  std::vector<std::size_t> within_;  // of features_: one thing, and plain
  std::mt19937 random_;              // as it starts by default
};

/// Each scene judged by trees that are fitted to others.
void reportOnOthers(const std::vector<Scene>& scenes) {
  constexpr std::array kCautions{1.0F, 1.25F, 1.5F, 1.75F};
  std::array<Score, kCautions.size()> scores;
  std::vector<std::pair<float, bool>> judged;
  for (std::size_t fold = 0; fold < kFolds; ++fold) {
    Samples others;
    for (std::size_t i = 0; i < scenes.size(); ++i) {
      if (i % kFolds != fold) others.add(scenes[i]);
    }
    const Trees fitted = others.fit();
    for (std::size_t i = fold; i < scenes.size(); i += kFolds) {
      for (const Moment& moment : scenes[i]) {
        for (const Border& border : moment.borders) {
          if (border.are_one) judged.emplace_back(fitted.oddsOf(border.features), *border.are_one);
        }
      }
      for (std::size_t c = 0; c < kCautions.size(); ++c) {
        scores[c] += scoreOf(
            scenes[i], [&](const Border& border) { return fitted.oddsOf(border.features) - kCautions[c]; });
      }
    }
  }
  std::fprintf(stderr, "on scenes left out: area under the curve %.4f\n", areaUnderCurve(std::move(judged)));
  for (std::size_t c = 0; c < kCautions.size(); ++c)
    scores[c].print(fmt::format("caution {}", kCautions[c]).c_str());
}

Result<std::vector<Scene>> collect(const SceneOptions& options) {
  std::vector<Scene> scenes;
  const auto count = scanForEvidence(
      options, [&](std::size_t scene, const ScanPipeline& pipeline, const EvidenceGraph& graph,
                   const FrameResult& result, const cv::Mat& truth) {
        scenes.resize(scene + 1);
        scenes[scene].push_back(momentOf(pipeline, graph, result, truth));
      });
  if (!count) return fail(count.error());
  return scenes;
}

Result<void> run(const SceneOptions& options) {
  const auto scenes = collect(options);
  if (!scenes) return fail(scenes.error());
  if (scenes->size() < kFolds)
    return fail("Some scenes must be left out of the fit.", fmt::format("Choose at least {}.", kFolds));
  Samples all;
  for (const Scene& scene : *scenes) all.add(scene);
  std::fprintf(stderr, "%zu borders\n", all.size());
  reportOnOthers(*scenes);
  printTrees(all.fit(), "Border", "border_evidence_fit to " + options.text());
  return {};
}

}  // namespace
}  // namespace scantrove::benchmarks

int main(int argc, char** argv) {
  using namespace scantrove::benchmarks;
  SceneOptions options;
  options.every = 10;
  return withScenes(argc, argv, "Fits what borders between fragments say, on random scenes", options,
                    [&] { return run(options); });
}
