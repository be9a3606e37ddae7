#pragma once
#include <string>
#include <vector>

#include "core/base/result.h"
#include "core/evaluation/nyu2.h"

namespace scantrove {

struct Nyu2Evaluation {
  std::string raw;                    ///< folder with the scenes of the raw data set
  std::string labeled;                ///< nyu_depth_v2_labeled.mat
  std::string output;                 ///< keeps results; empty: none are kept
  std::vector<int> frames;            ///< numbers n of frames to scan; empty: 1 to 20. 1 and 8 are added
  int every = 1;                      ///< use every N-th labelled image
  std::string device;                 ///< of OpenCL; empty: the default
  std::vector<std::string> settings;  ///< KEY=VALUE
};

struct Nyu2Report {
  int labeled_images = 0;   ///< chosen of the file
  int without_scene = 0;    ///< of these, images whose scene is not among the raw data
  int unusable = 0;         ///< images whose frame is missing, unreadable or without depth
  bool is_complete = true;  ///< false: stopped by a signal
  std::vector<Nyu2Point> curve;
};

/// The experiment of thesis 4.1: for each labelled image and each n, scans the n frames of its video that end
/// with it, and compares the segmentation of the last one with the labels. With an output folder, results of
/// an earlier run are used, and table-4.1.txt, figure-4.9.csv and figure-4.9.png are written. Progress and
/// unusable images are reported on stderr. The first Ctrl+C ends it with what there is. Error: a file, the
/// folder or the device cannot be used, or no image could be evaluated.
[[nodiscard]] Result<Nyu2Report> evaluateNyu2(const Nyu2Evaluation& request);

}  // namespace scantrove
