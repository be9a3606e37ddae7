#include "app/nyu2_command.h"

#include <memory>

#include "app/json_output.h"
#include "app/number_check.h"
#include "app/nyu2_evaluation.h"

namespace scantrove {
namespace {

struct Nyu2Command {
  Nyu2Evaluation request;
  bool json = false;
};

Json toJson(const Nyu2Error& error) { return {{"all", error.all}, {"annotated", error.annotated}}; }

Json toJson(const Nyu2Report& report) {
  Json curve = Json::array();
  for (const Nyu2Point& point : report.curve) {
    curve.push_back({{"n", point.frames},
                     {"images", point.images},
                     {"lost", point.lost},
                     {"single", toJson(point.single)},
                     {"merged", toJson(point.merged)}});
  }
  return {{"labelled_images", report.labeled_images},
          {"without_scene", report.without_scene},
          {"unusable", report.unusable},
          {"complete", report.is_complete},
          {"over_frames", std::move(curve)}};
}

void print(const Nyu2Report& report) {
  std::cout << nyu2Table(report.curve) << "\nimages " << report.curve.front().images << " of "
            << report.labeled_images;
  if (report.without_scene > 0) std::cout << ", " << report.without_scene << " without raw scene";
  if (report.unusable > 0) std::cout << ", " << report.unusable << " unusable";
  if (!report.is_complete) std::cout << ", stopped";
  std::cout << "\n\n" << nyu2Csv(report.curve);
}

Result<void> run(const Nyu2Command& command) {
  const auto report = evaluateNyu2(command.request);
  if (!report) return fail(report.error());
  if (!report->is_complete && !command.request.output.empty())
    std::cerr << "scantrove: Stopped. The same command continues where it ended.\n";
  if (command.json) {
    printJson(toJson(*report));
  } else {
    print(*report);
  }
  return {};
}

}  // namespace

void addEvaluateNyu2(CLI::App& parent, CommandJob& job) {
  auto command = std::make_shared<Nyu2Command>();
  CLI::App* sub = parent.add_subcommand(
      "nyu2",
      "The benchmark of the thesis: table 4.1 and the curve of figure 4.9 on NYU Depth v2.\n"
      "For each labelled image and each n, scans the n frames of its video that end with it, and compares\n"
      "the segmentation of the last one with its labels and instances by error 4.1 (mean over all pixels).\n"
      "n = 1 is the labelled frame alone. single: segments of the last frame, on the surface fused from n\n"
      "frames; merged: regions merged over the n frames. Table 4.1 compares single at n = 1 with merged at\n"
      "n = 8. lost: images whose last frame tracking lost; the result of n = 1 counts for them.\n"
      "Prints table and CSV. With --out, also writes them with a picture of the curve, and keeps results:\n"
      "the same command continues an interrupted run.\n"
      "All 1449 images are 304,000 frames, which takes hours; --frames and --every make it shorter.");
  Nyu2Evaluation& request = command->request;
  sub->add_option("--raw", request.raw,
                  "folder with the scenes of the raw data set, or with its parts (d-*.pgm, r-*.ppm)")
      ->required()
      ->type_name("DIR");
  sub->add_option("--labelled,--labeled", request.labeled, "nyu_depth_v2_labeled.mat")
      ->required()
      ->type_name("FILE");
  sub->add_option("--out", request.output, "folder for results; new, or that of an earlier run")
      ->type_name("DIR");
  sub->add_option("--frames", request.frames,
                  "numbers n of frames, such as 1,4,8,20 (default: 1 to 20); 1 and 8 are always included")
      ->delimiter(',')
      ->expected(1)
      ->allow_extra_args(false)
      ->multi_option_policy(CLI::MultiOptionPolicy::TakeAll)
      ->transform(wholeNumber(1))
      ->check(CLI::Range(1, kNyu2MostFrames))
      ->type_name("N,...");
  sub->add_option("--every", request.every, "use every N-th labelled image")
      ->transform(wholeNumber(1))
      ->type_name("N");
  sub->add_option("--set", request.settings, "a parameter; may be given several times")
      ->expected(1)
      ->multi_option_policy(CLI::MultiOptionPolicy::TakeAll)
      ->allow_extra_args(false)
      ->type_name("KEY=VALUE");
  sub->add_option("--device", request.device, "OpenCL device; 'scantrove devices' lists them")
      ->type_name("INDEX|NAME");
  sub->add_flag("--json", command->json, "as JSON");
  sub->callback([command, &job] { job = [command] { return run(*command); }; });
}

}  // namespace scantrove
