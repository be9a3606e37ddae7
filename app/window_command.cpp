#include "app/window_command.h"

#include <charconv>
#include <filesystem>

#include "core/capture/open_input.h"
#include "core/project/opened_path.h"

namespace scantrove {
namespace {

/// A word that is neither a command nor a source is a typing error and must not open a window.
std::string checkSource(const std::string& source) {
  const auto names = [&](const std::string& kind) {
    return source == kind || source.starts_with(kind + ":");
  };
  std::error_code error;  // for example a dangling link, which openSource() reports
  if (names("demo") || isCameraName(source) || std::filesystem::exists(source, error) || error) return {};
  return "'" + source +
         "' is neither a command nor something to open (a folder of a recording, of a saved scan or of a "
         "project, a recorded file, demo, camera, freenect, realsense, record3d)";
}

/// "1400x900"
bool readSize(const std::string& text, int& width, int& height) {
  const char* end = text.data() + text.size();
  const auto first = std::from_chars(text.data(), end, width);
  if (first.ec != std::errc{} || first.ptr == end || *first.ptr != 'x') return false;
  const auto second = std::from_chars(first.ptr + 1, end, height);
  return second.ec == std::errc{} && second.ptr == end && width > 0 && height > 0;
}

}  // namespace

void WindowCommand::addTo(CLI::App& app) {
  app.add_option("SOURCE", scan_.source, kSourceHelp)->check(CLI::Validator(checkSource, ""));
  scan_.addTo(app);
  CLI::Option* project =
      app.add_option("--project", project_, "project to open (default: as last time)")->type_name("DIR");
  app.add_option("--database", database_, "instead of --project: a catalogue outside projects")
      ->excludes(project)
      ->type_name("FILE");
  app.add_flag("--paused", paused_, "start paused; Space resumes");
  app.add_flag("--present", present_, "presentation mode: full screen, in a loop; Escape ends it");
  app.add_option("--theme", theme_, "theme (default: as last time)")
      ->check(CLI::IsMember({"dark", "light"}))
      ->type_name("dark|light");
  app.add_option("--window-size", size_, "size of the window in pixels")->type_name("WxH");
  app.add_option("--screenshot", screenshot_,
                 "when SOURCE ends, save a picture of the window in this new file and quit")
      ->check(CLI::NonexistentPath)
      ->type_name("FILE");
}

WindowOptions WindowCommand::toOptions() const {
  const ScanRequest request = scan_.toRequest();
  WindowOptions options;
  options.source = request.source;
  options.source_options = request.source_options;
  options.poses = request.poses;
  options.device = request.device;
  options.params = request.params;
  options.project = project_;
  options.database = database_;
  if (const OpenedPath path = recognizePath(request.source); path.kind == OpenedPath::Kind::project) {
    if (!project_.empty() || !database_.empty())
      throw CLI::ValidationError("SOURCE",
                                 "is a project. Omit --project and --database, or open something else");
    options.source.clear();
    options.project = path.folder.string();
  }
  options.start_paused = paused_;
  options.present = present_;
  options.theme = theme_;
  if (!screenshot_.empty()) options.screenshot = screenshot_;
  if (!size_.empty() && !readSize(size_, options.width, options.height)) {
    throw CLI::ValidationError("--window-size", "needs width and height in pixels, for example 1400x900");
  }
  return options;
}

}  // namespace scantrove
