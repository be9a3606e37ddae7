#pragma once
#include <filesystem>
#include <map>
#include <optional>
#include <string>

#include "core/base/result.h"
#include "core/exchange/coco_masks.h"
#include "core/exchange/image_masks.h"

namespace scantrove {

/// Masks of frames that another program made: label images or one COCO file.
class MaskFolder {
 public:
  /// Label images are PNGs of one channel (0 = none, each other value is one mask). A folder without numbered
  /// PNGs holds one .json file in COCO's format. The last number in the name of a PNG, or in the file_name of
  /// a COCO image, is the number of its frame. Error: `folder` is no folder or cannot be read; no such files,
  /// several JSON files, or two images of one number; a damaged COCO file, or one without a mask.
  [[nodiscard]] static Result<MaskFolder> open(const std::filesystem::path& folder);

  [[nodiscard]] bool has(int frame) const { return files_.contains(frame) || places_.contains(frame); }
  /// Images with a number.
  [[nodiscard]] std::size_t imageCount() const { return files_.size() + places_.size(); }
  /// The masks of a frame that it has. Error: the PNG is missing, damaged, or not of one channel.
  [[nodiscard]] Result<ImageMasks> masksOfFrame(int frame) const;
  /// The image of a frame, for messages.
  [[nodiscard]] std::string nameOf(int frame) const;
  [[nodiscard]] const std::filesystem::path& path() const { return folder_; }

 private:
  [[nodiscard]] Result<void> listImages();
  [[nodiscard]] Result<void> readCoco(const std::filesystem::path& file);

  std::filesystem::path folder_;
  std::map<long, std::filesystem::path> files_;  // label images
  std::map<long, std::size_t> places_;           // in coco_
  CocoMasks coco_;
};

}  // namespace scantrove
