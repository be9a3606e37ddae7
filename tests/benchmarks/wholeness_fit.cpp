// Fits the trees of WholenessEvidence::logOdds() to random scenes with exact truth, as scans see them that
// have ended. Prints how well the trees do on scenes that they were not fitted to, and
// core/discovery/wholeness_trees_of_key_frames.h, or with --all wholeness_trees.h. With --samples what the
// scans gave is kept in a file, or read from it.
//
//   wholeness_fit --cache DIR --rooms 751-755,791-795 > wholeness_trees_of_key_frames.h
//   wholeness_fit --cache DIR --rooms 161-164,171-174 --every 6 --all > wholeness_trees.h
#include <cstdio>
#include <map>
#include <set>

#include "core/discovery/region_judge.h"
#include "core/scan/key_frame_choice.h"
#include "core/scan/rated_sets.h"
#include "tests/benchmarks/boosting.h"
#include "tests/benchmarks/scene_scan.h"
#include "tests/benchmarks/wholeness_sample.h"

namespace scantrove::benchmarks {
namespace {

constexpr std::size_t kFolds = 8;

struct FitOptions : SceneOptions {
  bool are_all = false;  ///< the frames that are looked at again; or key frames only, as when a scan ends
};

/// One of WholenessEvidence::features().
struct NamedFeature {
  std::size_t feature;
  const char* name;
};
/// What colour says: an image without is taken for what is usual.
constexpr std::array<NamedFeature, 8> kOfColor{{{14, "NeighbourLikeness"},
                                                {15, "TouchingLikeness"},
                                                {22, "EndToEndLikeness"},
                                                {23, "SideToSideLikeness"},
                                                {28, "ContrastAlong"},
                                                {29, "ContrastAcross"},
                                                {30, "LikenessAlong"},
                                                {31, "LikenessAcross"}}};

/// Keeps what a judge says of a frame, beside what is true there.
class Recorder final : public CandidateSource {
 public:
  enum class Regions { as_they_are, in_parts };
  /// Of `in_parts` only what holds a part of a region is kept.
  Recorder(RegionJudge judge, std::set<int> things, const FinerRegions& finer, Regions regions)
      : judge_(std::move(judge)), things_(std::move(things)), finer_(finer), regions_(regions) {}

  void nextFrame(std::size_t scene, int frame, cv::Mat truth) {
    scene_ = scene;
    frame_ = frame;
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
      if (regions_ == Regions::in_parts && !finer_.holdsPart(hypothesis.regions)) continue;
      int mask = 0;
      std::map<int, int> of;
      for (const RegionId region : hypothesis.regions) {
        mask += pixels[region];
        for (const auto& [instance, count] : shared[region]) of[instance] += count;
      }
      WholenessSample sample;
      sample.scene = scene_;
      sample.regions =
          regions_ == Regions::in_parts ? hypothesis.regions : finer_.partsOf(hypothesis.regions);
      sample.frame = frame_;
      sample.x = evidence.features();
      for (const auto& [instance, count] : of) {
        const float overlap =
            static_cast<float>(count) / static_cast<float>(mask + visible[instance] - count);
        if (!things_.contains(instance) || overlap <= sample.overlap) continue;
        sample.thing = instance;
        sample.overlap = overlap;
      }
      samples.push_back(std::move(sample));
    }
    return {};
  }
  [[nodiscard]] const RegionCensus& census() const override { return judge_.census(); }

  std::vector<WholenessSample> samples;

 private:
  RegionJudge judge_;
  std::set<int> things_;
  const FinerRegions& finer_;
  Regions regions_;
  std::size_t scene_ = 0;
  int frame_ = 0;
  cv::Mat truth_;
};

/// What a catalogue of scenes that the trees were not fitted to would hold: of the most likely sets that
/// share nothing, as ScanPipeline chooses them, those above a threshold.
class LeftOut {
 public:
  void add(const WeighedSample& sample, float odds) {
    const WholenessSample& of = *sample.sample;
    Candidate candidate;
    candidate.regions = of.regions;
    candidate.wholeness = odds;
    looks_[of.scene].add(of.frame, {&candidate, 1});
    if (sample.is_whole) things_[{of.scene, of.regions}] = of.thing;
  }
  void print() const {
    std::set<std::pair<std::size_t, int>> all;
    for (const auto& [set, thing] : things_) all.emplace(set.first, thing);
    for (int tenths = -8; tenths <= 12; ++tenths) {
      const float threshold = static_cast<float>(tenths) / 10;
      int chosen = 0, whole = 0;
      std::set<std::pair<std::size_t, int>> found;
      for (const auto& [scene, looks] : looks_) {
        for (const RatedSets::Rated& rated : looks.disjoint(threshold)) {
          ++chosen;
          const auto thing = things_.find({scene, rated.regions});
          if (thing == things_.end()) continue;
          ++whole;
          found.emplace(scene, thing->second);
        }
      }
      std::fprintf(stderr,
                   "from %4.1f: %d chosen, %.3f of them whole; %zu of the %zu things that are regions\n",
                   static_cast<double>(threshold), chosen, whole / std::max(1.0, static_cast<double>(chosen)),
                   found.size(), all.size());
    }
  }

