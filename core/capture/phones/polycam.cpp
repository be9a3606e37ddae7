#include "core/capture/phones/polycam.h"

#include <algorithm>
#include <charconv>
#include <cstdint>

#include "core/capture/folder_listing.h"
#include "core/capture/phones/device_files.h"
#include "core/capture/phones/device_metadata.h"

namespace scantrove {

namespace {

/// T_world_camera of a camera file: t_00 ... t_23, the upper three rows of the matrix.
std::optional<Eigen::Isometry3d> polycamPose(const nlohmann::json& camera) {
  std::array<double, 16> matrix{0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 1};
  for (std::size_t i = 0; i < 12; ++i) {
    const std::string key = "t_" + std::to_string(i / 4) + std::to_string(i % 4);
    const auto value = numberOf(camera, key.c_str());
    if (!value) return std::nullopt;
    matrix[i] = *value;
  }
  return fromArkitAxes(poseFromRows(matrix));
}

std::optional<Intrinsics> polycamIntrinsics(const nlohmann::json& camera) {
  const auto fx = numberOf(camera, "fx"), fy = numberOf(camera, "fy"), cx = numberOf(camera, "cx"),
             cy = numberOf(camera, "cy");
  const auto width = sideOf(camera, "width"), height = sideOf(camera, "height");
  if (!fx || !fy || !cx || !cy || !width || !height) return std::nullopt;
  return Intrinsics{static_cast<float>(*fx),
                    static_cast<float>(*fy),
                    static_cast<float>(*cx),
                    static_cast<float>(*cy),
                    *width,
                    *height};
}

/// File names are microseconds.
std::optional<std::int64_t> timeOf(const std::string& stem) {
  std::int64_t time = 0;
  const auto [stopped, error] = std::from_chars(stem.data(), stem.data() + stem.size(), time);
  return error == std::errc() && stopped == stem.data() + stem.size() ? std::optional(time) : std::nullopt;
}

}  // namespace

bool isPolycamFolder(const std::filesystem::path& folder) {
  const std::filesystem::path frames = folder / "keyframes";
  return isFolder(frames / "depth") &&
         (isFolder(frames / "cameras") || isFolder(frames / "corrected_cameras"));
}

Result<ImageSequence> readPolycamFolder(const std::filesystem::path& folder) {
  const std::filesystem::path frames = folder / "keyframes";
  const bool is_corrected = isFolder(frames / "corrected_cameras") && isFolder(frames / "corrected_images");
  const std::string prefix = is_corrected ? "corrected_" : "";
  const auto names = listFolder(frames / (prefix + "cameras"));
  if (!names) return fail(names.error());
  ImageSequence sequence;
  sequence.kind = "Polycam";
  sequence.folder = folder;
  sequence.has_poses = true;
  sequence.is_color_optional = true;
  sequence.confidences = {0, 127, 255};
  sequence.camera_origin = "the cameras of " + folder.string();
  std::vector<std::pair<std::int64_t, std::string>> stems;
  for (const std::string& name : *names) {
    const std::filesystem::path file(name);
    if (const auto time = timeOf(file.stem().string()); time && file.extension() == ".json")
      stems.emplace_back(*time, file.stem().string());
  }
  std::ranges::sort(stems);
  UnusableFrames unusable;
  for (const auto& [time, stem] : stems) {
    const auto camera = readJson(frames / (prefix + "cameras") / (stem + ".json"));
    if (!camera) {
      unusable.add(camera.error().what);
      continue;
    }
    ImageSequenceEntry entry;
    entry.index = static_cast<int>(sequence.entries.size());
    entry.timestamp_s = static_cast<double>(time) * 1e-6;
    entry.depth = fileIfPresent(frames / "depth" / (stem + ".png"));
    entry.confidence = fileIfPresent(frames / "confidence" / (stem + ".png"));
    entry.color = fileIfPresent(frames / (prefix + "images") / (stem + ".jpg"));
    entry.intrinsics = polycamIntrinsics(*camera);
    entry.T_world_camera = polycamPose(*camera);
    if (!entry.depth.empty() && entry.intrinsics) sequence.entries.push_back(std::move(entry));
  }
  unusable.warn(folderName(folder));
  if (sequence.entries.empty())
    return fail(folder.string() + " has no key frame with depth and a camera.",
                "Scan in LiDAR mode with developer mode on, and export \"Raw data\".");
  return sequence;
}

}  // namespace scantrove
