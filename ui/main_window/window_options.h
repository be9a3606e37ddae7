#pragma once
#include <filesystem>
#include <optional>
#include <string>

#include "core/scan/scan_request.h"

namespace scantrove {

/// Window options of the command line.
struct WindowOptions {
  std::string source;  ///< opened at once; empty: the start page
  SourceOptions source_options;
  ScanRequest::Poses poses = ScanRequest::Poses::automatic;
  std::string device;
  std::string project;   ///< a folder; empty: as last time
  std::string database;  ///< a catalogue instead of a project
  ScanParams params;
  bool start_paused = false;
  /// File for a picture of the window when the scan ends; the program then quits.
  std::optional<std::filesystem::path> screenshot;
  int width = 0;  ///< of the window; 0: stored or default size
  int height = 0;
  bool present = false;  ///< presentation mode
  std::string theme;     ///< "dark", "light", or empty: as stored
};

}  // namespace scantrove
