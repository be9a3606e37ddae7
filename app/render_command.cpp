#include <charconv>
#include <memory>
#include <stop_token>
#include <string>

#include "app/command.h"
#include "app/core_application.h"
#include "app/kernel_cache_use.h"
#include "app/number_check.h"
#include "app/progress_line.h"
#include "app/stop_signal.h"
#include "core/base/text.h"
#include "core/picture/render_file.h"
#include "core/session/session_scan.h"

namespace scantrove {
namespace {

struct RenderCommand {
  std::string folder, out, colors = "rgb", size, from, device;
  RenderOptions options;
};

/// "1280x720"
void readPictureSize(const std::string& text, RenderOptions& options) {
  const char* end = text.data() + text.size();
  const auto width = std::from_chars(text.data(), end, options.width);
  const bool has_width = width.ec == std::errc{} && width.ptr != end && *width.ptr == 'x';
  if (has_width) {
    const auto height = std::from_chars(width.ptr + 1, end, options.height);
    if (height.ec == std::errc{} && height.ptr == end) return;
  }
  throw CLI::ValidationError("--size", "needs width and height in pixels, for example 1280x720");
}

/// "45,30"
void readDirection(const std::string& text, RenderOptions& options) {
  const auto angles = parseNumbers(text);
  if (!angles || angles->size() != 2)
    throw CLI::ValidationError("--from", "needs azimuth and elevation in degrees, for example 45,30");
  options.azimuth_deg = (*angles)[0];
  options.elevation_deg = (*angles)[1];
}

Result<void> render(const RenderCommand& command) {
  listenForStop();
  setAtStop(AtStop::nothing);
  const KernelCacheUse kernels;
  auto session = OpenSession::open(command.folder, command.device);
  if (!session) return fail(session.error());
  for (const std::string& damage : (*session)->damages())
    std::cerr << "scantrove: " << inLine(damage) << '\n';
  SessionScan scan(**session);
  std::stop_source stop;
  if (stopRequested()) stop.request_stop();
  {
    ProgressLine line;
    const RenderProgress progress = [&](int done, int total) {
      if (stopRequested()) stop.request_stop();
      line.show([&] { return std::to_string(done) + "/" + std::to_string(total) + " frames drawn"; });
    };
    SCANTROVE_TRY(renderScan(scan, command.options, progress, stop.get_token()));
  }
  std::cout << "results  " << inLine(command.options.file.string()) << '\n';
  return {};
}

}  // namespace

void addRenderCommand(CLI::App& app, CommandJob& job) {
  auto command = std::make_shared<RenderCommand>();
  RenderOptions& options = command->options;
  CLI::App* sub = app.add_subcommand("render", "Draw a picture or a turntable video of a saved scan");
  sub->add_option("DIR", command->folder, "folder of the session")->required();
  sub->add_option("--out", command->out,
                  "the new file: .png is one picture, .webm a video that goes around once")
      ->required()
      ->type_name("FILE");
  sub->add_option("--color", command->colors,
                  "'rgb': as the camera saw it; 'regions', 'objects': each in its own colour (default: rgb)")
      ->check(CLI::IsMember({"rgb", "regions", "objects"}))
      ->type_name("rgb|regions|objects");
  sub->add_option("--object", options.object, "show only the object of this name")->type_name("NAME");
  sub->add_option("--size", command->size, "size in pixels (default: 1280x720)")->type_name("WxH");
  sub->add_option(
         "--from", command->from,
         "where the camera stands, in degrees: azimuth (0: where the scan saw it from) and elevation\n"
         "above the horizon (default: 0,30)")
      ->type_name("A,E");
  sub->add_option("--seconds", options.seconds, "length of the video (default: 8)")
      ->check(above(0))
      ->type_name("S");
  sub->add_option("--frames-per-second", options.frames_per_second, "of the video (default: 30)")
      ->transform(wholeNumber(1))
      ->type_name("N");
  sub->add_option("--device", command->device, "OpenCL device; 'scantrove devices' lists them")
      ->type_name("INDEX|NAME");
  sub->callback([command, &job] {
    RenderOptions& given = command->options;
    given.file = command->out;
    given.colors = parsePictureColors(command->colors).value_or(PictureColors::rgb);
    if (!command->size.empty()) readPictureSize(command->size, given);
    if (!command->from.empty()) readDirection(command->from, given);
    if (const auto frames = renderFrameCount(given); !frames)
      throw CLI::ValidationError(frames.error().message(), CLI::ExitCodes::ValidationError);
    job = [command] {
      const CoreApplication qt;
      return render(*command);
    };
  });
}

}  // namespace scantrove
