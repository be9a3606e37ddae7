#pragma once
#include <chrono>
#include <filesystem>
#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <string_view>

#include "core/base/result.h"
#include "core/capture/frame_source.h"
#include "core/pipeline/object_mask.h"
#include "core/session/scan_params.h"

namespace scantrove {

/// The parameters of a scan.
struct ScanRequest {
  enum class Poses {
    automatic,  ///< a device's own poses are the prediction; a recording with other poses, or none, is
                ///< tracked
    tracked,    ///< by the camera alone
    given       ///< the recording's
  };
  /// Opens the frames in place of openSource(), for sources that have no name. Empty: openSource() does.
  std::function<Result<std::unique_ptr<FrameSource>>(const SourceOptions&)> open_frames = {};
  /// As for openSource. Empty: no scan; the session in `output_folder` is opened for review.
  std::string source;
  SourceOptions source_options;
  /// Scan this object alone: the plane below it and the room are left out, poses are relative to it, and a
  /// device's own poses are not used. Not with `resume`.
  std::optional<ObjectChoice> object = {};
  Poses poses = Poses::automatic;  ///< with `resume`, automatic continues as the session was scanned
  ScanParams params;
  std::string device;    ///< as for chooseDevice
  std::string database;  ///< catalogue to search and extend; empty with `resume`: the session's
  std::optional<std::filesystem::path> output_folder;  ///< for results; empty: only the catalogue is written
  bool session = true;  ///< store a session there, so that the scan can be opened again
  bool results = true;  ///< write trajectory, cloud and report there, not only the session
  bool label_maps = false;
  bool record_all = false;  ///< store the images of every frame in the session, not only of key frames
  /// Continue the session in `output_folder`; otherwise a new one starts there.
  bool resume = false;
  /// With `resume`: leave out the frames of the session's last recording that the session has, if that is
  /// the source. Without, they are read again.
  bool rest_only = false;
  /// Start in a folder with files that no scan wrote (see checkHoldsOnlyOurs()).
  bool overwrite = false;
  /// After the scan its session stays open until the next one starts: for editing, viewing key frames and
  /// exporting data sets.
  bool review = false;
  bool skip_refinement = false;  ///< postpone the refinement
  /// No scan; do the postponed refinement of the session in `output_folder`, with its source, camera and
  /// parameters. Existing results are written again.
  bool refine_session = false;
  bool start_paused = false;
  bool pictures = true;          ///< snapshots contain images and cloud, not only numbers
  bool profile_kernels = false;  ///< measure each kernel separately, which takes time
  /// How long the end of the scan waits for a catalogue that cannot be written.
  std::chrono::milliseconds catalogue_patience{20000};
};

/// Names on the command line and in sessions.
[[nodiscard]] constexpr std::string_view toString(ScanRequest::Poses poses) {
  switch (poses) {
    case ScanRequest::Poses::automatic:
      return "auto";
    case ScanRequest::Poses::tracked:
      return "tracked";
    case ScanRequest::Poses::given:
      return "given";
  }
  return "";
}
/// None: not such a name.
[[nodiscard]] constexpr std::optional<ScanRequest::Poses> posesFrom(std::string_view name) {
  using enum ScanRequest::Poses;
  for (const ScanRequest::Poses poses : {automatic, tracked, given}) {
    if (toString(poses) == name) return poses;
  }
  return std::nullopt;
}

}  // namespace scantrove
