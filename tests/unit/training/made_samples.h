#pragma once
#include "core/discovery/objectness/objectness_features.h"
#include "core/labeling/border_features.h"
#include "tools/train/samples.h"

namespace scantrove::test {

/// Two samples of region sets and one of a border, with values 0.5, 1.5, ... and an unknown one in each.
inline train::SceneSamples madeSamples() {
  train::SceneSamples samples;
  samples.origin = {"room:7:hard", 30, "abc123"};
  train::ObjectnessSample set;
  set.regions = {3, 14};
  set.frame = 12;
  set.object = 5;
  set.overlap = 0.75F;
  for (std::size_t f = 0; f < kObjectnessFeatures.size(); ++f) set.x.push_back(static_cast<float>(f) + 0.5F);
  set.x[2] = kUnknownFeature;
  train::ObjectnessSample none = set;
  none.regions = {9};
  none.object = 0;
  none.overlap = 0;
  none.x[0] = -1e-7F;
  samples.objectness = {set, none};
  train::BorderSample border;
  border.is_same_object = true;
  for (std::size_t f = 0; f < kBorderFeatures.size(); ++f) border.x.push_back(static_cast<float>(f) - 0.1F);
  border.x[1] = kUnknownFeature;
  samples.borders = {border};
  return samples;
}

}  // namespace scantrove::test
