// Searches coefficients of BorderEvidence::logOdds() by the regions that they make, where border_evidence_fit
// asks only how often they are right: a wrong join of a small thing costs more than many borders of a wall.
// Scans random scenes with exact truth, keeps the evidence of every 5th frame, and makes its partition again
// under other coefficients, each tried beside the best so far. Every other scene is left out of the search
// and shows what the result is worth elsewhere.
//
//   border_model_search --cache DIR --rooms 111-114,121-124 --tables 111-114,121-124 [--steps 2000] [--all]
#include <cmath>
#include <cstdio>
#include <map>
#include <random>

#include "core/evaluation/overlap_metrics.h"
#include "core/labeling/greedy_contraction.h"
#include "core/labeling/region_partition.h"
#include "tests/benchmarks/scene_scan.h"

namespace scantrove::benchmarks {
namespace {

using Coefficients = std::array<float, BorderEvidence::kFeatures>;

/// Added to the coefficients of border_evidence.cpp.
struct Change {
  float intercept = 0;
  Coefficients coefficients{};
};

struct Border {
  std::uint32_t a = 0, b = 0;  ///< indices of the moment's fragments
  BorderEvidence evidence;
  Coefficients features{};
};

/// What a frame showed, and what was known of it.
struct Moment {
  std::vector<FragmentId> fragments;
  std::vector<int> voxels;
  std::vector<Border> borders;
  OverlapTable table;  ///< of fragments, by index + 1, with instances
  double scale = 1;    ///< pixels to those of 640x480
};
using Scene = std::vector<Moment>;

Moment momentOf(const ScanPipeline& pipeline, const EvidenceGraph& graph, const FrameResult& result,
                const cv::Mat& truth) {
  Moment moment;
  moment.scale = static_cast<double>(truth.total()) / (640.0 * 480.0);
  std::map<FragmentId, std::uint32_t> index;
  const auto indexOf = [&](FragmentId fragment) {
    const auto [entry, is_new] = index.try_emplace(fragment, static_cast<std::uint32_t>(index.size()));
    if (is_new) {
      moment.fragments.push_back(fragment);
      moment.voxels.push_back(pipeline.voxelsOfFragments()[fragment.value]);
    }
    return entry->second;
  };
  cv::Mat1i labels(truth.size(), 0);
  auto label = labels.begin();
  for (const FragmentId fragment : result.regions.fragments) {
    if (fragment) *label = static_cast<int>(indexOf(fragment)) + 1;
    ++label;
  }
  moment.table = countOverlaps(labels, cv::Mat1i(truth), 1);
  const std::size_t in_view = moment.fragments.size();
  for (std::size_t i = 0; i < in_view; ++i) {
    const FragmentId fragment = moment.fragments[i];
    for (const EvidenceGraph::Link& link : graph.linksOf(fragment)) {
      const auto known = index.find(link.other);
      if (known != index.end() && known->second < i) continue;  // is there
      Border border{static_cast<std::uint32_t>(i), indexOf(link.other), graph.border(link.border), {}};
      border.features = border.evidence.features(moment.voxels[border.a], moment.voxels[border.b]);
      moment.borders.push_back(std::move(border));
    }
  }
  return moment;
}

/// Part of each fragment, one frame after the other. Persons and slivers' neighbours are left out of it.
class Replay {
 public:
  explicit Replay(const Change& change) : change_(change) {}

  [[nodiscard]] std::vector<std::uint32_t> partsOf(const Moment& moment) {
    std::vector<WeightedEdge> edges;
    for (const Border& border : moment.borders) {
      const int voxels_a = moment.voxels[border.a], voxels_b = moment.voxels[border.b];
      if (std::min(voxels_a, voxels_b) < kSliverVoxels) continue;
      const bool are_one = wereOne(moment.fragments[border.a], moment.fragments[border.b]);
      const float bias = are_one ? kHysteresis : -kHysteresis;
      edges.push_back(
          {border.a, border.b, border.evidence.weight(voxels_a, voxels_b, bias + changeOf(border), are_one)});
    }
    std::vector<std::uint32_t> parts = contractGreedily(moment.fragments.size(), edges);
    for (std::size_t i = 0; i < parts.size(); ++i) before_[moment.fragments[i]] = {moment_, parts[i]};
    ++moment_;
    return parts;
  }

