#pragma once
#include <chrono>
#include <filesystem>
#include <optional>
#include <string>

#include "core/capture/frame_source.h"
#include "core/session/scan_params.h"

namespace scantrove {

/// What a scan is to do.
struct ScanRequest {
  enum class Poses { tracked, given };
  /// As openSource takes it. Empty: nothing is scanned, the session in `output_folder` is opened for review.
  std::string source;
  SourceOptions source_options;
  Poses poses = Poses::tracked;
  ScanParams params;
  std::string device;    ///< as chooseDevice takes it
  std::string database;  ///< catalogue to search and add to; empty, with `resume`: that of the session
  std::optional<std::filesystem::path>
      output_folder;    ///< where results go; none: nothing but the catalogue is written
  bool session = true;  ///< keep the scan there, so that it can be opened again
  bool results = true;  ///< write trajectory, cloud and report there, not the session only
  bool label_maps = false;
  bool record_all = false;  ///< keep the images of every frame in the session, not of key frames only
  /// Continue the session in `output_folder`; else a new one begins there.
  bool resume = false;
  /// Begin in a folder with files that no scan wrote (see checkHoldsOnlyOurs()).
  bool overwrite = false;
  /// When the scan has ended, its session stays open until the next one starts: it can be edited, its key
  /// frames shown, and data sets made of it.
  bool review = false;
  bool skip_refinement = false;  ///< leave the pass after the last frame for later
  /// Scan nothing; do the refinement that the session in `output_folder` has not had, with its own source,
  /// camera and parameters. Results are written anew where there are some.
  bool refine_session = false;
  bool start_paused = false;
  bool pictures = true;          ///< snapshots hold images and cloud; else numbers alone
  bool profile_kernels = false;  ///< measures every kernel by itself, which takes time
  /// How long the end of the scan waits for a catalogue in which nothing can be stored.
  std::chrono::milliseconds catalogue_patience{20000};
};

}  // namespace scantrove
