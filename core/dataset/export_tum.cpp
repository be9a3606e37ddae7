#include "core/dataset/dataset_formats.h"
#include "core/exchange/trajectory_writer.h"

namespace scantrove {

Result<void> exportTum(ExportJob& job) {
  constexpr const char* kFile = "trajectory.txt";
  auto trajectory = job.scan().trajectory();
  if (!trajectory) return fail(trajectory.error());
  for (StampedPose& pose : *trajectory) pose.T_world_camera.translation() += job.scan().origin();
  if (trajectory->empty())
    return fail("The scan " + job.scan().name() +
                " has no tracked frames: there is no trajectory to export.");
  SCANTROVE_TRY(writeTumTrajectory(job.pathOf(kFile), *trajectory));
  SCANTROVE_TRY(job.noteWritten(kFile));
  job.summary().points = trajectory->size();
  return {};
}

}  // namespace scantrove
