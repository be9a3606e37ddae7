#include <memory>
#include <nlohmann/json.hpp>

#include "app/command.h"
#include "app/label_image_pairs.h"
#include "app/number_check.h"
#include "core/capture/trajectory_reader.h"
#include "core/evaluation/trajectory_metrics.h"

namespace scantrove {
namespace {

using Json = nlohmann::ordered_json;

struct EvaluateCommand {
  std::string estimate;
  std::string truth;
  int delta_frames = 1;
  SegmentationMetricOptions metrics;
};

Json toJson(const ErrorSummary& summary) {
  return {{"rmse", summary.rmse}, {"mean", summary.mean}, {"median", summary.median}, {"max", summary.max}};
}

Json toJson(const SegmentationMetrics& metrics) {
  return {{"boundary_error", metrics.boundary_error},
          {"boundary_precision", metrics.boundary_precision},
          {"boundary_recall", metrics.boundary_recall},
          {"boundary_f", metrics.boundary_f},
          {"coverage_weighted", metrics.coverage_weighted},
          {"coverage", metrics.coverage},
          {"instances", metrics.instances},
          {"over_segmented", metrics.over_segmented},
          {"under_segmented", metrics.under_segmented}};
}

Result<Json> evaluateTrajectory(const EvaluateCommand& command) {
  const auto estimate = readTrajectory(command.estimate);
  if (!estimate) return fail(estimate.error());
  const auto truth = readTrajectory(command.truth);
  if (!truth) return fail(truth.error());
  const auto pairs = associate(*estimate, *truth);
  if (pairs.size() < 2) {
    return fail("Only " + std::to_string(pairs.size()) + " poses of " + command.estimate + " and " +
                    command.truth + " lie within 0.02 s of each other.",
                "Check that both use the same clock.");
  }
  const RelativePoseError rpe = relativePoseError(pairs, command.delta_frames);
  return Json{
      {"poses", {{"estimate", estimate->size()}, {"truth", truth->size()}, {"matched", pairs.size()}}},
      {"ate_m", toJson(absoluteTrajectoryError(pairs))},
      {"rpe_delta_frames", command.delta_frames},
      {"rpe_m", toJson(rpe.translation_m)},
      {"rpe_deg", toJson(rpe.rotation_deg)}};
}

Result<Json> evaluateSegmentations(const EvaluateCommand& command) {
  const auto pairs = pairLabelImages(command.estimate, command.truth);
  if (!pairs) return fail(pairs.error());
  std::vector<SegmentationMetrics> all;
  Json images = Json::array();
  for (const LabelImagePair& pair : *pairs) {
    const auto metrics = evaluatePair(pair, command.metrics);
    if (!metrics) return fail(metrics.error());
    all.push_back(*metrics);
    Json image = {{"image", pair.estimate.filename().string()}};
    image.update(toJson(*metrics));
    images.push_back(std::move(image));
  }
  return Json{{"images", all.size()}, {"mean", toJson(averaged(all))}, {"each", images}};
}

using Evaluation = Result<Json> (*)(const EvaluateCommand&);

CLI::App* addEvaluation(CLI::App& parent, const char* name, const char* help,
                        const std::shared_ptr<EvaluateCommand>& command, CommandOutcome& outcome,
                        Evaluation evaluate) {
  CLI::App* sub = parent.add_subcommand(name, help);
  sub->add_option("--estimate", command->estimate, "what a scan wrote")->required()->type_name("PATH");
  sub->add_option("--truth", command->truth, "what is right")->required()->type_name("PATH");
  sub->callback([command, &outcome, evaluate] {
    const auto json = evaluate(*command);
    if (!json) return outcome.failWith(json.error());
    std::cout << json->dump(1) << '\n';
  });
  return sub;
}

}  // namespace

void addEvaluateCommand(CLI::App& app, CommandOutcome& outcome) {
  auto command = std::make_shared<EvaluateCommand>();
  CLI::App* evaluate = app.add_subcommand("evaluate", "Measure results against ground truth (JSON)");
  evaluate->require_subcommand(1);
  addEvaluation(*evaluate, "trajectory",
                "ATE and RPE of a trajectory: a TUM file, a .log, or a recording's folder", command, outcome,
                evaluateTrajectory)
      ->add_option("--delta", command->delta_frames, "frames between the poses of the relative error")
      ->transform(wholeNumber(1))
      ->type_name("N");
  CLI::App* segmentation = addEvaluation(
      *evaluate, "segmentation", "Boundary error (eq. 4.1), boundary F, coverage of folders of label PNGs",
      command, outcome, evaluateSegmentations);
  segmentation
      ->add_option("--tolerance", command->metrics.tolerance_px, "of boundary precision and recall, pixels")
      ->check(atLeast(0))
      ->type_name("PX");
  segmentation
      ->add_option("--min-instance", command->metrics.min_instance_px, "leave out smaller true instances")
      ->transform(wholeNumber(1))
      ->type_name("PX");
}

}  // namespace scantrove
