// What ScanRun makes of a scan that cannot come to much.
#include <algorithm>
#include <utility>

#include "core/catalogue/object_database.h"
#include "core/scan/scan_run.h"

namespace scantrove {

void ScanRun::advise(const Error& advice) {
  advice_.push_back(advice.message());
  listener_(ScanAdvice{advice});
}

Result<void> ScanRun::followAdvisor(const RgbdFrame& frame, bool is_usable) {
  if (const std::optional<Error> advice = advisor_.addFrame(frame, is_usable)) advise(*advice);
  if (!advisor_.isMisled() || !isUntouched()) return {};
  return beginAnew(frame.index);
}

bool ScanRun::isUntouched() const {
  return !request_.resume && pipeline_->editor().log().entries().empty() &&
         objects_->collector().objects().list().empty();
}

Result<void> ScanRun::beginAnew(int frame_index) {
  const Result<std::unique_ptr<ObjectDatabase>> database = ObjectDatabase::open(request_.database);
  if (!database) return fail(database.error());
  SCANTROVE_TRY(createPipeline(**database));
  frames_.lost += std::exchange(frames_.tracked, 0);
  frames_.relocalized = 0;
  drift_ = {};
  const std::vector<int> dropped = std::exchange(first_usable_, {});
  lost_frames_.insert(lost_frames_.end(), dropped.begin(), dropped.end());
  std::ranges::sort(lost_frames_);
  if (recorder_) recorder_->beginAnew();
  if (output_) output_->beginAnew();
  if (local_poses_ != nullptr) local_poses_->forget();
  advise(advisor_.beginAnew(frame_index));
  return {};
}

Result<void> ScanRun::checkResult(const ScanReport& report) const {
  const bool is_empty = frames_.tracked > 0 && report.map_bricks > 0 && output_ && !keeps_earlier_scan_ &&
                        output_->cloudPoints() == 0;
  if (!is_empty) return {};
  return fail("The scan holds no surface: nothing of what its frames show came into the cloud.",
              "Check the poses, the depth scale (--depth-scale), and fusion.min_depth_m and "
              "fusion.max_depth_m.");
}

}  // namespace scantrove
