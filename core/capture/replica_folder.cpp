#include "core/capture/replica_folder.h"

#include <Eigen/Core>
#include <algorithm>
#include <map>

#include "core/base/text.h"
#include "core/base/text_file.h"
#include "core/capture/data_set_camera.h"
#include "core/capture/folder_listing.h"
#include "core/capture/folder_pairs.h"
#include "core/capture/json_file.h"

namespace scantrove {
namespace {

constexpr Intrinsics kReplicaCamera{600, 600, 599.5F, 339.5F, 1200, 680};
constexpr double kReplicaUnitsPerMeter = 6553.5;
constexpr const char* kReplicaParams = "cam_params.json";

Result<std::vector<ImageSequenceEntry>> replicaEntries(const std::filesystem::path& folder) {
  const auto names = listFolder(folder);
  if (!names) return fail(names.error());
  std::map<int, ImageSequenceEntry> entries;
  for (const std::string& name : *names) {
    const auto number = numberInName(std::filesystem::path(name).stem().string(), DigitRun::last);
    if (!number) continue;
    if (name.starts_with("depth")) entries[*number].depth = folder / name;
    if (name.starts_with("frame")) entries[*number].color = folder / name;
  }
  std::vector<ImageSequenceEntry> sequence;
  for (auto& [number, entry] : entries) {
    if (entry.depth.empty()) continue;
    entry.index = number;
    entry.timestamp_s = number / kFrameRateHz;
    sequence.push_back(std::move(entry));
  }
  return sequence;
}

/// One pose a line; empty where a line is no rigid motion.
Result<std::vector<std::optional<Eigen::Isometry3d>>> readReplicaPoses(const std::filesystem::path& file) {
  const auto text = readTextFile(file);
  if (!text) return fail(text.error());
  std::vector<std::optional<Eigen::Isometry3d>> poses;
  for (const std::string_view line : splitLines(*text)) {
    if (trimmed(line).empty()) continue;
    const auto values = parseNumbers(line);
    if (!values || values->size() != 16) {
      return fail(file.string() + ": pose " + std::to_string(poses.size()) + " is not a line of 16 numbers.");
    }
    poses.push_back(
        rigidMotion(Eigen::Map<const Eigen::Matrix<double, 4, 4, Eigen::RowMajor>>(values->data())));
  }
  return poses;
}

/// Line i belongs to frame i; where some images were removed, to the frame with number i.
void addReplicaPoses(ImageSequence& sequence, const std::vector<std::optional<Eigen::Isometry3d>>& poses) {
  const bool is_complete = poses.size() == sequence.entries.size();
  std::size_t position = 0;
  for (ImageSequenceEntry& entry : sequence.entries) {
    const std::size_t line = is_complete ? position++ : static_cast<std::size_t>(entry.index);
    if (line >= poses.size()) continue;
    entry.T_world_camera = poses[line];
    sequence.has_poses = sequence.has_poses || poses[line];
  }
}

Result<CameraModel> readReplicaCamera(const std::filesystem::path& file) {
  const auto json = readJson(file);
  if (!json) return fail(json.error());
  try {
    const nlohmann::json& camera = json->at("camera");
    const auto value = [&](const char* name) { return camera.at(name).get<float>(); };
    CameraModel model{
        {value("fx"), value("fy"), value("cx"), value("cy"), camera.value("w", 0), camera.value("h", 0)},
        std::nullopt};
    if (camera.contains("scale")) model.units_per_meter = camera.at("scale").get<double>();
    return model;
  } catch (const nlohmann::json::exception& exception) {
    return fail(file.string() + " is no camera of Replica: " + exception.what() + ".",
                "Correct it, or give --intrinsics fx,fy,cx,cy.");
  }
}

}  // namespace

bool isReplicaFolder(const std::filesystem::path& folder) {
  std::error_code error;
  return std::filesystem::is_regular_file(folder / "traj.txt", error) &&
         hasNumberedFiles(folder / "results", "depth");
}

Result<std::unique_ptr<FrameSource>> openReplicaFolder(const std::filesystem::path& folder,
                                                       const SourceOptions& options) {
  ImageSequence sequence;
  sequence.kind = "Replica";
  sequence.folder = folder;
  sequence.units_per_meter = kReplicaUnitsPerMeter;
  SCANTROVE_TRY(moveInto(sequence.entries, replicaEntries(folder / "results")));
  sequence.has_color = std::ranges::any_of(
      sequence.entries, [](const ImageSequenceEntry& entry) { return !entry.color.empty(); });
  const auto poses = readReplicaPoses(folder / "traj.txt");
  if (!poses) return fail(poses.error());
  addReplicaPoses(sequence, *poses);
  std::error_code error;
  for (const std::filesystem::path& file : {folder / kReplicaParams, parentOf(folder) / kReplicaParams}) {
    if (!std::filesystem::exists(file, error)) continue;
    auto camera = readReplicaCamera(file);
    if (!camera && !options.intrinsics) return fail(camera.error());
    if (camera) sequence.camera = *camera;
    sequence.camera_origin = file.string();
    return openImageSequence(std::move(sequence), options);
  }
  SCANTROVE_TRY(chooseDataSetCamera(sequence, kReplicaCamera, "Replica's", options));
  return openImageSequence(std::move(sequence), options);
}

}  // namespace scantrove
