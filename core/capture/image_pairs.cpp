#include "core/capture/image_pairs.h"

#include <algorithm>
#include <array>
#include <utility>

#include "core/capture/folder_listing.h"
#include "core/capture/image_sequence.h"

namespace scantrove {
namespace {

constexpr std::string_view kDepthEnd = "-depth.png";
constexpr std::array<const char*, 3> kColorEnds{"-color.png", "-color.jpg", "-color.jpeg"};

std::filesystem::path colorOf(const std::filesystem::path& folder, const std::string& name) {
  for (const char* end : kColorEnds) {
    std::error_code ignored;
    if (std::filesystem::path file = folder / (name + end); std::filesystem::is_regular_file(file, ignored))
      return file;
  }
  return {};
}

}  // namespace

Result<ImagePairs> openImagePairs(const std::filesystem::path& folder, const SourceOptions& options) {
  Result<std::vector<std::string>> files = listFolder(folder);
  if (!files) return fail(files.error());
  ImagePairs pairs;
  ImageSequence sequence;
  sequence.kind = "image pairs";
  sequence.folder = folder;
  for (const std::string& file : *files) {
    if (!file.ends_with(kDepthEnd)) continue;
    std::string name = file.substr(0, file.size() - kDepthEnd.size());
    ImageSequenceEntry entry;
    entry.index = static_cast<int>(pairs.names.size());
    entry.timestamp_s = entry.index;
    entry.depth = folder / file;
    entry.color = colorOf(folder, name);
    if (entry.color.empty()) continue;
    sequence.entries.push_back(std::move(entry));
    pairs.names.push_back(std::move(name));
  }
  if (pairs.names.empty()) {
    return fail(
        "The folder " + folder.string() + " holds no pair NAME-color.png (or .jpg) and NAME-depth.png.",
        "Name the images so, with depth in millimetres.");
  }
  const auto camera = findIntrinsics(folder);
  if (!camera) return fail(camera.error());
  sequence.camera = camera->value_or(CameraModel{kPrimeSenseIntrinsics, std::nullopt});
  sequence.camera_origin = *camera ? "from the file in " + folder.string() : "default";
  SCANTROVE_TRY(moveInto(pairs.frames, openImageSequence(std::move(sequence), options)));
  return pairs;
}

}  // namespace scantrove
