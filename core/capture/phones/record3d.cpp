#include "core/capture/phones/record3d.h"

#include <array>
#include <cstring>

#include "core/base/regular_file.h"
#include "core/base/stamped_pose.h"
#include "core/capture/folder_listing.h"
#include "core/capture/lzfse_decoder.h"
#include "core/capture/phones/device_files.h"
#include "core/capture/phones/device_metadata.h"
#include "core/capture/zip_archive.h"
#include "core/image/image_file.h"
#include "core/image/image_header.h"
#include "core/image/metric_depth.h"

namespace scantrove {

namespace {

constexpr std::string_view kZipMagic = "PK\x03\x04";
constexpr std::uint64_t kMaxMetadataBytes = std::uint64_t{256} << 20,
                        kMaxImageBytes = std::uint64_t{256} << 20;

/// A depth image that the device makes.
struct DepthSize {
  int width, height;
};
/// Of LiDAR and of the camera for faces.
constexpr std::array<DepthSize, 2> kDepthSizes{{{256, 192}, {640, 480}}};

/// The numbers of frame `index` in an array of arrays; empty if it has none.
std::optional<std::vector<double>> numbersOfFrame(const nlohmann::json& json, const char* key,
                                                  std::size_t index, std::size_t count) {
  if (!json.contains(key) || !json.at(key).is_array() || index >= json.at(key).size()) return std::nullopt;
  return numbersIn(json.at(key)[index], count);
}

/// What metadata says about the frames; images and poses are as the device stored them, upright or not.
class Record3dMetadata {
 public:
  static Result<Record3dMetadata> from(nlohmann::json json, const std::string& name) {
    const auto width = sideOf(json, "w"), height = sideOf(json, "h");
    if (!json.is_object() || !width || !height || !json.contains("poses") || !json.at("poses").is_array())
      return fail(name + " is no metadata of Record3D: it lacks w, h or poses.",
                  "Export the recording again.");
    Record3dMetadata metadata;
    metadata.image_ = cv::Size(*width, *height);
    metadata.K_ = numbersOf(json, "K", 9);
    metadata.fps_ = numberOf(json, "fps").value_or(kFrameRateHz);
    if (!(metadata.fps_ > 0)) metadata.fps_ = kFrameRateHz;
    metadata.depth_ = cv::Size(sideOf(json, "dw").value_or(0), sideOf(json, "dh").value_or(0));
    metadata.json_ = std::move(json);
    return metadata;
  }

  [[nodiscard]] std::size_t frames() const { return json_.at("poses").size(); }

  [[nodiscard]] ImageSequenceEntry entry(std::size_t index) const {
    ImageSequenceEntry entry;
    entry.index = static_cast<int>(index);
    const auto time = numbersOfFrame(json_, "frameTimestamps", index, 1);
    entry.timestamp_s = time ? time->front() : static_cast<double>(index) / fps_;
    if (const auto own = numbersOfFrame(json_, "perFrameIntrinsicCoeffs", index, 4)) {
      const auto at = [&](std::size_t i) { return static_cast<float>((*own)[i]); };
      entry.intrinsics = Intrinsics{at(0), at(1), at(2), at(3), image_.width, image_.height};
    } else if (K_) {
      entry.intrinsics = intrinsicsFromColumns(*K_, image_.width, image_.height);
    }
    if (const auto pose = numbersOfFrame(json_, "poses", index, 7))
      entry.T_world_camera = fromArkitAxes(poseFromQuaternion(*pose));
    return entry;
  }

  /// The size of depth images; without it in the metadata, of the usual ones, as upright as the colour
  /// images.
  [[nodiscard]] std::vector<cv::Size> depthSizes() const {
    if (depth_.area() > 0) return {depth_};
    std::vector<cv::Size> sizes;
    for (const auto& [width, height] : kDepthSizes)
      sizes.push_back(image_.width < image_.height ? cv::Size(height, width) : cv::Size(width, height));
    return sizes;
  }

 private:
  cv::Size image_, depth_;
  std::optional<std::vector<double>> K_;
  double fps_ = kFrameRateHz;
  nlohmann::json json_;
};

ImageSequence record3dSequence(const std::filesystem::path& path, const std::string& origin) {
  ImageSequence sequence;
  sequence.kind = "Record3D";
  sequence.folder = path;
  sequence.has_poses = true;
  sequence.is_color_optional = true;
  sequence.camera_origin = origin;
  return sequence;
}

Result<ImageSequence> checkRecord3d(ImageSequence sequence, const char* advice) {
  if (!sequence.entries.empty()) return sequence;
  return fail(sequence.folder.string() + " has no frame with depth, intrinsics and a pose entry.", advice);
}

/// An archive and the size of the depth images in it.
struct Record3dArchive {
  std::shared_ptr<ZipArchive> zip;
  std::vector<cv::Size> depth_sizes;

