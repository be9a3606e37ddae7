#pragma once
#include <CLI/CLI.hpp>
#include <string>
#include <vector>

#include "core/scan/scan_session.h"

namespace scantrove {

/// The options that say what to scan and how; shared by all commands that scan.
struct ScanOptions {
  std::string source;
  int frames = 0;  ///< 0 = all
  int start = 0;
  int stride = 1;
  std::string poses = "tracked";
  std::string intrinsics;    ///< "fx,fy,cx,cy", or empty
  std::string color_camera;  ///< "registered" or "fx,fy,cx,cy,x"; empty = the source's
  double depth_scale = 0;    ///< units per metre; 0 = the source's
  std::string config;
  std::vector<std::string> settings;
  std::string device;

  void addTo(CLI::App& command);

  /// What they ask for; all but results and catalogue. Throws CLI::ValidationError (wrong usage) with what is
  /// wrong.
  [[nodiscard]] ScanRequest toRequest() const;
};

/// The parameters after `config` (none when empty), then `settings`. Throws CLI::ValidationError.
[[nodiscard]] ScanParams paramsFrom(const std::string& config, const std::vector<std::string>& settings);

}  // namespace scantrove
