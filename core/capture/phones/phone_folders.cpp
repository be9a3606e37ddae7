#include "core/capture/phones/phone_folders.h"

#include <spdlog/spdlog.h>

#include <algorithm>
#include <array>

#include "core/capture/folder_listing.h"
#include "core/capture/image_sequence.h"
#include "core/capture/phones/arkit_scenes.h"
#include "core/capture/phones/lidar_shots.h"
#include "core/capture/phones/multiscan.h"
#include "core/capture/phones/polycam.h"
#include "core/capture/phones/record3d.h"
#include "core/capture/phones/scanner_app_3d.h"
#include "core/capture/phones/scannetpp_iphone.h"
#include "core/capture/phones/stray_scanner.h"
#include "core/capture/phones/transforms_json.h"

namespace scantrove {

namespace {

using Folder = std::filesystem::path;
using Names = std::vector<std::string>;

struct PhoneFormat {
  bool (*is)(const Folder& folder, const Names& names);
  Result<ImageSequence> (*read)(const Folder& folder, const Names& names);
};

/// A transforms.json is the last but one: other recordings may have one beside their own files.
constexpr std::array<PhoneFormat, 9> kPhoneFormats{{
    {isStrayScannerFolder, [](const Folder& folder, const Names&) { return readStrayScannerFolder(folder); }},
    {[](const Folder& folder, const Names&) { return isPolycamFolder(folder); },
     [](const Folder& folder, const Names&) { return readPolycamFolder(folder); }},
    {[](const Folder&, const Names& names) { return isMultiscanFolder(names); }, readMultiscanFolder},
    {[](const Folder& folder, const Names&) { return isScannetppFolder(folder); },
     [](const Folder& folder, const Names&) { return readScannetppFolder(folder); }},
    {[](const Folder& folder, const Names&) { return isArkitScenesFolder(folder); },
     [](const Folder& folder, const Names&) { return readArkitScenesFolder(folder); }},
    {[](const Folder& folder, const Names&) { return isRecord3dFolder(folder); },
     [](const Folder& folder, const Names&) { return readRecord3dFolder(folder); }},
    {isScannerApp3dFolder, readScannerApp3dFolder},
    {[](const Folder& folder, const Names&) { return isTransformsFolder(folder); },
     [](const Folder& folder, const Names&) { return readTransformsFolder(folder); }},
    {isLidarShotsFolder, readLidarShotsFolder},
}};

const PhoneFormat* formatOf(const Folder& folder, const Names& names) {
  const auto found = std::ranges::find_if(
      kPhoneFormats, [&](const PhoneFormat& format) { return format.is(folder, names); });
  return found == kPhoneFormats.end() ? nullptr : &*found;
}

Result<std::unique_ptr<FrameSource>> openRead(Result<ImageSequence> sequence, const SourceOptions& options) {
  if (!sequence) return fail(sequence.error());
  sequence->pose_origin = PoseOrigin::device;
  if (sequence->camera_origin == "default" && !options.intrinsics)
    spdlog::warn(
        "{}: no file gives its camera; using that of a usual phone. Give the right one with --intrinsics "
        "fx,fy,cx,cy, in pixels of the depth images.",
        folderName(sequence->folder));
  return openImageSequence(std::move(*sequence), options);
}

}  // namespace

bool isPhoneFolder(const std::filesystem::path& folder, const std::vector<std::string>& names) {
  return formatOf(folder, names) != nullptr;
}

Result<std::unique_ptr<FrameSource>> openPhoneFolder(const std::filesystem::path& folder,
                                                     const std::vector<std::string>& names,
                                                     const SourceOptions& options) {
  const PhoneFormat* const format = formatOf(folder, names);
  if (format == nullptr) return fail(folder.string() + " is no recording of a phone.");
  return openRead(format->read(folder, names), options);
}

Result<std::unique_ptr<FrameSource>> openRecord3dFile(const std::filesystem::path& file,
                                                      const SourceOptions& options) {
  return openRead(readRecord3dFile(file), options);
}

}  // namespace scantrove
