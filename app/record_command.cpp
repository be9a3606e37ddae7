#include <memory>

#include "app/command.h"
#include "app/progress_line.h"
#include "app/scan_options.h"
#include "app/stop_signal.h"
#include "app/text_check.h"
#include "core/exchange/recording_writer.h"
#include "core/scan/open_source.h"

namespace scantrove {
namespace {

struct RecordCommand {
  ScanOptions options;
  std::string out;
};

std::string describeFrames(int written, const SourceInfo& info) {
  const std::string so_far = std::to_string(written);
  return info.frame_count ? so_far + '/' + std::to_string(*info.frame_count) + " frames" : so_far + " frames";
}

Result<int> writeFrames(FrameSource& source, RecordingWriter& writer) {
  ProgressLine progress;
  listenForStop();
  setAtStop(AtStop::unfinished);  // frames are written atomically
  int written = 0;
  while (!stopRequested()) {
    const FrameRead read = source.next();
    if (read.status == FrameRead::Status::end) break;
    if (read.status == FrameRead::Status::failed) return fail(read.error);
    if (read.status == FrameRead::Status::skipped) progress.print(read.error.message());
    if (read.status != FrameRead::Status::frame) continue;
    SCANTROVE_TRY(writer.add(read.frame));
    ++written;
    progress.show([&] { return describeFrames(written, source.info()); });
  }
  return written;
}

Result<void> record(const RecordCommand& command, const SourceOptions& options) {
  const auto source = openSource(command.options.source, options);
  if (!source) return fail(source.error());
  auto writer = RecordingWriter::create(command.out, (*source)->info());
  if (!writer) return fail(writer.error());
  const auto written = writeFrames(**source, *writer);
  if (!written) return fail(written.error());
  if (*written == 0 && !stopRequested()) {
    return fail(command.options.source + " has no frame that can be recorded.",
                "Try it with 'scantrove scan'.");
  }
  std::cout << "frames   " << *written << "\nresults  " << inLine(command.out) << '\n';
  return {};
}

}  // namespace

void addRecordCommand(CLI::App& app, CommandJob& job) {
  auto command = std::make_shared<RecordCommand>();
  CLI::App* sub = app.add_subcommand(
      "record",
      "Store a source as a recording in 7-Scenes layout: frame-NNNNNN.{color.png, depth.png, pose.txt}.\n"
      "Random scenes (demo:room:SEED, demo:tabletop:SEED) include ground truth, frame-NNNNNN.instance.png");
  sub->add_option("SOURCE", command->options.source, kSourceHelp)->required()->check(notEmpty("SOURCE"));
  sub->add_option("--out", command->out, "folder for the recording; new or empty")
      ->required()
      ->type_name("DIR");
  command->options.addSourceTo(*sub);
  sub->callback([command, &job] {
    job = [command, options = command->options.toSourceOptions()] { return record(*command, options); };
  });
}

}  // namespace scantrove