 private:
  static constexpr float kHysteresis = 0.5F;

  [[nodiscard]] float changeOf(const Border& border) const {
    float sum = change_.intercept;
    for (std::size_t i = 0; i < border.features.size(); ++i) {
      sum += change_.coefficients[i] * border.features[i];
    }
    return sum;
  }
  [[nodiscard]] bool wereOne(FragmentId a, FragmentId b) const {
    const auto part_a = before_.find(a), part_b = before_.find(b);
    return part_a != before_.end() && part_b != before_.end() && part_a->second == part_b->second;
  }

  const Change& change_;
  std::map<FragmentId, std::pair<int, std::uint32_t>> before_;  // moment, part
  int moment_ = 0;
};

/// Sums over frames, then means.
struct Score {
  double small = 0, small_over_half = 0, large = 0, large_over_half = 0;
  double frames = 0, coverage = 0;
  double pieces = 0;  ///< parts in view that are mostly something else than any one instance

  void add(const Moment& moment, const std::vector<std::uint32_t>& parts) {
    constexpr double kSmall_px = 400, kLarge_px = 15000, kLeast_px = 400;
    OverlapTable table;
    table.instance_area = moment.table.instance_area;
    for (const auto& [fragment, area] : moment.table.segment_area)
      table.segment_area[partAt(parts, fragment)] += area;
    for (const auto& [pair, area] : moment.table.intersection)
      table.intersection[{pair.first, partAt(parts, pair.second)}] += area;
    const SizedCoverage of_small = coverageOfSize(table, kSmall_px * moment.scale, kLarge_px * moment.scale);
    const SizedCoverage of_large = coverageOfSize(table, kLarge_px * moment.scale, HUGE_VAL);
    small += of_small.instances;
    small_over_half += of_small.over_half * of_small.instances;
    large += of_large.instances;
    large_over_half += of_large.over_half * of_large.instances;
    coverage += scantrove::coverage(table).weighted;
    frames += 1;
    std::map<int, double> best;
    for (const auto& [pair, area] : table.intersection) {
      const int all = table.instance_area.at(pair.first) + table.segment_area.at(pair.second) - area;
      best[pair.second] = std::max(best[pair.second], static_cast<double>(area) / all);
    }
    for (const auto& [part, iou] : best) {
      if (iou < 0.5 && table.segment_area.at(part) >= kLeast_px * moment.scale) pieces += 1;
    }
  }
  void operator+=(const Score& other) {
    small += other.small;
    small_over_half += other.small_over_half;
    large += other.large;
    large_over_half += other.large_over_half;
    frames += other.frames;
    coverage += other.coverage;
    pieces += other.pieces;
  }
  /// What is sought. One piece less a frame is worth 0.4 % of the small things.
  [[nodiscard]] double worth() const {
    return 1.6 * small_over_half / small + 0.4 * large_over_half / large + 0.4 * coverage / frames -
           0.006 * pieces / frames;
  }
  void print(const char* name) const {
    std::printf("%-22s small over half %.4f, large %.4f, coverage %.4f, pieces a frame %.2f; worth %.4f\n",
                name, small_over_half / small, large_over_half / large, coverage / frames, pieces / frames,
                worth());
    std::fflush(stdout);
  }

