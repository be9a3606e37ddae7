#pragma once
#include <filesystem>
#include <optional>
#include <string>

#include "core/scan/scan_request.h"

namespace scantrove {

/// What the command line may say about the window.
struct WindowOptions {
  std::string source;  ///< opened at once; empty: the start page
  SourceOptions source_options;
  ScanRequest::Poses poses = ScanRequest::Poses::tracked;
  std::string device;
  std::string database;  ///< empty: the person's own, in $XDG_DATA_HOME
  ScanParams params;
  bool start_paused = false;
  /// Save a picture of the window there when the scan has ended, and quit.
  std::optional<std::filesystem::path> screenshot;
  int width = 0;  ///< of the window; 0: remembered or usual
  int height = 0;
  bool present = false;  ///< full screen, to be looked at
  std::string theme;     ///< "dark", "light", or empty: as remembered
};

}  // namespace scantrove
