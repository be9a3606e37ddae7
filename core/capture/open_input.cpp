#include "core/capture/open_input.h"

#include <algorithm>
#include <filesystem>

#include "core/capture/cameras.h"
#include "core/capture/containers/open_container.h"
#include "core/capture/folder_formats.h"
#include "core/capture/folder_listing.h"
#include "core/capture/freenect_source.h"
#include "core/capture/live/live_cameras.h"
#include "core/capture/openni_source.h"
#include "core/capture/phones/phone_folders.h"
#include "core/capture/phones/record3d.h"
#include "core/capture/sens_file.h"

namespace scantrove {
namespace {

using OpenedInput = Result<std::unique_ptr<FrameSource>>;

constexpr const char* kKnownSources =
    "Looked for a 7-Scenes folder (frame-000000.depth.png ...), a TUM RGB-D folder (depth.txt, rgb.txt), "
    "numbered images (depth/ beside color/, image/ or rgb/), a ROS 2 recording (metadata.yaml), and folders "
    "of BOP, ScanNet, Replica, ICL-NUIM, SceneNN, BundleFusion, NYUv2 and FoundationPose, and of apps on "
    "phones (see docs/devices.md). A saved scan has a session.sqlite, a project a scantrove-project.json.";

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

OpenedInput openFile(const std::filesystem::path& file, const SourceOptions& options) {
  const std::string extension = lowerCase(file.extension().string());
  if (extension == ".oni") return openOniRecording(file, options);
  if (extension == ".sens") return openSensFile(file, options);
  if (isRecord3dFile(file)) return openRecord3dFile(file, options);
  const auto format = containerFormat(file);
  if (!format) return fail(format.error());
  if (*format) return openContainer(file, **format, options);
  const std::string advice = adviceForContainer(file);
  return fail(file.string() + " is not a recording in a supported format.",
              advice.empty() ? "Files: .oni, .r3d, .sens, ROS .bag, .db3, .mcap, Azure Kinect .mkv. Folders: "
                               "7-Scenes, TUM RGB-D, numbered colour and depth images, those of phones "
                               "and of benchmarks (see docs/devices.md and docs/devices-benchmarks.md)."
                             : advice);
}

OpenedInput openFolder(const std::filesystem::path& folder, const SourceOptions& options) {
  const auto names = listFolder(folder);
  if (!names) {
    return fail(names.error());
  }
  if (const FolderFormat* const format = findFolderFormat(folder, *names))
    return format->open(folder, *names, options);
  return fail(names->empty() ? "The folder " + folder.string() + " is empty."
                             : "The folder " + folder.string() + " is not a recording in a supported format.",
              kKnownSources + recordingInside(folder, *names));
}

OpenedInput openPath(const std::filesystem::path& path, const SourceOptions& options) {
  std::error_code error;
  const std::filesystem::file_status status = std::filesystem::status(path, error);
  if (status.type() == std::filesystem::file_type::not_found) {
    return fail("There is no " + path.string() + ".",
                "Give a recording's folder or file (.oni, .bag, .db3, .mcap, .mkv, .r3d, .sens), `camera`, "
                "`camera:URI`, `freenect`, `realsense`, `record3d`, `demo` or `demo:room`.");
  }
  if (error) {
    return fail("Cannot open " + path.string() + ": " + error.message() + ".",
                "Check the path and its permissions.");
  }
  if (status.type() == std::filesystem::file_type::directory) {
    return openFolder(path, options);
  }
  return openFile(path, options);
}

}  // namespace

bool isCameraName(const std::string& source) {
  return source == "camera" || source.starts_with("camera:") || isFreenectUri(source) ||
         isLiveCameraUri(source);
}

Result<bool> isRecordingFolder(const std::filesystem::path& folder) {
  return listFolder(folder).map([&](const std::vector<std::string>& names) {
    return std::ranges::any_of(folderFormats(),
                               [&](const FolderFormat& format) { return format.fits(folder, names); });
  });
}

Result<std::unique_ptr<FrameSource>> openInput(const std::string& source, const SourceOptions& options) {
  if (source == "camera") return openCamera("", options);
  if (source.starts_with("camera:")) return openCamera(source.substr(source.find(':') + 1), options);
  return isCameraName(source) ? openCamera(source, options) : openPath(source, options);
}

}  // namespace scantrove
