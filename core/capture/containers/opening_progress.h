#pragma once
#include <chrono>
#include <string>

#include "core/base/result.h"
#include "core/capture/frame_source.h"

namespace scantrove {

/// Progress of opening a large file. Says nothing during the first second. One thread.
class OpeningProgress {
 public:
  OpeningProgress(std::string name, const SourceOptions& options)
      : name_(std::move(name)), on_opening_(options.on_opening) {}

  /// Reports that the part `done` (0 - 1) is read, once a second. Cheap enough for each record. Error:
  /// cancelled by SourceOptions::on_opening or by a signal that ends the program.
  [[nodiscard]] Result<void> report(double done);

 private:
  using Clock = std::chrono::steady_clock;

  std::string name_;
  std::function<bool(double done)> on_opening_;
  int calls_ = 0;
  Clock::time_point last_ = Clock::now();
};

}  // namespace scantrove
