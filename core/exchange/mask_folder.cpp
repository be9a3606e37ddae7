#include "core/exchange/mask_folder.h"

#include <system_error>
#include <utility>
#include <vector>

#include "core/base/text.h"
#include "core/base/text_file.h"
#include "core/exchange/label_image_writer.h"

namespace scantrove {
namespace {

constexpr const char* kNames = "Name masks by their frames, as an export does: 000120.png.";

tl::unexpected<Error> sameNumber(const std::string& one, const std::string& other) {
  return fail(one + " and " + other + " have the same number.",
              "Give the masks of one scan, one image a frame.");
}

}  // namespace

Result<MaskFolder> MaskFolder::open(const std::filesystem::path& folder) {
  MaskFolder masks;
  masks.folder_ = folder;
  SCANTROVE_TRY(masks.listImages());
  return masks;
}

Result<void> MaskFolder::listImages() {
  std::vector<std::filesystem::path> lists;
  try {
    if (!std::filesystem::is_directory(folder_))
      return fail(folder_.string() + " is not a folder.", "Give a folder of masks.");
    for (const std::filesystem::directory_entry& entry : std::filesystem::directory_iterator(folder_)) {
      const std::filesystem::path& file = entry.path();
      if (file.extension() == ".json") lists.push_back(file);
      const std::optional<long> number = lastNumber(file.stem().string());
      if (file.extension() != ".png" || !number) continue;
      if (const auto [known, is_new] = files_.emplace(*number, file); !is_new)
        return sameNumber(known->second.string(), file.string());
    }
  } catch (const std::filesystem::filesystem_error& error) {
    return fail("Cannot read " + error.path1().string() + ": " + error.code().message() + ".");
  }
  if (!files_.empty()) return {};
  if (lists.empty())
    return fail(folder_.string() + " holds no masks: neither numbered PNGs nor a JSON file.", kNames);
  if (lists.size() > 1)
    return fail(folder_.string() + " holds " + std::to_string(lists.size()) + " JSON files.",
                "Keep one COCO file there.");
  return readCoco(lists.front());
}

Result<void> MaskFolder::readCoco(const std::filesystem::path& file) {
  const Result<std::string> text = readTextFile(file);
  if (!text) return fail(text.error());
  SCANTROVE_TRY(moveInto(coco_, CocoMasks::parse(*text, file.string())));
  bool has_masks = false;
  for (std::size_t image = 0; image < coco_.imageCount(); ++image) {
    has_masks = has_masks || coco_.hasMasks(image);
    const std::optional<long> number =
        lastNumber(std::filesystem::path(coco_.fileName(image)).stem().string());
    if (!number) continue;
    if (const auto [known, is_new] = places_.emplace(*number, image); !is_new)
      return sameNumber(coco_.fileName(known->second), coco_.fileName(image));
  }
  if (!has_masks) return fail(file.string() + " holds no mask.", "Write annotations with a segmentation.");
  if (places_.empty())
    return fail("No image in " + file.string() + " has a number in its file_name.", kNames);
  return {};
}

Result<ImageMasks> MaskFolder::masksOfFrame(int frame) const {
  if (const auto place = places_.find(frame); place != places_.end())
    return coco_.masksOfImage(place->second);
  const Result<cv::Mat> labels = readLabelImage(files_.at(frame));
  if (!labels) return fail(labels.error());
  return masksOf(*labels);
}

std::string MaskFolder::nameOf(int frame) const {
  const auto place = places_.find(frame);
  return place != places_.end() ? coco_.fileName(place->second) : files_.at(frame).string();
}

}  // namespace scantrove