 private:
  std::map<std::size_t, RatedSets> looks_;
  std::map<std::pair<std::size_t, RegionSet>, int> things_;
};

constexpr BoostingParams kBoosting{
    .trees = 300, .learning_rate = 0.07, .ridge = 20, .least_samples = 120, .part_of_features = 0.4};

BoostedTrees<5> fitTrees(const std::vector<WeighedSample>& samples) {
  std::vector<BoostingSample> all;
  for (const auto& [sample, is_whole, weight] : samples) all.push_back({sample->x, is_whole, weight});
  return Boosting<5>(all, kBoosting).fitted();
}

/// Samples judged by trees that are fitted to other scenes.
void reportOnOthers(const std::vector<WeighedSample>& samples) {
  std::vector<std::pair<float, bool>> judged;
  LeftOut left_out;
  for (std::size_t fold = 0; fold < kFolds; ++fold) {
    std::vector<WeighedSample> others;
    std::ranges::copy_if(samples, std::back_inserter(others),
                         [&](const WeighedSample& sample) { return sample.sample->scene % kFolds != fold; });
    const BoostedTrees<5> fitted = fitTrees(others);
    for (const WeighedSample& sample : samples) {
      if (sample.sample->scene % kFolds != fold) continue;
      const float odds = fitted.oddsOf(sample.sample->x);
      judged.emplace_back(odds, sample.is_whole);
      left_out.add(sample, odds);
    }
  }
  std::fprintf(stderr, "on scenes left out: area under the curve %.3f\n", areaUnderCurve(std::move(judged)));
  left_out.print();
}

float medianOf(std::size_t feature, const std::vector<WholenessSample>& samples) {
  std::vector<float> values;
  for (const WholenessSample& sample : samples) values.push_back(sample.x[feature]);
  const auto middle = values.begin() + static_cast<std::ptrdiff_t>(values.size() / 2);
  std::ranges::nth_element(values, middle);
  return *middle;
}

void print(const BoostedTrees<5>& fitted, const std::vector<WholenessSample>& samples,
           const FitOptions& options) {
  if (!options.are_all)
    return printTrees(fitted, "WholenessOfKeyFrames", "wholeness_fit to key frames of " + options.text());
  std::string usual = "// Medians, for what has no colour.\n";
  for (const auto& [feature, name] : kOfColor)
    usual += fmt::format("inline constexpr float kUsual{} = {};\n", name, inCpp(medianOf(feature, samples)));
  printTrees(fitted, "Wholeness",
             fmt::format("wholeness_fit to every {}th frame of {}", options.every, options.text()), usual);
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

/// Scans the scene, then looks at it again from key frames of the scan, or from all that are asked for.
Result<void> collect(const std::string& name, std::size_t scene, const std::filesystem::path& recording,
                     const FitOptions& options, ComputeContext& compute,
                     std::vector<WholenessSample>& samples) {
  const Result<std::set<int>> things = thingsOf(name);
  if (!things) return fail(things.error());
  ScanParams params;
  for (const std::string& setting : options.settings) SCANTROVE_TRY(applySetting(params, setting));
  KeyFrameChoice key_frames;
  std::map<int, Eigen::Isometry3d> cameras;  // by RgbdFrame::index
  const auto scan =
      scanScene(recording, params, options, compute,
                [&](const ScanPipeline&, const RgbdFrame& frame, const FrameResult& result, const cv::Mat&) {
                  const Eigen::Isometry3d& T_world_camera = result.pose.T_world_camera;
                  if (options.are_all || key_frames.takes(T_world_camera))
                    cameras[frame.index] = T_world_camera;
                });
  if (!scan) return fail(scan.error());
  /// Calls `visit` with each frame that has a camera, and the camera.
  const auto lookAgain = [&](const auto& visit) -> Result<void> {
    const auto source = openSource(recording.string(), {});
    if (!source) return fail(source.error());
    for (FrameRead read = (*source)->next(); read.status == FrameRead::Status::frame;
         read = (*source)->next()) {
      const auto camera = cameras.find(read.frame.index);
      if (camera != cameras.end()) SCANTROVE_TRY(visit(read.frame, camera->second));
    }
    return {};
  };
  SCANTROVE_TRY(lookAgain([&](const RgbdFrame& frame, const Eigen::Isometry3d& T_world_camera) {
    return scan->pipeline->segmentCloser(frame, T_world_camera);
  }));
  const FinerRegions finer = scan->pipeline->finerRegions();
  std::vector<Recorder> recorders;
  for (const auto& [table, regions] :
       {std::pair(&scan->pipeline->regionTable(), Recorder::Regions::as_they_are),
        std::pair(&finer.table(), Recorder::Regions::in_parts)}) {
    Result<RegionSamples> known = scan->pipeline->sampleRegions(*table);
    if (!known) return fail(known.error());
    recorders.emplace_back(RegionJudge({}, std::move(*known)), *things, finer, regions);
  }
  SCANTROVE_TRY(
      lookAgain([&](const RgbdFrame& frame, const Eigen::Isometry3d& T_world_camera) -> Result<void> {
        ScanPipeline::SeenAgain seen = scan->pipeline->seeAgain(frame, T_world_camera);
        const Result<cv::Mat> truth = truthAt(recording, frame.index);
        if (!truth) return fail(truth.error());
        const cv::Mat seen_truth = truthIn(*truth, seen.K);
        for (Recorder& recorder : recorders) {
          recorder.nextFrame(scene, frame.index, seen_truth);
          const bool are_parts = &recorder != &recorders.front();
          static_cast<void>(scan->pipeline->findAgain(
              seen, recorder, are_parts ? finer.table() : scan->pipeline->regionTable()));
        }
        return {};
      }));
  std::fprintf(stderr, "%-18s %zu samples, %zu of parts\n", name.c_str(), recorders[0].samples.size(),
               recorders[1].samples.size());
  for (Recorder& recorder : recorders) std::ranges::move(recorder.samples, std::back_inserter(samples));
  return {};
}

Result<std::vector<WholenessSample>> scanAll(const FitOptions& options) {
  auto compute = ComputeContext::create({});
  if (!compute) return fail(compute.error());
  const SceneCache cache(options.cache);
  std::vector<std::string> scenes = options.scenesOf("room");
  std::ranges::copy(options.scenesOf("tabletop"), std::back_inserter(scenes));
  if (scenes.size() < 2) return fail("One scene must be left out of the fit.", "Choose at least two.");
  std::vector<WholenessSample> samples;
  for (std::size_t scene = 0; scene < scenes.size(); ++scene) {
    const auto recording = cache.recordingOf(scenes[scene]);
    if (!recording) return fail(recording.error());
    SCANTROVE_TRY(collect(scenes[scene], scene, *recording, options, **compute, samples));
  }
  return samples;
}

/// `file`: of the samples; empty: none.
Result<void> run(const FitOptions& options, const std::string& file) {
  const bool are_kept = !file.empty() && std::filesystem::exists(file);
  const auto samples = are_kept ? readSamples(file) : scanAll(options);
  if (!samples) return fail(samples.error());
  if (!are_kept && !file.empty()) SCANTROVE_TRY(writeSamples(file, *samples));
  const std::vector<WeighedSample> weighed = weigh(*samples);
  std::fprintf(stderr, "%zu samples, %td of what is whole\n", weighed.size(),
               std::ranges::count(weighed, true, &WeighedSample::is_whole));
  reportOnOthers(weighed);
  print(fitTrees(weighed), *samples, options);
  return {};
}

}  // namespace
}  // namespace scantrove::benchmarks

int main(int argc, char** argv) {
  using namespace scantrove::benchmarks;
  FitOptions options;
  options.every = 1;
  std::string samples;
  return withScenes(
      argc, argv, "Fits the trees that say what is one whole thing, on random scenes", options,
      [&] { return run(options, samples); },
      [&](CLI::App& app) {
        app.add_option("--samples", samples, "keep what the scans gave there, or read it");
        app.add_flag("--all", options.are_all, "look at all these frames again, not at key frames only");
      });
}
