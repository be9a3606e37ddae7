#include <memory>

#include "app/catalogue_evaluation.h"
#include "app/command.h"
#include "app/image_evaluation.h"
#include "app/json_output.h"
#include "app/number_check.h"
#include "app/nyu2_command.h"
#include "app/recognition_evaluation.h"
#include "app/segmentation_evaluation.h"
#include "core/capture/trajectory_reader.h"
#include "core/evaluation/trajectory_metrics.h"

namespace scantrove {
namespace {

struct EvaluateCommand {
  std::string estimate;
  std::string truth;
  std::vector<std::string> scans, truths;
  std::string scan, database;
  int delta_frames = 1;
  bool with_estimated = false;
  SegmentationMetricOptions metrics;
  ImageEvaluation images;
  RecognitionEvaluation recognition;
  bool json = false;
};

Json toJson(const ErrorSummary& summary) {
  return {{"rmse", summary.rmse}, {"mean", summary.mean}, {"median", summary.median}, {"max", summary.max}};
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

/// Throws CLI::ValidationError.
void checkSegmentationArguments(const EvaluateCommand& command) {
  const std::size_t judged = command.scans.empty() ? 1 : command.scans.size();
  if (command.truths.size() != judged || command.estimate.empty() == command.scans.empty()) {
    throw CLI::ValidationError("segmentation",
                               "give --estimate DIR --truth DIR, or --scan DIR --truth DIR (each scan "
                               "with its truth)");
  }
  if (command.with_estimated && command.scans.empty())
    throw CLI::ValidationError("--with-estimated", "needs --scan");
}

Result<Json> evaluateSegmentations(const EvaluateCommand& command) {
  if (command.scans.empty())
    return evaluateEstimate(command.estimate, command.truths.front(), command.metrics);
  std::vector<JudgedScan> scans;
  for (std::size_t i = 0; i < command.scans.size(); ++i)
    scans.push_back({command.scans[i], command.truths[i], command.with_estimated});
  return evaluateScans(scans, command.metrics);
}

using ArgumentCheck = void (*)(const EvaluateCommand&);
using Evaluation = Result<Json> (*)(const EvaluateCommand&);

CLI::App* addEvaluation(CLI::App& parent, const char* name, const char* help,
                        const std::shared_ptr<EvaluateCommand>& command, CommandJob& job, Evaluation evaluate,
                        ArgumentCheck check = nullptr) {
  CLI::App* sub = parent.add_subcommand(name, help);
  sub->callback([command, &job, check, evaluate] {
    if (check != nullptr) check(*command);
    job = [command, evaluate]() -> Result<void> {
      const auto json = evaluate(*command);
      if (!json) return fail(json.error());
      std::cout << json->dump(1) << '\n';
      return {};
    };
  });
  return sub;
}

void addTrajectory(CLI::App& parent, const std::shared_ptr<EvaluateCommand>& command, CommandJob& job) {
  CLI::App* sub =
      addEvaluation(parent, "trajectory",
                    "ATE and RPE of a trajectory: a TUM file, a .log file, or the folder of a recording",
                    command, job, evaluateTrajectory);
  sub->add_option("--estimate", command->estimate, "estimated trajectory, such as that of a scan")
      ->required()
      ->type_name("PATH");
  sub->add_option("--truth", command->truth, "ground truth trajectory")->required()->type_name("PATH");
  sub->add_option("--delta", command->delta_frames, "frames between the two poses of a relative error")
      ->transform(wholeNumber(1))
      ->type_name("N");
}

CLI::Option* addFolders(CLI::App& command, const char* option, std::vector<std::string>& folders,
                        const char* help) {
  return command.add_option(option, folders, help)
      ->expected(1)
      ->allow_extra_args(false)
      ->multi_option_policy(CLI::MultiOptionPolicy::TakeAll)
      ->type_name("DIR");
}

void addSegmentation(CLI::App& parent, const std::shared_ptr<EvaluateCommand>& command, CommandJob& job) {
  CLI::App* sub = addEvaluation(
      parent, "segmentation",
      "Boundary error (eq. 4.1), boundary precision, recall and F, coverage of small and large instances.\n"
      "Pixels with truth 0 are not annotated and do not count in the boundary error.\n"
      "--scan evaluates segments/ (each frame alone), labels/ (merged up to that frame) and labels-final/ "
      "of\n"
      "a scan with --label-maps. over_frames lists the first 20 merged frames, as fig. 4.9 of the thesis:\n"
      "n is the number of frames merged so far, including that one; lost and skipped frames do not count.\n"
      "Both segmentations use the surface fused from the same n frames.\n"
      "A scan gives one image per n. Repeat --scan and --truth to average over several scans.\n"
      "average_precision judges the final regions as instances, without classes, by ScanNet's rules: mean\n"
      "over the thresholds 0.50 to 0.90 of intersection over union, at 0.50, and at 0.25. It counts points\n"
      "of the scan's cloud.ply. Its confidence is the objectness by the refinement, in labels.json; if a "
      "scan\n"
      "has none, larger regions rank first, and confidence says 'points'.\n"
      "Left out unless the scan has its cloud, and the truth is a recording with depth.",
      command, job, evaluateSegmentations, checkSegmentationArguments);
  sub->add_option("--estimate", command->estimate, "a folder of label PNGs")->type_name("DIR");
  addFolders(*sub, "--scan", command->scans, "results of a scan with --label-maps; may be repeated");
  addFolders(*sub, "--truth", command->truths,
             "folder of true labels, matched by frame number, or a recording with frame-NNNNNN.instance.png")
      ->required();
  sub->add_option("--tolerance", command->metrics.tolerance_px,
                  "tolerance of boundary precision and recall in pixels")
      ->check(atLeast(0))
      ->type_name("PX");
  sub->add_flag("--with-estimated", command->with_estimated,
                "count estimated surface in the average precision, where the depth image has no reading");
  sub->add_option("--min-instance", command->metrics.min_instance_px, "ignore smaller true instances")
      ->transform(wholeNumber(1))
      ->type_name("PX");
}

Result<Json> evaluateCatalogue(const EvaluateCommand& command) {
  return evaluateCatalogueOf(command.scan, command.truth, command.database);
}

void addCatalogue(CLI::App& parent, const std::shared_ptr<EvaluateCommand>& command, CommandJob& job) {
  CLI::App* sub = addEvaluation(
      parent, "catalogue",
      "Purity and completeness of the objects that a scan added to its catalogue, and a verdict for each.\n"
      "purity: share of the entries that are one complete object: in at least 80 % of the views, the mask\n"
      "and the object in its frame overlap by more than 0.6 (intersection over union).\n"
      "completeness: share of the true objects that have such an entry. Counts objects of 5 to 60 cm\n"
      "(longest side) that 30 frames or more show with at least 400 pixels at 640 x 480.\n"
      "completeness_of_entire: the same for objects that lie completely in the image in 30 frames or more.\n"
      "Verdicts: whole (one complete object), part (of one object), merger (of several objects),\n"
      "background (mostly background).\n"
      "Only views from the newest scan count.",
      command, job, evaluateCatalogue);
  sub->add_option("--scan", command->scan, "results of a scan")->required()->type_name("DIR");
  sub->add_option("--truth", command->truth,
                  "a recording with frame-NNNNNN.instance.png, and instances.json that says which instances "
                  "are objects")
      ->required()
      ->type_name("DIR");
  sub->add_option("--database", command->database, "the catalogue (default: catalogue.sqlite of the scan)")
      ->type_name("FILE");
}

void addImages(CLI::App& parent, const std::shared_ptr<EvaluateCommand>& command, CommandJob& job) {
  CLI::App* sub =
      addEvaluation(parent, "images",
                    "Coverage of the objects in single photographs with depth, each scanned alone.\n"
                    "The folder holds NAME-color.png (or .jpg), NAME-depth.png in mm, and NAME-label.png.\n"
                    "coverage: mean over the objects of the best intersection over union with a region.\n"
                    "over_half: share of the objects that one region covers by more than half.\n"
                    "Objects of more than 2500 pixels at 640 x 480 are large.",
                    command, job, [](const EvaluateCommand& all) { return evaluateImages(all.images); });
  sub->add_option("folder", command->images.folder, "the images")->required()->type_name("DIR");
  sub->add_option("--set", command->images.settings, "a parameter: KEY=VALUE; may be given several times")
      ->type_name("KEY=VALUE");
  sub->add_option("--device", command->images.device, "OpenCL device, by a part of its name")
      ->type_name("NAME");
  sub->add_option("--out", command->images.output, "folder for NAME-labels.png, created if missing")
      ->type_name("DIR");
}

void addRecognition(CLI::App& parent, const std::shared_ptr<EvaluateCommand>& command, CommandJob& job) {
  CLI::App* sub = parent.add_subcommand(
      "recognition",
      "Recognition of things in single photographs by the program's own detector.\n"
      "The folder holds NAME-color.png (or .jpg), NAME-depth.png in mm, NAME-label.png with labels\n"
      "100 * thing + instance, and label_mapping.csv with lines NUMBER,NAME (HOTS).\n"
      "Images whose names differ only in the last number show one scene. Each crop is compared with a few\n"
      "random views of each thing from other scenes, and once more without those of its own thing.\n"
      "A name is false if it is another thing's, or if the thing was not stored.");
  sub->add_option("folder", command->recognition.folder, "the images")->required()->type_name("DIR");
  sub->add_option("--views", command->recognition.views, "stored views of each thing")
      ->transform(wholeNumber(1))
      ->type_name("N");
  sub->add_flag("--each-image", command->recognition.each_image, "each image is a scene of its own");
  sub->add_option("--draws", command->recognition.draws, "random choices of these views")
      ->transform(wholeNumber(1))
      ->type_name("N");
  sub->add_option("--seed", command->recognition.seed, "of the random choices")
      ->transform(wholeNumber(0))
      ->type_name("N");
  sub->add_option("--set", command->recognition.settings,
                  "a parameter: KEY=VALUE; may be given several times")
      ->type_name("KEY=VALUE");
  sub->add_option("--device", command->recognition.device, "OpenCL device, by a part of its name")
      ->type_name("NAME");
  sub->add_flag("--json", command->json, "as JSON");
  sub->callback([command, &job] {
    job = [command]() -> Result<void> {
      const auto result = evaluateRecognition(command->recognition);
      if (!result) return fail(result.error());
      command->json ? printJson(*result) : printRecognition(*result);
      return {};
    };
  });
}

}  // namespace

void addEvaluateCommand(CLI::App& app, CommandJob& job) {
  auto command = std::make_shared<EvaluateCommand>();
  CLI::App* evaluate = app.add_subcommand("evaluate", "Measure results against ground truth (JSON)");
  evaluate->require_subcommand(1);
  addTrajectory(*evaluate, command, job);
  addSegmentation(*evaluate, command, job);
  addCatalogue(*evaluate, command, job);
  addImages(*evaluate, command, job);
  addRecognition(*evaluate, command, job);
  addEvaluateNyu2(*evaluate, job);
}

}  // namespace scantrove
