#include "core/capture/containers/open_container.h"

#include "core/base/regular_file.h"
#include "core/capture/containers/container_source.h"
#include "core/capture/containers/decompression.h"
#include "core/capture/containers/kinect_recording.h"
#include "core/capture/containers/mcap_file.h"
#include "core/capture/containers/message_recording.h"
#include "core/capture/containers/ros_bag.h"
#include "core/capture/containers/rosbag2_database.h"
#include "core/capture/folder_listing.h"

namespace scantrove {

namespace {

constexpr std::size_t kContainerStartBytes = 64;

ByteView containerView(const std::string& text) {
  return {reinterpret_cast<const std::uint8_t*>(text.data()), text.size()};
}

Result<std::unique_ptr<ContainerImages>> openImages(const std::filesystem::path& file, ContainerFormat format,
                                                    const SourceOptions& options) {
  OpeningProgress progress(file.filename().string(), options);
  if (format == ContainerFormat::matroska) {
    Result<std::unique_ptr<MatroskaFile>> matroska = MatroskaFile::open(file, progress);
    if (!matroska) return fail(matroska.error());
    return openKinectRecording(std::move(*matroska));
  }
  const bool is_bag = format == ContainerFormat::ros_bag, is_mcap = format == ContainerFormat::mcap;
  Result<std::unique_ptr<MessageFile>> messages = is_bag    ? openRosBag(file, progress)
                                                  : is_mcap ? openMcap(file, progress)
                                                            : openRosbag2Database(file, progress);
  if (!messages) return fail(messages.error());
  return openMessageRecording(std::move(*messages),
                              is_bag    ? "ROS bag"
                              : is_mcap ? "MCAP"
                                        : "ROS 2 bag",
                              options);
}

}  // namespace

Result<std::optional<ContainerFormat>> containerFormat(const std::filesystem::path& file) {
  const Result<std::string> start = readFile(file, kContainerStartBytes);
  if (!start) return fail(start.error());
  const ByteView bytes = containerView(*start);
  if (isRosBag(bytes)) return std::optional(ContainerFormat::ros_bag);
  if (isSqlite(bytes)) return std::optional(ContainerFormat::rosbag2_database);
  if (isMcap(bytes)) return std::optional(ContainerFormat::mcap);
  if (isMatroska(bytes)) return std::optional(ContainerFormat::matroska);
  return std::optional<ContainerFormat>();
}

Result<std::unique_ptr<FrameSource>> openContainer(const std::filesystem::path& file, ContainerFormat format,
                                                   const SourceOptions& options) {
  if (lowerCase(file.extension().string()) == ".svo2") {  // MCAP with video that only the maker's SDK decodes
    return fail(file.string() + " is not a recording in a supported format.", adviceForContainer(file));
  }
  Result<std::unique_ptr<ContainerImages>> images = openImages(file, format, options);
  if (!images) return fail(images.error());
  return openContainerSource(std::move(*images), file, options);
}

std::string adviceForContainer(const std::filesystem::path& file) {
  const std::string end = lowerCase(file.extension().string());
  if (end == ".svo" || end == ".svo2") {
    return "Export it with Stereolabs' ZED_SVO_Export, mode 4 (left image and 16-bit depth), sort the files "
           "into folders color and depth, and open the folder of both with --intrinsics.";
  }
  if (end == ".xef") {
    return "Kinect Studio's raw files are read by Microsoft's SDK only: record a Kinect v2 with iai_kinect2 "
           "to a ROS bag (topics hd/image_color_rect and hd/image_depth_rect), and open that.";
  }
  const Result<std::string> start = readFile(file, kContainerStartBytes);
  const ByteView bytes = start ? containerView(*start) : ByteView();
  if (isZstd(bytes)) return "It is compressed as a whole: unpack it with `zstd -d`, and open the result.";
  if (start && start->substr(0, 8).ends_with("ftyp")) {
    return "A video holds no depth: record an OAK camera with DepthAI's recorder to an MCAP or ROS 2 file "
           "with depth, and open that; of a phone's recording, open the folder.";
  }
  return {};
}

Result<std::optional<std::filesystem::path>> rosbag2FileIn(const std::filesystem::path& folder) {
  std::error_code error;
  std::optional<std::filesystem::path> found;
  if (!std::filesystem::is_regular_file(folder / "metadata.yaml", error)) return found;
  const auto names = listFolder(folder);
  if (!names) return fail(names.error());
  for (const std::string& name : *names) {
    const std::string end = lowerCase(std::filesystem::path(name).extension().string());
    if (end != ".db3" && end != ".mcap") continue;
    if (found) {
      return fail(
          "The recording in " + folder.string() + " has several files.",
          "Open the first, " + found->string() + ", and continue the scan with the others (--resume).");
    }
    found = folder / name;
  }
  return found;
}

}  // namespace scantrove
