#pragma once
#include <filesystem>
#include <opencv2/core/mat.hpp>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "core/base/result.h"
#include "core/capture/nyu_raw_names.h"
#include "core/capture/rgbd_frame.h"
#include "core/compute/compute_context.h"
#include "core/evaluation/nyu2.h"
#include "core/evaluation/nyu_labeled_file.h"
#include "core/session/scan_params.h"

namespace scantrove {

/// The frames of a video up to a labelled one, as the recording has them: ascending, the labelled one last.
struct Nyu2Clip {
  Intrinsics K;
  std::vector<RgbdFrame> frames;
  std::vector<std::string> skipped;  ///< messages about earlier frames that are unusable
};

/// Finds the frames of labelled images in the folders of the raw data set. One thread.
class Nyu2Videos {
 public:
  /// Error: `root` cannot be read.
  [[nodiscard]] static Result<Nyu2Videos> open(const std::filesystem::path& root);

  /// Whether a folder of the scene is there.
  [[nodiscard]] bool hasScene(const NyuOrigin& origin) const { return !folderOf(origin).empty(); }
  /// The labelled frame and at most `frames` - 1 frames before it. Error: the labelled frame is missing or
  /// unusable.
  [[nodiscard]] Result<Nyu2Clip> read(const NyuOrigin& origin, int frames);

 private:
  [[nodiscard]] std::filesystem::path folderOf(const NyuOrigin& origin) const;

  std::map<std::string, std::filesystem::path> scenes_;
  std::filesystem::path folder_;    // of the last clip
  std::vector<std::string> names_;  // of its files
  std::vector<NyuRawPair> pairs_;
};

/// Scans the frames, and compares the last one's segments and regions with `truth`, of its depth image's
/// size. Empty: tracking lost the last frame, or `is_stopped` became true. Error: the device.
[[nodiscard]] Result<std::optional<Nyu2Outcome>> scanNyu2Clip(ComputeContext& compute,
                                                              const ScanParams& params, const Intrinsics& K,
                                                              std::span<const RgbdFrame> frames,
                                                              const cv::Mat1i& truth, bool (*is_stopped)());

}  // namespace scantrove
