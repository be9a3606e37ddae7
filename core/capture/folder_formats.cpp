#include "core/capture/folder_formats.h"

#include <spdlog/spdlog.h>

#include "core/capture/bop_scene.h"
#include "core/capture/containers/open_container.h"
#include "core/capture/folder_listing.h"
#include "core/capture/foundation_pose_folder.h"
#include "core/capture/icl_nuim.h"
#include "core/capture/numbered_folder.h"
#include "core/capture/nyu_raw_folder.h"
#include "core/capture/phones/phone_folders.h"
#include "core/capture/replica_folder.h"
#include "core/capture/scannet_folder.h"
#include "core/capture/scenenn_folder.h"
#include "core/capture/sens_file.h"
#include "core/capture/seven_scenes.h"
#include "core/capture/tum_folder.h"

namespace scantrove {
namespace {

using Folder = std::filesystem::path;
using Names = std::vector<std::string>;
using OpenedFolder = Result<std::unique_ptr<FrameSource>>;

template <bool (*fits)(const Folder&)>
bool fitsFolder(const Folder& folder, const Names&) {
  return fits(folder);
}

template <bool (*fits)(const Names&)>
bool fitsNames(const Folder&, const Names& names) {
  return fits(names);
}

template <OpenedFolder (*open)(const Folder&, const SourceOptions&)>
OpenedFolder openByFolder(const Folder& folder, const Names&, const SourceOptions& options) {
  return open(folder, options);
}

bool fitsBop(const Folder& folder, const Names&) { return findBopScene(folder).has_value(); }

/// The only .sens file among the names; empty: none, or several.
std::string onlySensFile(const Names& names) {
  std::string only;
  for (const std::string& name : names) {
    if (lowerCase(Folder(name).extension().string()) != ".sens") continue;
    if (!only.empty()) return {};
    only = name;
  }
  return only;
}

bool fitsSens(const Folder&, const Names& names) { return !onlySensFile(names).empty(); }

OpenedFolder openSensIn(const Folder& folder, const Names& names, const SourceOptions& options) {
  return openSensFile(folder / onlySensFile(names), options);
}

bool fitsFoundationPose(const Folder& folder, const Names& names) {
  return isFoundationPoseFolder(folder) && !isTumFolder(names);  // TUM's lists say how the images pair
}

bool fitsRosbag2(const Folder& folder, const Names&) {
  const auto file = rosbag2FileIn(folder);
  return !file || *file;  // opening says what is wrong
}

OpenedFolder openRosbag2In(const Folder& folder, const Names&, const SourceOptions& options) {
  const auto file = rosbag2FileIn(folder);
  if (!file) return fail(file.error());
  if (!*file) return fail("The recording in " + folder.string() + " is gone.", "Was a drive unplugged?");
  const auto format = containerFormat(**file);
  if (!format) return fail(format.error());
  if (!*format) return fail((*file)->string() + " is no ROS 2 recording.");
  return openContainer(**file, **format, options);
}

}  // namespace

const std::vector<FolderFormat>& folderFormats() {
  static const std::vector<FolderFormat> formats{
      {"7-Scenes, BundleFusion or 3RScan", fitsNames<isSevenScenesFolder>, openSevenScenes},
      {"BOP", fitsBop, openByFolder<openBopScene>},
      {"ScanNet", fitsFolder<isScannetFolder>, openByFolder<openScannetFolder>},
      {"Replica", fitsFolder<isReplicaFolder>, openByFolder<openReplicaFolder>},
      {"ICL-NUIM", isIclNuimFolder, openIclNuimFolder},
      {"TUM RGB-D", fitsNames<isTumFolder>, openByFolder<openTumFolder>},
      {"NYUv2 raw", fitsNames<isNyuRawFolder>, openNyuRawFolder},
      {"SceneNN", fitsFolder<isSceneNnFolder>, openByFolder<openSceneNnFolder>},
      {"FoundationPose", fitsFoundationPose, openByFolder<openFoundationPoseFolder>},
      {".sens file", fitsSens, openSensIn},
      {"ROS 2 recording", fitsRosbag2, openRosbag2In},
      {"a phone's recording", isPhoneFolder, openPhoneFolder},
      {"numbered images", fitsFolder<isNumberedFolder>, openByFolder<openNumberedFolder>},
  };
  return formats;
}

const FolderFormat* findFolderFormat(const std::filesystem::path& folder,
                                     const std::vector<std::string>& names) {
  const std::vector<FolderFormat>& formats = folderFormats();
  const FolderFormat* found = nullptr;
  for (const FolderFormat& format : formats) {
    const bool is_general = &format == &formats.back();
    if ((found != nullptr && is_general) || !format.fits(folder, names)) continue;
    if (found != nullptr) {
      spdlog::warn("{} fits two formats, {} and {}; it is opened as {}.", folder.string(), found->name,
                   format.name, found->name);
      break;
    }
    found = &format;
  }
  return found;
}

}  // namespace scantrove
