#pragma once
#include <nlohmann/json_fwd.hpp>
#include <string>
#include <vector>

#include "core/base/result.h"

namespace scantrove {

struct RecognitionEvaluation {
  std::string folder;  ///< NAME-color.*, NAME-depth.png, NAME-label.png and label_mapping.csv (HOTS)
  std::string device;  ///< of OpenCL; empty: the default
  std::vector<std::string> settings;  ///< KEY=VALUE
  bool each_image = false;            ///< is a scene; else images are whose names differ in the last number
  int views = 3;                      ///< stored of each thing, each from another image
  int draws = 5;                      ///< random choices of these views
  int seed = 1;
};

/// Recognition of single pictures by the program's own detector. Labels number thing and instance: LABEL =
/// 100 * thing + instance; label_mapping.csv names the things. Crops are cut by the labels, and compared with
/// views of other scenes. Each crop is compared twice, with and without its own thing in the catalogue. Names
/// are judged by the distance alone: single photographs show too little of a thing to demand its size.
/// Error: the folder, an image, the mapping or the device cannot be used; no thing is in two scenes.
[[nodiscard]] Result<nlohmann::ordered_json> evaluateRecognition(const RecognitionEvaluation& request);

/// The result in a few lines for people, to stdout.
void printRecognition(const nlohmann::ordered_json& result);

}  // namespace scantrove
