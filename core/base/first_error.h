#pragma once
#include "core/base/log.h"
#include "core/base/result.h"

namespace scantrove {

/// Result of steps that all run, even after failures. Keeps the first failure and logs the others.
class FirstError {
 public:
  void note(const Result<void>& step) {
    if (step) return;
    if (result_) {
      result_ = step;
    } else {
      spdlog::warn("{}", step.error().message());
    }
  }

  [[nodiscard]] const Result<void>& result() const { return result_; }

 private:
  Result<void> result_;
};

}  // namespace scantrove
