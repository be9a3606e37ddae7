#pragma once
#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "core/base/result.h"

namespace scantrove {

/// The part of a list that one of several tasks scans: every `count`-th source, from number `index` on.
struct TaskShare {
  int index = 1;  ///< 1 to `count`
  int count = 1;

  [[nodiscard]] std::vector<std::string> of(const std::vector<std::string>& sources) const;
};

/// Reads "I/N" (I from 1 to N), or "slurm": the place of this job in its Slurm array. `variable` gives the
/// value of an environment variable. Error: says what a share looks like, or which variable is missing.
[[nodiscard]] Result<TaskShare> parseTaskShare(
    const std::string& text, const std::function<std::optional<std::string>(const std::string&)>& variable);

}  // namespace scantrove
