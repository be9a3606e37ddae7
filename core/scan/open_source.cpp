#include "core/scan/open_source.h"

#include "core/capture/camera_intrinsics.h"
#include "core/capture/color_registration.h"
#include "core/capture/looped_source.h"
#include "core/capture/open_input.h"
#include "core/capture/read_ahead.h"
#include "core/capture/reconnecting_source.h"
#include "core/capture/reopened_camera.h"
#include "core/capture/source_options.h"
#include "core/capture/usable_depth_source.h"
#include "core/session/session_store.h"
#include "core/synthetic/synthetic_source.h"

namespace scantrove {
namespace {

using OpenedSource = Result<std::unique_ptr<FrameSource>>;

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

/// Whether it names a session's folder that is no recording.
bool isScan(const std::string& source) {
  if (isCameraName(source) || !SessionStore::isSession(source)) return false;
  const Result<bool> is_recording = isRecordingFolder(source);
  return is_recording && !*is_recording;
}

OpenedSource open(const std::string& source, const SourceOptions& options) {
  if (source == "demo" || source.starts_with("demo:")) {
    return openDemo(source, options);
  }
  if (isScan(source)) {
    return fail(source + " is a scan, not a recording.",
                "Open it with 'scantrove " + source +
                    "'; to go on in it, scan a recording or a camera with --resume " + source + ".");
  }
  return openInput(source, options);
}

}  // namespace

Result<std::unique_ptr<FrameSource>> openSource(const std::string& source, const SourceOptions& options,
                                                LostCamera lost) {
  if (source.empty()) {
    return fail("No source given.",
                "Give a recording's folder or file (.oni, .bag, .db3, .mcap, .mkv, .r3d, .sens), `camera`, "
                "`camera:URI`, `freenect`, `realsense`, `record3d` or `demo`.");
  }
  SCANTROVE_TRY(checkSourceOptions(options));
  return open(source, options).map([&](std::unique_ptr<FrameSource> opened) -> std::unique_ptr<FrameSource> {
    if (lost == LostCamera::awaited && opened->info().is_live) {
      opened = std::make_unique<ReconnectingSource>(std::move(opened),
                                                    [=] { return reopenCamera(source, options); });
    }
    if (options.loops > 1 && !opened->info().is_live) {
      opened = std::make_unique<LoopedSource>(
          std::move(opened), [=] { return open(source, options); }, options.loops);
    }
    auto usable = std::make_unique<UsableDepthSource>(std::move(opened));
    return std::make_unique<ReadAhead>(std::move(usable), ReadAhead::kCapacity, options.frames);
  });
}

}  // namespace scantrove
