#include "core/capture/open_input.h"

#include <filesystem>

#include "core/capture/cameras.h"
#include "core/capture/folder_listing.h"
#include "core/capture/freenect_source.h"
#include "core/capture/numbered_folder.h"
#include "core/capture/openni_source.h"
#include "core/capture/seven_scenes.h"
#include "core/capture/tum_folder.h"

namespace scantrove {
namespace {

using OpenedInput = Result<std::unique_ptr<FrameSource>>;

constexpr const char* kKnownSources =
    "Looked for a 7-Scenes folder (frame-000000.depth.png ...), a TUM RGB-D folder (depth.txt, rgb.txt), and "
    "numbered images (depth/ beside color/, image/ or rgb/).";

/// A 7-Scenes download contains its recordings in seq-01, seq-02, ...: the message says so.
std::string recordingInside(const std::filesystem::path& folder, const std::vector<std::string>& names) {
  for (const std::string& name : names) {
    std::error_code error;
    const std::filesystem::path inside = folder / name;
    if (!std::filesystem::is_directory(inside, error)) {
      continue;
    }
    if (const auto is_recording = isRecordingFolder(inside); is_recording && *is_recording) {
      return " Open " + inside.string() + " instead: that is one.";
    }
  }
  return {};
}

OpenedInput openFolder(const std::filesystem::path& folder, const SourceOptions& options) {
  const auto names = listFolder(folder);
  if (!names) {
    return fail(names.error());
  }
  if (isSevenScenesFolder(*names)) {
    return openSevenScenes(folder, *names, options);
  }
  if (isTumFolder(*names)) {
    return openTumFolder(folder, options);
  }
  if (isNumberedFolder(folder)) {
    return openNumberedFolder(folder, options);
  }
  return fail(names->empty() ? "The folder " + folder.string() + " is empty."
                             : "The folder " + folder.string() + " is not a recording in a supported format.",
              kKnownSources + recordingInside(folder, *names));
}

OpenedInput openPath(const std::filesystem::path& path, const SourceOptions& options) {
  std::error_code error;
  const std::filesystem::file_status status = std::filesystem::status(path, error);
  if (status.type() == std::filesystem::file_type::not_found) {
    return fail("There is no " + path.string() + ".",
                "Give a recording's folder, an .oni file, `camera`, `camera:URI`, `freenect`, `demo` or "
                "`demo:room`.");
  }
  if (error) {
    return fail("Cannot open " + path.string() + ": " + error.message() + ".",
                "Check the path and its permissions.");
  }
  if (status.type() == std::filesystem::file_type::directory) {
    return openFolder(path, options);
  }
  if (lowerCase(path.extension().string()) == ".oni") {
    return openOniRecording(path, options);
  }
  return fail(path.string() + " is not a recording in a supported format.",
              "Files: .oni. Folders: 7-Scenes, TUM RGB-D, numbered colour and depth images.");
}

}  // namespace

bool isCameraName(const std::string& source) {
  return source == "camera" || source.starts_with("camera:") || isFreenectUri(source);
}

Result<bool> isRecordingFolder(const std::filesystem::path& folder) {
  return listFolder(folder).map([&](const std::vector<std::string>& names) {
    return isSevenScenesFolder(names) || isTumFolder(names) || isNumberedFolder(folder);
  });
}

Result<std::unique_ptr<FrameSource>> openInput(const std::string& source, const SourceOptions& options) {
  if (source == "camera") return openCamera("", options);
  if (source.starts_with("camera:")) return openCamera(source.substr(source.find(':') + 1), options);
  return isCameraName(source) ? openCamera(source, options) : openPath(source, options);
}

}  // namespace scantrove
