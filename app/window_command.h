#pragma once
#include <CLI/CLI.hpp>
#include <string>

#include "app/scan_options.h"
#include "ui/main_window/window_options.h"

namespace scantrove {

/// `scantrove [SOURCE]` without a command: the window.
class WindowCommand {
 public:
  /// Adds the options to `app`.
  void addTo(CLI::App& app);

  /// Throws CLI::ValidationError (wrong usage).
  [[nodiscard]] WindowOptions toOptions() const;

 private:
  ScanOptions scan_;
  std::string project_;
  std::string database_;
  std::string screenshot_;
  std::string size_;
  std::string theme_;
  bool paused_ = false;
  bool present_ = false;
};

}  // namespace scantrove
