#include "core/scan/open_source.h"

#include <filesystem>

#include "core/capture/camera_intrinsics.h"
#include "core/capture/cameras.h"
#include "core/capture/color_registration.h"
#include "core/capture/folder_listing.h"
#include "core/capture/freenect_source.h"
#include "core/capture/numbered_folder.h"
#include "core/capture/openni_source.h"
#include "core/capture/read_ahead.h"
#include "core/capture/seven_scenes.h"
#include "core/capture/source_options.h"
#include "core/capture/tum_folder.h"
#include "core/session/session_store.h"
#include "core/synthetic/synthetic_source.h"

namespace scantrove {

namespace {

using OpenedSource = Result<std::unique_ptr<FrameSource>>;

constexpr const char* kKnownSources =
    "Looked for a 7-Scenes folder (frame-000000.depth.png ...), a TUM RGB-D folder (depth.txt, rgb.txt), and "
    "numbered images (depth/ beside color/, image/ or rgb/).";

OpenedSource openDemo(const std::string& source, const SourceOptions& options) {
  const std::string scene = source == "demo" ? "tabletop" : source.substr(source.find(':') + 1);
  auto demo = makeSyntheticSource(scene, options);
  if (!demo) {
    return fail(demo.error());
  }
  const Intrinsics& K = (*demo)->info().intrinsics;
  SCANTROVE_TRY(checkIntrinsics(K, "--intrinsics"));
  if (options.color_registration) {
    SCANTROVE_TRY(colorCameraFor(*options.color_registration, {K.width, K.height}, K, "the demo"));
  }
  return std::move(*demo);
}

/// A 7-Scenes download contains its recordings in seq-01, seq-02, ...: the message says so.
std::string recordingInside(const std::filesystem::path& folder, const std::vector<std::string>& names) {
  for (const std::string& name : names) {
    std::error_code error;
    const std::filesystem::path inside = folder / name;
    if (!std::filesystem::is_directory(inside, error)) {
      continue;
    }
    const auto inside_names = listFolder(inside);
    if (inside_names &&
        (isSevenScenesFolder(*inside_names) || isTumFolder(*inside_names) || isNumberedFolder(inside))) {
      return " Open " + inside.string() + " instead: that is one.";
    }
  }
  return {};
}

OpenedSource openFolder(const std::filesystem::path& folder, const SourceOptions& options) {
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
  if (SessionStore::isSession(folder)) {
    return fail(folder.string() + " is a scan, not a recording.",
                "Open it with 'scantrove " + folder.string() +
                    "'; to go on in it, scan a recording or a camera with "
                    "--resume " +
                    folder.string() + ".");
  }
  return fail(names->empty() ? "The folder " + folder.string() + " is empty."
                             : "The folder " + folder.string() + " is not a recording in a supported format.",
              kKnownSources + recordingInside(folder, *names));
}

OpenedSource openPath(const std::filesystem::path& path, const SourceOptions& options) {
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

OpenedSource open(const std::string& source, const SourceOptions& options) {
  if (source == "demo" || source.starts_with("demo:")) {
    return openDemo(source, options);
  }
  if (source == "camera" || source.starts_with("camera:")) {
    return openCamera(source == "camera" ? "" : source.substr(source.find(':') + 1), options);
  }
  if (isFreenectUri(source)) {
    return openCamera(source, options);
  }
  return openPath(source, options);
}

}  // namespace

Result<std::unique_ptr<FrameSource>> openSource(const std::string& source, const SourceOptions& options) {
  if (source.empty()) {
    return fail("No source given.",
                "Give a recording's folder, an .oni file, `camera`, `camera:URI`, `freenect` or `demo`.");
  }
  SCANTROVE_TRY(checkSourceOptions(options));
  return open(source, options).map([&](std::unique_ptr<FrameSource> opened) -> std::unique_ptr<FrameSource> {
    return std::make_unique<ReadAhead>(std::move(opened), ReadAhead::kCapacity, options.frames);
  });
}

}  // namespace scantrove
