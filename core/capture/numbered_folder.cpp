#include "core/capture/numbered_folder.h"

#include <spdlog/spdlog.h>

#include <algorithm>
#include <map>

#include "core/base/text.h"
#include "core/capture/folder_listing.h"
#include "core/capture/image_sequence.h"
#include "core/capture/pose_files.h"
#include "core/capture/recorded_poses.h"

namespace scantrove {

namespace {

using FilesByNumber = std::map<int, std::filesystem::path>;

std::optional<std::filesystem::path> findColorFolder(const std::filesystem::path& folder) {
  for (const char* const name : {"color", "image", "rgb"}) {
    std::error_code error;
    if (std::filesystem::is_directory(folder / name, error)) {
      return folder / name;
    }
  }
  return std::nullopt;
}

Result<std::vector<std::filesystem::path>> listImages(const std::filesystem::path& folder) {
  const auto names = listFolder(folder);
  if (!names) {
    return fail(names.error());
  }
  std::vector<std::filesystem::path> images;
  for (const std::string& name : *names) {
    const std::string extension = lowerCase(std::filesystem::path(name).extension().string());
    for (const char* const known : {".png", ".jpg", ".jpeg", ".ppm", ".pgm", ".bmp", ".tif", ".tiff"}) {
      if (extension == known) {
        images.push_back(folder / name);
      }
    }
  }
  if (images.empty()) {
    return fail(folder.string() + " holds no images.",
                "Looked for numbered .png, .jpg, .ppm, .pgm, .bmp and .tif files, one a frame.");
  }
  return images;
}

/// Empty if two files have the same number, or one has none.
std::optional<FilesByNumber> byNumber(const std::vector<std::filesystem::path>& images, DigitRun run) {
  FilesByNumber numbered;
  for (const std::filesystem::path& image : images) {
    const auto number = numberInName(image.stem().string(), run);
    if (!number || !numbered.emplace(*number, image).second) {
      return std::nullopt;
    }
  }
  return numbered;
}

std::vector<ImageSequenceEntry> pairByNumber(const FilesByNumber& depth, const FilesByNumber* color) {
  std::vector<ImageSequenceEntry> entries;
  for (const auto& [number, file] : depth) {
    ImageSequenceEntry entry;
    if (color != nullptr) {
      const auto found = color->find(number);
      if (found == color->end()) {
        continue;
      }
      entry.color = found->second;
    }
    entry.index = number;
    entry.timestamp_s = number / kFrameRateHz;
    entry.depth = file;
    entries.push_back(std::move(entry));
  }
  return entries;
}

Result<std::vector<ImageSequenceEntry>> pairImages(const std::filesystem::path& folder,
                                                   const std::optional<std::filesystem::path>& color_folder) {
  const auto depth_images = listImages(folder / "depth");
  if (!depth_images) {
    return fail(depth_images.error());
  }
  std::vector<std::filesystem::path> color_images;
  if (color_folder) {
    auto listed = listImages(*color_folder);
    if (!listed) {
      return fail(listed.error());
    }
    color_images = std::move(*listed);
  }
  for (const DigitRun run : {DigitRun::last, DigitRun::first}) {
    const auto depth = byNumber(*depth_images, run);
    const auto color = byNumber(color_images, run);
    if (!depth || !color) {
      continue;
    }
    auto entries = pairByNumber(*depth, color_folder ? &*color : nullptr);
    if (entries.empty()) {
      continue;
    }
    const std::size_t left_out = std::max(depth_images->size(), color_images.size()) - entries.size();
    if (color_folder && left_out > 0) {
      spdlog::warn("{}: {} colour and {} depth images; using the {} numbers that both have.",
                   folderName(folder), color_images.size(), depth_images->size(), entries.size());
    }
    return entries;
  }
  return fail(folder.string() +
                  ": colour and depth images cannot be paired by the numbers in their names (such as " +
                  depth_images->front().filename().string() +
                  (color_images.empty() ? "" : " and " + color_images.front().filename().string()) + ").",
              "Name them by the frame's number, e.g. color/000012.jpg and depth/000012.png.");
}

/// The log counts frames as the files do, or from 0 while the files start elsewhere.
void addPoses(ImageSequence& sequence, const std::vector<NumberedPose>& poses) {
  std::map<int, const NumberedPose*> by_number;
  for (const NumberedPose& pose : poses) {
    by_number.emplace(pose.number, &pose);
  }
  const bool has_file_numbers =
      by_number.contains(sequence.entries.front().index) && by_number.contains(sequence.entries.back().index);
  int position = 0;
  for (ImageSequenceEntry& entry : sequence.entries) {
    if (const auto pose = by_number.find(has_file_numbers ? entry.index : position);
        pose != by_number.end()) {
      entry.T_world_camera = pose->second->T_world_camera;
    }
    ++position;
  }
}

}  // namespace

bool isNumberedFolder(const std::filesystem::path& folder) {
  std::error_code error;
  return std::filesystem::is_directory(folder / "depth", error);
}

std::optional<int> numberInName(const std::string& stem, DigitRun run) {
  constexpr const char* kDigits = "0123456789";
  std::size_t begin = 0;
  std::size_t end = 0;
  if (run == DigitRun::first) {
    begin = stem.find_first_of(kDigits);
    if (begin == std::string::npos) {
      return std::nullopt;
    }
    end = std::min(stem.find_first_not_of(kDigits, begin), stem.size());
  } else {
    const std::size_t last = stem.find_last_of(kDigits);
    if (last == std::string::npos) {
      return std::nullopt;
    }
    end = last + 1;
    const std::size_t before = stem.find_last_not_of(kDigits, last);
    begin = before == std::string::npos ? 0 : before + 1;
  }
  return parseFrameNumber(std::string_view(stem).substr(begin, end - begin));
}

Result<std::unique_ptr<FrameSource>> openNumberedFolder(const std::filesystem::path& folder,
                                                        const SourceOptions& options) {
  const auto color_folder = findColorFolder(folder);
  auto entries = pairImages(folder, color_folder);
  if (!entries) {
    return fail(entries.error());
  }
  ImageSequence sequence;
  sequence.kind = "numbered images";
  sequence.folder = folder;
  sequence.entries = std::move(*entries);
  sequence.has_color = color_folder.has_value();
  auto camera = findIntrinsics(folder);
  if (!camera && !options.intrinsics) {
    return fail(camera.error());
  }
  if (camera && *camera) {
    sequence.camera = **camera;
    sequence.camera_origin = "from the file in " + folder.string();
  } else {
    sequence.camera = CameraModel{kPrimeSenseIntrinsics, std::nullopt};
    sequence.camera_origin = "default";
    if (!options.intrinsics) {
      spdlog::warn(
          "{}: no intrinsics given and none found (camera-intrinsics.txt, intrinsic.json, "
          "camera_intrinsic.json); "
          "using 525,525,319.5,239.5 at 640x480. Give the right ones with --intrinsics fx,fy,cx,cy.",
          folderName(folder));
    }
  }
  if (const auto log = findTrajectoryLog(folder)) {
    const auto poses = readTrajectoryLog(*log);
    if (!poses) {
      return fail(poses.error());
    }
    sequence.has_poses = !poses->empty();
    addPoses(sequence, *poses);
  }
  return openImageSequence(std::move(sequence), options);
}

}  // namespace scantrove
