#pragma once
#include <vector>

namespace scantrove {

/// Distribution of a set of errors (unit of the errors); zeros for an empty set. The median of an even number
/// of errors is the mean of the middle two.
struct ErrorSummary {
  double rmse = 0;
  double mean = 0;
  double median = 0;
  double max = 0;
  int count = 0;
};

[[nodiscard]] ErrorSummary summarizeErrors(std::vector<double> errors);

}  // namespace scantrove
