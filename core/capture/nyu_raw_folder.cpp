#include "core/capture/nyu_raw_folder.h"

#include <algorithm>
#include <cstdint>
#include <optional>
#include <utility>

#include "core/capture/image_sequence.h"
#include "core/capture/nyu_projection.h"
#include "core/capture/nyu_raw_names.h"
#include "core/image/image_file.h"

namespace scantrove {
namespace {

constexpr std::uint16_t kLargestRaw = 2047;  // a Kinect v1 has 11 bits

/// Decodes images of one folder. Their projection is prepared with the first one, whose size decides.
class NyuDecoder {
 public:
  Result<cv::Mat> depth(const std::filesystem::path& file) {
    Result<cv::Mat> stored = readGrayImage(file);
    if (!stored) return stored;
    if (stored->type() != CV_16UC1)
      return fail(file.string() + " is no 16-bit image with one channel, as raw depth of NYUv2 is.");
    cv::Mat1w raw = *stored;
    for (std::uint16_t& value : raw) value = static_cast<std::uint16_t>(value << 8 | value >> 8);
    if (std::ranges::any_of(raw, [](std::uint16_t value) { return value > kLargestRaw; })) {
      return fail(file.string() + " has values above 2047, which a Kinect does not give.",
                  "Scantrove reads the data set's own files, whose bytes are swapped.");
    }
    const auto projection = projectionFor(file, raw.size());
    if (!projection) return fail(projection.error());
    return (*projection)->depth(raw);
  }

  Result<cv::Mat> color(const std::filesystem::path& file) {
    Result<cv::Mat> image = readColorImage(file);
    if (!image) return image;
    const auto projection = projectionFor(file, image->size());
    if (!projection) return fail(projection.error());
    return (*projection)->color(*image);
  }

 private:
  Result<const NyuProjection*> projectionFor(const std::filesystem::path& file, const cv::Size& size) {
    const auto text = [](const cv::Size& s) {
      return std::to_string(s.width) + "x" + std::to_string(s.height);
    };
    if (size.width * 3 != size.height * 4 || size.width > 640)
      return fail(file.string() + " is " + text(size) + "; images of NYUv2 are 640x480.");
    if (!projection_) projection_.emplace(size);
    if (projection_->size() != size)
      return fail(file.string() + " is " + text(size) + ", the first frame " + text(projection_->size()) +
                  ".");
    return &*projection_;
  }

  std::optional<NyuProjection> projection_;
};

}  // namespace

bool isNyuRawFolder(const std::vector<std::string>& names) {
  return std::ranges::any_of(names, [](const std::string& name) {
    const auto parts = nyuFileName(name);
    return parts && parts->kind == NyuFileKind::depth;
  });
}

Result<std::unique_ptr<FrameSource>> openNyuRawFolder(const std::filesystem::path& folder,
                                                      const std::vector<std::string>& names,
                                                      const SourceOptions& options) {
  ImageSequence sequence;
  sequence.kind = "NYUv2 raw";
  sequence.folder = folder;
  sequence.has_color = false;
  sequence.is_color_optional = true;
  sequence.camera = {nyuCameras({640, 480}).color, kNyuUnitsPerMeter};
  sequence.camera_origin = "NYUv2";
  const auto decoder = std::make_shared<NyuDecoder>();
  for (const NyuRawPair& pair : nyuRawPairs(names)) {
    ImageSequenceEntry entry;
    entry.index = static_cast<int>(sequence.entries.size());
    entry.timestamp_s = pair.time_s;
    entry.decode_depth = [decoder, file = folder / pair.depth] { return decoder->depth(file); };
    if (!pair.color.empty()) {
      entry.decode_color = [decoder, file = folder / pair.color] { return decoder->color(file); };
      sequence.has_color = true;
    }
    sequence.entries.push_back(std::move(entry));
  }
  return openImageSequence(std::move(sequence), options);
}

}  // namespace scantrove
