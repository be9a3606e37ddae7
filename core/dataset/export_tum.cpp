#include <filesystem>
#include <system_error>

#include "core/dataset/dataset_formats.h"
#include "core/exchange/trajectory_writer.h"

namespace scantrove {

Result<void> exportTum(ExportJob& job) {
  constexpr const char* kFile = "trajectory.txt";
  auto trajectory = job.scan().trajectory();
  if (!trajectory) return fail(trajectory.error());
  for (StampedPose& pose : *trajectory) pose.T_world_camera.translation() += job.scan().origin();
  if (trajectory->empty() && job.scans().isProject()) {
    job.summary().notes.push_back("The scan " + job.part().name + " has no tracked frames: no trajectory.");
    return {};
  }
  if (trajectory->empty())
    return fail("The scan " + job.scan().name() +
                " has no tracked frames: there is no trajectory to export.");
  job.summary().points += trajectory->size();
  if (job.options().dry_run) return {};
  const std::filesystem::path file = job.pathOf(kFile);
  std::error_code failure;
  std::filesystem::create_directories(file.parent_path(), failure);  // the next line says what fails
  SCANTROVE_TRY(writeTumTrajectory(file, *trajectory));
  return job.noteWritten(kFile);
}

}  // namespace scantrove
