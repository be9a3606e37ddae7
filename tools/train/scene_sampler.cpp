#include "tools/train/scene_sampler.h"

#include <map>
#include <opencv2/imgproc.hpp>
#include <set>

#include "core/compute/guarded.h"
#include "core/discovery/objectness/objectness_features.h"
#include "core/discovery/region_judge.h"
#include "core/evaluation/overlap_metrics.h"
#include "core/labeling/border_features.h"
#include "core/labeling/graph_merger.h"
#include "core/labeling/region_partition.h"
#include "core/pipeline/mapping_pipeline.h"
#include "core/refinement/finer_regions.h"
#include "core/session/key_frame_choice.h"
#include "core/synthetic/synthetic_source.h"

namespace scantrove::train {
namespace {

constexpr int kBorderStep = 10, kObjectnessStep = 6;  // frames

/// True instances in images of `K`.
cv::Mat truthIn(const RgbdFrame& frame, const Intrinsics& K) {
  cv::Mat resized;
  cv::resize(frame.instances, resized, {K.width, K.height}, 0, 0, cv::INTER_NEAREST_EXACT);
  return resized;
}

/// True instance of each fragment that lies clearly in one; 0: none.
std::vector<int> instancesOf(const OverlapTable& table, std::size_t fragments) {
  constexpr int kMinPixels = 20;
  constexpr double kMinPurity = 0.7;
  std::vector<int> instances(fragments, 0);
  for (const auto& [pair, area] : table.intersection) {
    if (area >= kMinPixels && area >= kMinPurity * table.segment_area.at(pair.second))
      instances[static_cast<std::size_t>(pair.second - 1)] = pair.first;
  }
  return instances;
}

/// Borders between fragments in view.
void sampleBorders(const MappingPipeline& pipeline, const FrameResult& result, const cv::Mat& truth,
                   std::vector<BorderSample>& samples) {
  const EvidenceGraph& graph = dynamic_cast<const GraphMerger&>(pipeline.labels().merger()).graph();
  std::vector<FragmentId> fragments;
  std::map<FragmentId, std::size_t> index;
  cv::Mat1i labels(truth.size(), 0);
  auto label = labels.begin();
  for (const FragmentId fragment : result.view.fragments) {
    if (fragment) {
      const auto [entry, is_new] = index.try_emplace(fragment, fragments.size());
      if (is_new) fragments.push_back(fragment);
      *label = static_cast<int>(entry->second) + 1;
    }
    ++label;
  }
  const std::vector<int> instances =
      instancesOf(countOverlaps(labels, cv::Mat1i(truth), 1), fragments.size());
  const auto voxelsOf = [&](std::size_t i) {
    return pipeline.labels().voxelsOfFragments()[fragments[i].value];
  };
  for (std::size_t i = 0; i < fragments.size(); ++i) {
    if (instances[i] == 0 || voxelsOf(i) < kSmallFragmentVoxels) continue;
    for (const EvidenceGraph::Link& link : graph.linksOf(fragments[i])) {
      const auto other = index.find(link.other);
      if (other == index.end() || other->second <= i) continue;
      const std::size_t j = other->second;
      if (instances[j] == 0 || voxelsOf(j) < kSmallFragmentVoxels) continue;
      const auto x = valuesOf(kBorderFeatures, {graph.border(link.border), voxelsOf(i), voxelsOf(j)});
      samples.push_back({instances[i] == instances[j], {x.begin(), x.end()}});
    }
  }
}

/// Keeps the evidence that a judge has in a frame, beside what is true there.
class Recorder final : public CandidateSource {
 public:
  /// `parts_only`: sets that hold a part of a region.
  Recorder(RegionJudge judge, const std::set<int>& objects, const FinerRegions& finer, bool parts_only)
      : judge_(std::move(judge)), objects_(objects), finer_(finer), parts_only_(parts_only) {}

