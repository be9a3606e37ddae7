#pragma once
#include "core/base/log.h"
#include "core/base/result.h"

namespace scantrove {

/// The outcome of steps that are all tried, whatever became of those before: the first failure is kept, the
/// others go to the log.
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