  /// Decodes an LZFSE file of one `type` element a pixel.
  [[nodiscard]] Result<cv::Mat> decodeRaw(const std::string& name, int type) const {
    const auto bytes = zip->read(name, kMaxImageBytes);
    if (!bytes) return fail(bytes.error());
    const auto element = static_cast<std::size_t>(CV_ELEM_SIZE(type));
    const auto largest = static_cast<std::size_t>(depth_sizes.back().area()) * element;
    const auto raw = decodeLzfse(*bytes, largest, name);
    if (!raw) return fail(raw.error());
    for (const cv::Size& size : depth_sizes) {
      if (raw->size() != static_cast<std::size_t>(size.area()) * element) continue;
      cv::Mat image(size, type);
      std::memcpy(image.data, raw->data(), raw->size());
      return image;
    }
    return fail(name + " has " + std::to_string(raw->size()) +
                " bytes, which are no depth image of this recording.");
  }
};

void addArchiveImages(ImageSequenceEntry& entry, const std::shared_ptr<const Record3dArchive>& archive) {
  const std::string stem = "rgbd/" + std::to_string(entry.index);
  entry.decode_depth = [archive, name = stem + ".depth"] {
    return archive->decodeRaw(name, CV_32FC1).map(withoutInvalidDepth);
  };
  if (const std::string name = stem + ".conf"; archive->zip->contains(name))
    entry.decode_confidence = [archive, name] { return archive->decodeRaw(name, CV_8UC1); };
  if (const std::string name = stem + ".jpg"; archive->zip->contains(name)) {
    entry.decode_color = [archive, name]() -> Result<cv::Mat> {
      const auto bytes = archive->zip->read(name, kMaxImageBytes);
      if (!bytes) return fail(bytes.error());
      return decodeColorImage({reinterpret_cast<const std::uint8_t*>(bytes->data()), bytes->size()}, name);
    };
  }
}

/// The colour image of an exported frame: in rgb/ or beside the folder of depth.
std::filesystem::path exportedColor(const std::filesystem::path& folder, const std::string& number) {
  for (const std::filesystem::path& place : {folder / "rgb", folder}) {
    for (const char* const end : {".jpg", ".png"}) {
      if (auto file = fileIfPresent(place / (number + end)); !file.empty()) return file;
    }
  }
  return {};
}

}  // namespace

bool isRecord3dFolder(const std::filesystem::path& folder) {
  if (!isFolder(folder / "depth") || fileIfPresent(folder / "metadata.json").empty()) return false;
  const auto json = readJson(folder / "metadata.json");
  return json && json->is_object() && json->contains("poses") && json->contains("K");
}

Result<ImageSequence> readRecord3dFolder(const std::filesystem::path& folder) {
  const std::filesystem::path file = folder / "metadata.json";
  auto json = readJson(file);
  if (!json) return fail(json.error());
  const auto metadata = Record3dMetadata::from(std::move(*json), file.string());
  if (!metadata) return fail(metadata.error());
  ImageSequence sequence = record3dSequence(folder, file.string());
  for (std::size_t i = 0; i < metadata->frames(); ++i) {
    ImageSequenceEntry entry = metadata->entry(i);
    const std::string number = std::to_string(i);
    entry.depth = fileIfPresent(folder / "depth" / (number + ".exr"));
    if (entry.depth.empty() || !entry.intrinsics) continue;
    entry.color = exportedColor(folder, number);
    sequence.entries.push_back(std::move(entry));
  }
  return checkRecord3d(std::move(sequence), "Export \"EXR + RGBD\" in Record3D and copy the whole folder.");
}

bool isRecord3dFile(const std::filesystem::path& file) {
  if (lowerCase(file.extension().string()) == ".r3d") return true;
  const auto start = readFile(file, kZipMagic.size());
  if (!start || *start != kZipMagic) return false;
  const auto zip = ZipArchive::open(file);
  return zip && (*zip)->contains("metadata");
}

Result<ImageSequence> readRecord3dFile(const std::filesystem::path& file) {
  const auto zip = ZipArchive::open(file);
  if (!zip) return fail(zip.error());
  const auto text = (*zip)->read("metadata", kMaxMetadataBytes);
  if (!text) return fail(text.error());
  auto json = parseJson(*text, "metadata in " + file.string());
  if (!json) return fail(json.error());
  const auto metadata = Record3dMetadata::from(std::move(*json), file.string());
  if (!metadata) return fail(metadata.error());
  auto archive = std::make_shared<Record3dArchive>();
  archive->zip = *zip;
  archive->depth_sizes = metadata->depthSizes();
  for (const cv::Size& size : archive->depth_sizes)
    SCANTROVE_TRY(checkImageSize(
        {static_cast<std::uint32_t>(size.width), static_cast<std::uint32_t>(size.height)}, file.string()));
  ImageSequence sequence = record3dSequence(file, "metadata in " + file.string());
  for (std::size_t i = 0; i < metadata->frames(); ++i) {
    ImageSequenceEntry entry = metadata->entry(i);
    if (!entry.intrinsics || !(*zip)->contains("rgbd/" + std::to_string(i) + ".depth")) continue;
    addArchiveImages(entry, archive);
    sequence.entries.push_back(std::move(entry));
  }
  return checkRecord3d(std::move(sequence),
                       "Share the recording as .r3d with depth, or export \"EXR + RGBD\".");
}

}  // namespace scantrove
