#include "core/project/task_share.h"

#include <cstddef>

#include "core/base/text.h"

namespace scantrove {
namespace {

using Variable = std::function<std::optional<std::string>(const std::string&)>;

Result<int> slurmNumber(const Variable& variable, const std::string& name) {
  const std::optional<std::string> text = variable(name);
  const std::optional<int> number = text ? parseFrameNumber(*text) : std::nullopt;
  if (number) return *number;
  return fail("'slurm' needs a job of a Slurm array: " + name + " is not set.",
              "Start the script with 'sbatch --array=1-8', or give --task I/N.");
}

Result<TaskShare> slurmShare(const Variable& variable) {
  const Result<int> task = slurmNumber(variable, "SLURM_ARRAY_TASK_ID");
  if (!task) return fail(task.error());
  const Result<int> count = slurmNumber(variable, "SLURM_ARRAY_TASK_COUNT");
  if (!count) return fail(count.error());
  const Result<int> first = slurmNumber(variable, "SLURM_ARRAY_TASK_MIN");
  if (!first) return fail(first.error());
  // Slurm sets the step of "--array=0-30:10" in newer versions only; else tasks follow each other.
  const int step = slurmNumber(variable, "SLURM_ARRAY_TASK_STEP").value_or(1);
  const TaskShare share{(*task - *first) / (step > 0 ? step : 1) + 1, *count};
  if (share.index >= 1 && share.index <= share.count) return share;
  return fail("The Slurm array has gaps: task " + std::to_string(*task) + " has no place among " +
                  std::to_string(*count) + ".",
              "Number the tasks without gaps, as in 'sbatch --array=1-8', or give --task I/N.");
}

}  // namespace

std::vector<std::string> TaskShare::of(const std::vector<std::string>& sources) const {
  std::vector<std::string> share;
  const auto step = static_cast<std::size_t>(count);
  for (auto at = static_cast<std::size_t>(index - 1); at < sources.size(); at += step)
    share.push_back(sources[at]);
  return share;
}

Result<TaskShare> parseTaskShare(const std::string& text, const Variable& variable) {
  if (text == "slurm") return slurmShare(variable);
  const std::size_t slash = text.find('/');
  const std::optional<int> index = parseFrameNumber(text.substr(0, slash));
  const std::optional<int> count =
      slash == std::string::npos ? std::nullopt : parseFrameNumber(text.substr(slash + 1));
  if (index && count && *index >= 1 && *index <= *count) return TaskShare{*index, *count};
  return fail("'" + text + "' is not a share of a list.",
              "Write I/N with I from 1 to N, for example 2/8, or 'slurm' in a job of a Slurm array.");
}

}  // namespace scantrove
