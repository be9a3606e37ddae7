#include "core/capture/tum_folder.h"

#include <spdlog/spdlog.h>

#include <algorithm>
#include <array>
#include <cmath>

#include "core/base/text.h"
#include "core/base/text_file.h"
#include "core/capture/folder_listing.h"
#include "core/capture/image_sequence.h"
#include "core/capture/pose_files.h"
#include "core/capture/recorded_poses.h"
#include "core/capture/time_association.h"
#include "core/capture/time_unit.h"

namespace scantrove {

namespace {

constexpr double kPairTolerance_s = 0.02;
constexpr double kTumUnitsPerMeter = 5000;
constexpr const char* kBonnKind = "Bonn RGB-D";
/// TUM's calibrations; the third camera's recordings are already undistorted.
struct FreiburgCamera {
  Intrinsics K;
  std::optional<LensDistortion> lens;
};
constexpr std::array<FreiburgCamera, 3> kFreiburg = {
    {{{517.3F, 516.5F, 318.6F, 255.3F, 640, 480}, LensDistortion{0.2624, -0.9531, -0.0054, 0.0026, 1.1633}},
     {{520.9F, 521.0F, 325.1F, 249.7F, 640, 480}, LensDistortion{0.2312, -0.7849, -0.0033, -0.0001, 0.9172}},
     {{535.4F, 539.2F, 320.1F, 247.6F, 640, 480}, std::nullopt}}};

/// The camera of the Bonn RGB-D Dynamic data set, from its page.
constexpr FreiburgCamera kBonn{{542.822841F, 542.576870F, 315.593520F, 237.756098F, 640, 480},
                               LensDistortion{0.039903, -0.099343, -0.000730, -0.000144, 0}};

/// Contents of `rgb.txt` or `depth.txt`.
struct ImageList {
  TimeUnit unit;  ///< of the times in the file
  std::vector<double> times_s;
  std::vector<std::filesystem::path> files;
  std::string comments;
};

Result<ImageList> readImageList(const std::filesystem::path& file) {
  const Result<std::string> text = readTextFile(file);
  if (!text) {
    return fail(text.error());
  }
  std::vector<std::pair<double, std::filesystem::path>> images;
  ImageList list;
  int line_number = 0;
  for (const std::string_view raw_line : splitLines(*text)) {
    ++line_number;
    const std::string_view line = trimmed(raw_line);
    if (line.empty() || line.front() == '#') {
      list.comments += std::string(line) + '\n';
      continue;
    }
    const std::size_t blank = line.find_first_of(" \t,");
    const auto time = parseNumbers(line.substr(0, blank));
    if (blank == std::string_view::npos || !time || time->size() != 1 || !std::isfinite(time->front())) {
      return fail(file.string() + ", line " + std::to_string(line_number) + " is not `timestamp filename`.");
    }
    images.emplace_back(time->front(), file.parent_path() / trimmed(line.substr(blank + 1)));
  }
  std::stable_sort(images.begin(), images.end(),
                   [](const auto& a, const auto& b) { return a.first < b.first; });
  for (auto& [time, image] : images) {
    list.times_s.push_back(time);
    list.files.push_back(std::move(image));
  }
  list.unit = unitOfImageTimes(list.times_s);
  for (double& time : list.times_s) time *= list.unit.seconds;
  return list;
}

/// Index of the TUM camera that a text names, 0 based; empty if none.
std::optional<std::size_t> freiburgCamera(const std::string& text) {
  const std::string lower = lowerCase(text);
  for (std::size_t camera = 0; camera < kFreiburg.size(); ++camera) {
    const std::string number = std::to_string(camera + 1);
    for (const std::string& name :
         {"freiburg" + number, "fr" + number + "/", "fr" + number + "_", "fr" + number + "-"}) {
      if (lower.find(name) != std::string::npos) {
        return camera;
      }
    }
  }
  return std::nullopt;
}

void chooseFreiburgCamera(ImageSequence& sequence, const std::string& comments, bool is_given) {
  auto camera = freiburgCamera(folderName(sequence.folder) + "/");
  if (!camera) {
    camera = freiburgCamera(comments);
  }
  if (!camera && !is_given) {
    spdlog::warn(
        "{}: nothing says which camera recorded this TUM folder; using the intrinsics of freiburg1. "
        "Give the right ones with --intrinsics fx,fy,cx,cy.",
        folderName(sequence.folder));
  }
  const std::size_t chosen = camera.value_or(0);
  sequence.camera = CameraModel{
      .K = kFreiburg[chosen].K, .units_per_meter = {}, .color = {}, .lens = kFreiburg[chosen].lens};
  sequence.camera_origin = "TUM freiburg" + std::to_string(chosen + 1);
}

/// Whether a text names the Bonn data set.
bool isOfBonn(const std::string& text) { return lowerCase(text).find("rgbd_bonn") != std::string::npos; }

/// The ground truth of the Bonn data set is that of markers on the camera, in other axes.
void dropMarkerPoses(ImageSequence& sequence) {
  if (!sequence.has_poses) return;
  sequence.has_poses = false;
  for (ImageSequenceEntry& entry : sequence.entries) entry.T_world_camera.reset();
  spdlog::info("{}: its groundtruth.txt has the poses of markers, not of the camera; it is not used here.",
               folderName(sequence.folder));
}

/// The camera of a file in the folder, else the TUM camera that a name mentions.
Result<void> chooseCamera(ImageSequence& sequence, const std::string& comments, bool is_given) {
  auto camera = findIntrinsics(sequence.folder);
  if (!camera && !is_given) return fail(camera.error());
  if (camera && *camera) {
    sequence.camera = **camera;
    sequence.camera_origin = "from the file of " + sequence.folder.string();
  } else if (sequence.kind == kBonnKind) {
    sequence.camera = CameraModel{.K = kBonn.K, .units_per_meter = {}, .color = {}, .lens = kBonn.lens};
    sequence.camera_origin = "the Bonn data set's";
  } else {
    chooseFreiburgCamera(sequence, comments, is_given);
  }
  return {};
}

/// Warns where times are not in seconds.
void nameUnits(const std::filesystem::path& folder, const ImageList& depth,
               const std::optional<ImageList>& color) {
  const TimeUnit unit = depth.unit == TimeUnit() && color ? color->unit : depth.unit;
  if (unit == TimeUnit()) return;
  const bool is_of_both = color && color->unit == depth.unit;
  const char* const files = is_of_both           ? "rgb.txt and depth.txt"
                            : unit == depth.unit ? "depth.txt"
                                                 : "rgb.txt";
  spdlog::warn("{}: by their spacing, the times in {} are {}.", folderName(folder), files, unit.name);
}

Result<void> addPoses(ImageSequence& sequence, const TimeUnit& unit_of_images) {
  const std::filesystem::path file = sequence.folder / "groundtruth.txt";
  std::error_code error;
  if (!std::filesystem::exists(file, error)) return {};
  auto poses = readTumTrajectory(file);
  if (!poses) return fail(poses.error());
  const TimeUnit unit = unitOfPosesOfImages(*poses, sequence.entries.front().timestamp_s,
                                            sequence.entries.back().timestamp_s, unit_of_images);
  for (StampedPose& pose : *poses) pose.timestamp_s *= unit.seconds;
  sequence.has_poses = true;
  for (ImageSequenceEntry& entry : sequence.entries) entry.T_world_camera = poseAt(*poses, entry.timestamp_s);
  return {};
}

Result<std::vector<ImageSequenceEntry>> pairImages(const std::filesystem::path& folder,
                                                   const ImageList& depth,
                                                   const std::optional<ImageList>& color) {
  std::vector<ImageSequenceEntry> entries;
  const auto add = [&](std::size_t i) -> ImageSequenceEntry& {
    ImageSequenceEntry& entry = entries.emplace_back();
    entry.index = static_cast<int>(entries.size()) - 1;
    entry.timestamp_s = depth.times_s[i];
    entry.depth = depth.files[i];
    return entry;
  };
  if (!color) {
    for (std::size_t i = 0; i < depth.files.size(); ++i) {
      add(i);
    }
  } else {
    for (const auto& [i, j] : associateTimes(depth.times_s, color->times_s, kPairTolerance_s)) {
      add(i).color = color->files[j];
    }
  }
  if (entries.empty()) {
    return fail(folder.string() + ": no depth image can be paired with a colour image within 0.02 s (" +
                    std::to_string(depth.files.size()) + " lines in depth.txt, " +
                    std::to_string(color ? color->files.size() : 0) + " in rgb.txt).",
                "Check that both lists use the same clock.");
  }
  return entries;
}

}  // namespace

bool isTumFolder(const std::vector<std::string>& names) {
  return std::find(names.begin(), names.end(), "depth.txt") != names.end();
}

Result<std::unique_ptr<FrameSource>> openTumFolder(const std::filesystem::path& folder,
                                                   const SourceOptions& options) {
  const auto depth = readImageList(folder / "depth.txt");
  if (!depth) {
    return fail(depth.error());
  }
  std::error_code error;
  std::optional<ImageList> color;
  if (std::filesystem::exists(folder / "rgb.txt", error)) {
    auto list = readImageList(folder / "rgb.txt");
    if (!list) {
      return fail(list.error());
    }
    color = std::move(*list);
  }
  ImageSequence sequence;
  sequence.kind = "TUM RGB-D";
  sequence.folder = folder;
  sequence.has_color = color.has_value();
  sequence.units_per_meter = kTumUnitsPerMeter;
  auto entries = pairImages(folder, *depth, color);
  if (!entries) {
    return fail(entries.error());
  }
  sequence.entries = std::move(*entries);
  nameUnits(folder, *depth, color);
  SCANTROVE_TRY(addPoses(sequence, depth->unit));
  const std::string comments = depth->comments + (color ? color->comments : "");
  if (isOfBonn(folderName(folder) + comments)) {
    sequence.kind = kBonnKind;
    dropMarkerPoses(sequence);
  }
  SCANTROVE_TRY(chooseCamera(sequence, comments, options.intrinsics.has_value()));
  return openImageSequence(std::move(sequence), options);
}

}  // namespace scantrove