 private:
  static int partAt(const std::vector<std::uint32_t>& parts, int fragment) {
    return static_cast<int>(parts[static_cast<std::size_t>(fragment - 1)]) + 1;
  }
};

Score scoreOf(const std::vector<const Scene*>& scenes, const Change& change) {
  std::vector<Score> scores(scenes.size());
  cv::parallel_for_({0, static_cast<int>(scenes.size())}, [&](const cv::Range& range) {
    for (int i = range.start; i < range.end; ++i) {
      Replay replay(change);
      for (const Moment& moment : *scenes[static_cast<std::size_t>(i)])
        scores[static_cast<std::size_t>(i)].add(moment, replay.partsOf(moment));
    }
  });
  Score sum;
  for (const Score& score : scores) sum += score;
  return sum;
}

/// 20 looks at a border of half a metre, straight on, each with so much of it bridged, and folded.
BorderEvidence seen(float bridged, float folded) {
  FragmentContact contact;
  contact.length_px = contact.bends = 100;
  contact.bridged_px = static_cast<int>(std::lround(100 * bridged));
  contact.length_m = 0.5F;
  contact.color_shift = 5;
  contact.folded = folded;
  BorderEvidence evidence;
  for (int look = 0; look < 30; ++look) evidence.add(contact, bridged);
  return evidence;
}

float oddsOf(const BorderEvidence& evidence, int voxels, const Change& change) {
  const Coefficients features = evidence.features(voxels, voxels);
  float odds = evidence.logOdds(voxels, voxels) + change.intercept;
  for (std::size_t i = 0; i < features.size(); ++i) odds += change.coefficients[i] * features[i];
  return odds;
}

/// Whether frames and folds are heard as now, and what is large and folded stays apart. In these scenes
/// colour and size say nearly all, and a search that may do what it likes forgets the rest; real things are
/// less colourful: a leak must heal, and the floor is no part of a cupboard.
bool isSensible(const Change& change) {
  constexpr float kAtLeast = 0.9F;  // of the differences of the odds as they are
  constexpr float kHigher = 0.3F;   // at most, of the odds that a fold between large ones is none
  constexpr int kThing = 3000, kFurniture = 30000;  // voxels
  const auto frames = [](const Change& c) {
    return oddsOf(seen(1, 0), kThing, c) - oddsOf(seen(0, 0), kThing, c);
  };
  const auto fold = [](const Change& c) {
    return oddsOf(seen(0.5F, 0), kThing, c) - oddsOf(seen(0.5F, 1), kThing, c);
  };
  const auto large = [](const Change& c) { return oddsOf(seen(0, 1), kFurniture, c); };
  return frames(change) >= kAtLeast * frames({}) && fold(change) >= kAtLeast * fold({}) &&
         large(change) <= large({}) + kHigher;
}

/// Steps of random size in random directions, each kept if it is sensible and worth more.
Change search(const std::vector<const Scene*>& scenes, int steps) {
  constexpr double kLeastStep = 0.05, kMostStep = 0.5;
  std::mt19937 random(1);
  std::normal_distribution<double> normal;
  Change best;
  double worth = scoreOf(scenes, best).worth();
  double step = 0.3;
  for (int i = 0; i < steps; ++i) {
    Change next = best;
    if (random() % 2 == 0) next.intercept += static_cast<float>(step * normal(random));
    for (float& coefficient : next.coefficients) {
      if (random() % 3 == 0) coefficient += static_cast<float>(0.5 * step * normal(random));
    }
    const double other = isSensible(next) ? scoreOf(scenes, next).worth() : -HUGE_VAL;
    if (other > worth) {
      worth = other;
      best = next;
      step = std::min(kMostStep, step * 1.3);
    } else {
      step = std::max(kLeastStep, step * 0.98);
    }
  }
  return best;
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

Result<void> run(const SceneOptions& options, int steps, bool all) {
  const auto scenes = collect(options);
  if (!scenes) return fail(scenes.error());
  std::vector<const Scene*> searched, left_out;
  for (std::size_t i = 0; i < scenes->size(); ++i)
    (all || i % 2 == 0 ? searched : left_out).push_back(&(*scenes)[i]);
  const Change change = search(searched, steps);
  scoreOf(searched, {}).print("searched, as it is");
  scoreOf(searched, change).print("searched, changed");
  if (!left_out.empty()) {
    scoreOf(left_out, {}).print("left out, as it is");
    scoreOf(left_out, change).print("left out, changed");
  }
  std::printf("\nto be added to the model:\n{%.2fF, {", static_cast<double>(change.intercept));
  for (std::size_t i = 0; i < change.coefficients.size(); ++i)
    std::printf("%s%.2fF", i == 0 ? "" : ", ", static_cast<double>(change.coefficients[i]));
  std::printf("}}\n");
  return {};
}

}  // namespace
}  // namespace scantrove::benchmarks

int main(int argc, char** argv) {
  using namespace scantrove::benchmarks;
  SceneOptions options;
  int steps = 2000;
  bool all = false;
  return withScenes(
      argc, argv, "Searches what borders between fragments say by the regions that it makes", options,
      [&] { return run(options, steps, all); },
      [&](CLI::App& app) {
        app.add_option("--steps", steps, "of the search")->check(CLI::PositiveNumber);
        app.add_flag("--all", all, "search on all scenes, leave none out");
      });
}
