#pragma once
#include <filesystem>
#include <functional>
#include <string>
#include <vector>

#include "core/base/result.h"
#include "core/session/scan_params.h"

namespace scantrove {

/// One parameter in the form that users see: on the command line, in a configuration file, in the window.
struct ParamInfo {
  std::string key;   ///< e.g. "segmentation.k"
  std::string unit;  ///< "m", "px", ...; empty = a pure number
  double minimum = 0;
  double maximum = 0;
  bool is_integer = false;                       ///< only whole numbers
  bool can_be_automatic = false;                 ///< kAutomatic, in words "auto", is a value, too
  std::string help;                              ///< one line
  std::vector<std::string> choices;              ///< non-empty: the value is one of these words
  std::function<double(const ScanParams&)> get;  ///< choices: the index of the word; of a file 0
  std::function<void(ScanParams&, double)> set;
  /// Only of a parameter that names a file; empty: none. `get` and `set` do nothing then.
  std::function<std::string&(ScanParams&)> file = {};

  [[nodiscard]] bool isNumber() const { return choices.empty() && !file; }
  [[nodiscard]] bool isAutomatic(const ScanParams& params) const;
  /// The value as it would be written in a configuration file; "off": no file, "auto": by the sensor.
  [[nodiscard]] std::string text(const ScanParams& params) const;
};

/// The parameters that users can judge by eye, grouped by stage in pipeline order. All others are members
/// of the stages' params with their reason beside them; only tests and benchmarks change them.
[[nodiscard]] const std::vector<ParamInfo>& paramRegistry();

/// Applies "key=value". Error: unknown key (suggests similar ones), not a number (or not an integer where
/// required), outside its range. A file becomes an absolute path, so that a session finds it again.
[[nodiscard]] Result<void> applySetting(ScanParams& params, const std::string& setting);

/// Applies a TOML file of tables [fusion], [segmentation], ... Error: names file, line and key.
[[nodiscard]] Result<void> loadConfig(ScanParams& params, const std::filesystem::path& file);

}  // namespace scantrove