  void beginFrame(int frame, cv::Mat truth) {
    frame_ = frame;
    truth_ = std::move(truth);
  }
  std::vector<Candidate> find(const DiscoveryInput& input) override {
    std::map<int, int> visible;
    std::map<RegionId, std::map<int, int>> shared;
    const auto* instance = truth_.ptr<std::uint16_t>();
    for (const RegionId region : input.regions) {
      ++visible[*instance];
      ++shared[region][*instance++];
    }
    for (const auto& [hypothesis, evidence] : judge_.judge(input)) {
      if (parts_only_ && !finer_.holdsPart(hypothesis.regions)) continue;
      std::map<int, int> areas;
      int mask = 0;
      for (const RegionId region : hypothesis.regions) {
        for (const auto& [of, count] : shared[region]) {
          areas[of] += count;
          mask += count;
        }
      }
      ObjectnessSample sample;
      sample.frame = frame_;
      const auto x = valuesOf(kObjectnessFeatures, evidence);
      sample.x.assign(x.begin(), x.end());
      for (const RegionId region : parts_only_ ? hypothesis.regions : finer_.partsOf(hypothesis.regions))
        sample.regions.push_back(region.value);
      for (const auto& [of, count] : areas) {
        const float overlap = static_cast<float>(count) / static_cast<float>(mask + visible[of] - count);
        if (!objects_.contains(of) || overlap <= sample.overlap) continue;
        sample.object = of;
        sample.overlap = overlap;
      }
      samples.push_back(std::move(sample));
    }
    return {};
  }
  [[nodiscard]] const RegionCensus& census() const override { return judge_.census(); }

  std::vector<ObjectnessSample> samples;

 private:
  RegionJudge judge_;
  const std::set<int>& objects_;
  const FinerRegions& finer_;
  bool parts_only_;
  int frame_ = 0;
  cv::Mat truth_;
};

/// A frame of the scan and its camera.
struct Posed {
  RgbdFrame frame;
  Eigen::Isometry3d T_world_camera;
};

/// As the final pass does: closer segments first, then regions and their parts.
Result<void> sampleObjectness(MappingPipeline& pipeline, const std::vector<Posed>& frames,
                              const std::set<int>& objects, std::vector<ObjectnessSample>& samples) {
  for (const auto& [frame, T_world_camera] : frames) {
    const auto events = pipeline.segmentCloser(frame, T_world_camera);
    if (!events) return fail(events.error());
  }
  const MapLabels& labels = pipeline.labels();
  const FinerRegions finer(labels.table(), labels.merger(), labels.voxelsOfFragments(),
                           pipeline.params().labeling, [](RegionId) { return false; });
  std::vector<Recorder> recorders;
  for (const RegionTable* table : {&labels.table(), &finer.table()}) {
    Result<RegionSamples> known = pipeline.readout().sampleRegions(*table);
    if (!known) return fail(known.error());
    recorders.emplace_back(RegionJudge(pipeline.params().discovery, std::move(*known)), objects, finer,
                           table == &finer.table());
  }
  return guarded("sampling", [&]() -> Result<void> {
    for (const auto& [frame, T_world_camera] : frames) {
      FrameResult observed = pipeline.observe(frame, T_world_camera);
      for (Recorder& recorder : recorders) {
        recorder.beginFrame(frame.index, truthIn(frame, observed.view.K));
        const bool are_parts = &recorder != &recorders.front();
        pipeline.findCandidates(recorder, are_parts ? finer.table() : labels.table(), observed);
      }
    }
    for (Recorder& recorder : recorders) std::ranges::move(recorder.samples, std::back_inserter(samples));
    return {};
  });
}

}  // namespace

Result<SceneSamples> sampleScene(const std::string& scene, int frames, ComputeContext& compute) {
  SourceOptions options;
  options.frames = frames;
  const auto source = makeSyntheticSource(scene, options);
  if (!source) return fail(source.error());
  std::set<int> objects;
  for (const InstanceName& instance : (*source)->info().instances) {
    if (instance.is_object) objects.insert(instance.id);
  }
  const auto pipeline = MappingPipeline::create(compute, {(*source)->info().intrinsics, {}});
  if (!pipeline) return fail(pipeline.error());
  SceneSamples samples;
  KeyFrameChoice key_frames;
  std::vector<Posed> chosen;
  int count = 0;
  for (FrameRead read = (*source)->next(); read.status == FrameRead::Status::frame;
       read = (*source)->next()) {
    const auto result = (*pipeline)->processFrame(read.frame);
    if (!result) return fail(result.error());
    ++count;
    if (!result->pose.usable()) continue;
    const Eigen::Isometry3d& T_world_camera = result->pose.T_world_camera;
    if (count % kBorderStep == 0)
      sampleBorders(**pipeline, *result, truthIn(read.frame, (*pipeline)->workingIntrinsics()),
                    samples.borders);
    if (key_frames.takes(T_world_camera) || count % kObjectnessStep == 0)
      chosen.push_back({read.frame, T_world_camera});
  }
  SCANTROVE_TRY(sampleObjectness(**pipeline, chosen, objects, samples.objectness));
  return samples;
}

}  // namespace scantrove::train
