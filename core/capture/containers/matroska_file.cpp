#include "core/capture/containers/matroska_file.h"

#include <spdlog/spdlog.h>

#include <algorithm>
#include <utility>

#include "core/capture/containers/ebml.h"

namespace scantrove {

namespace {

// Elements of Matroska (RFC 9559).
namespace mkv {
constexpr std::uint32_t kSegment = 0x18538067, kCluster = 0x1F43B675, kBlockGroup = 0xA0;
constexpr std::uint32_t kInfo = 0x1549A966, kTimestampScale = 0x2AD7B1;
constexpr std::uint32_t kTracks = 0x1654AE6B, kTrackEntry = 0xAE, kTrackNumber = 0xD7, kTrackType = 0x83,
                        kName = 0x536E, kCodecId = 0x86, kCodecPrivate = 0x63A2, kVideo = 0xE0,
                        kPixelWidth = 0xB0, kPixelHeight = 0xBA, kColorSpace = 0x2EB524,
                        kContentEncodings = 0x6D80;
constexpr std::uint32_t kAttachments = 0x1941A469, kAttachedFile = 0x61A7, kFileName = 0x466E,
                        kFileData = 0x465C;
constexpr std::uint32_t kTimestamp = 0xE7, kSimpleBlock = 0xA3, kBlock = 0xA1;
}  // namespace mkv

constexpr std::uint64_t kLargestMkvHeader = 32 << 20;  // of the elements that are read as a whole
constexpr std::size_t kMostBlocks = 4 << 20;
constexpr std::uint32_t kLargestMkvImage = 128 << 20;
constexpr std::uint64_t kVideoTrack = 1;
constexpr std::uint32_t kLargestMkvSide = 16384;

std::string codecOf(const std::string& codec, ByteView codec_private, const std::string& color_space) {
  constexpr std::size_t kFourCharacters = 16;  // in BITMAPINFOHEADER
  if (codec == "V_MJPEG") return "MJPG";
  if (codec == "V_UNCOMPRESSED") return color_space;
  if (codec != "V_MS/VFW/FOURCC" || codec_private.size() < kFourCharacters + 4) return codec;
  return {reinterpret_cast<const char*>(codec_private.data()) + kFourCharacters, 4};
}

/// None: no video.
std::optional<MatroskaTrack> trackFrom(ByteView bytes, bool& is_encoded) {
  MatroskaTrack track;
  std::uint64_t type = 0;
  std::string codec, color_space;
  ByteView codec_private;
  const auto side = [](const ebml::Child& child) {
    return static_cast<int>(std::min<std::uint64_t>(child.number(), kLargestMkvSide));
  };
  ebml::forEachChild(bytes, [&](const ebml::Child& child) {
    if (child.id == mkv::kTrackNumber) track.number = child.number();
    if (child.id == mkv::kTrackType) type = child.number();
    if (child.id == mkv::kName) track.name = child.text();
    if (child.id == mkv::kCodecId) codec = child.text();
    if (child.id == mkv::kCodecPrivate) codec_private = child.data;
    if (child.id == mkv::kContentEncodings) is_encoded = true;
    if (child.id != mkv::kVideo) return;
    ebml::forEachChild(child.data, [&](const ebml::Child& video) {
      if (video.id == mkv::kPixelWidth) track.width = side(video);
      if (video.id == mkv::kPixelHeight) track.height = side(video);
      if (video.id == mkv::kColorSpace) color_space = video.text();
    });
  });
  if (type != kVideoTrack) return std::nullopt;
  track.codec = codecOf(codec, codec_private, color_space);
  return track;
}

}  // namespace

bool isMatroska(ByteView start) {
  return start.size() >= 4 && start[0] == 0x1A && start[1] == 0x45 && start[2] == 0xDF && start[3] == 0xA3;
}

tl::unexpected<Error> MatroskaFile::damaged(const std::string& why) const {
  return fail("The Matroska file " + path().string() + " is damaged: " + why + ".",
              "Copy or record it again.");
}

Result<std::unique_ptr<MatroskaFile>> MatroskaFile::open(const std::filesystem::path& path,
                                                         OpeningProgress& progress) {
  Result<RandomAccessFile> file = RandomAccessFile::open(path);
  if (!file) return fail(file.error());
  std::unique_ptr<MatroskaFile> matroska(new MatroskaFile(std::move(*file)));
  SCANTROVE_TRY(matroska->readIndex(progress));
  return matroska;
}

Result<ByteBlock> MatroskaFile::read(const MatroskaBlock& block) const {
  return file_.read(block.offset, block.bytes);
}

/// Walks over all elements. Segments, clusters and groups of blocks are entered, whatever size they announce:
/// a recorder that was killed left it unknown.
Result<void> MatroskaFile::readIndex(OpeningProgress& progress) {
  for (std::uint64_t at = 0; at < file_.size() && !is_cut_;) {
    SCANTROVE_TRY(progress.report(static_cast<double>(at) / static_cast<double>(file_.size())));
    const Result<Element> element = elementAt(at);
    if (!element) return fail(element.error());
    if (is_cut_) break;
    const bool is_entered =
        element->id == mkv::kSegment || element->id == mkv::kCluster || element->id == mkv::kBlockGroup;
    if (!is_entered) {
      is_cut_ = element->bytes > file_.size() - element->data;
      if (!is_cut_) SCANTROVE_TRY(readElement(*element));
    }
    at = is_entered ? element->data : element->data + element->bytes;
  }
  if (is_cut_)
    spdlog::warn("{} is not complete; reading the {} images before its end.", path().string(), blocks_);
  if (blocks_ == 0) return damaged("it has no complete image");
  for (MatroskaTrack& track : tracks_) std::ranges::stable_sort(track.blocks, {}, &MatroskaBlock::time_ns);
  return {};
}

/// Sets is_cut_ if the file ends inside the element's start.
Result<MatroskaFile::Element> MatroskaFile::elementAt(std::uint64_t at) {
  constexpr std::size_t kLongestStart = 16;
  const Result<ByteView> start = file_.peek(at, kLongestStart);
  if (!start) return fail(start.error());
  ByteCursor cursor(*start);
  const auto id = ebml::readNumber(cursor, true);
  const auto size = id ? ebml::readNumber(cursor, false) : std::nullopt;
  if (!size && start->size() < kLongestStart) {
    is_cut_ = true;
    return Element();
  }
  if (!size || *id > 0xFFFFFFFFU) return damaged("an element has no id or size");
  return Element{static_cast<std::uint32_t>(*id), at + cursor.position(), *size};
}

Result<void> MatroskaFile::readElement(const Element& element) {
  switch (element.id) {
    case mkv::kSimpleBlock:
    case mkv::kBlock:
      return addBlock(element);
    case mkv::kTimestamp:
    case mkv::kInfo:
    case mkv::kTracks:
    case mkv::kAttachments:
      break;
    default:
      return {};
  }
  if (element.bytes > kLargestMkvHeader) return damaged("its header is larger than 32 MB");
  const Result<ByteBlock> bytes = file_.read(element.data, element.bytes);
  if (!bytes) return fail(bytes.error());
  if (element.id == mkv::kTracks) return readTracks(*bytes);
  if (element.id == mkv::kAttachments) return readAttachments(*bytes);
  if (element.id == mkv::kTimestamp) {
    cluster_ticks_ = static_cast<std::int64_t>(ebml::Child{element.id, *bytes}.number());
  } else {
    ebml::forEachChild(*bytes, [&](const ebml::Child& child) {
      if (child.id == mkv::kTimestampScale) nanoseconds_per_tick_ = child.number();
    });
  }
  return {};
}

Result<void> MatroskaFile::readTracks(ByteView bytes) {
  constexpr std::size_t kMostTracks = 100;
  bool is_encoded = false;
  ebml::forEachChild(bytes, [&](const ebml::Child& child) {
    if (child.id != mkv::kTrackEntry || tracks_.size() >= kMostTracks) return;
    if (auto track = trackFrom(child.data, is_encoded)) tracks_.push_back(std::move(*track));
  });
  if (!is_encoded) return {};
  return fail("The tracks of " + path().string() + " are compressed again.",
              "Give the file as the camera's recorder wrote it.");
}

Result<void> MatroskaFile::readAttachments(ByteView bytes) {
  attached_bytes_ += bytes.size();
  if (attached_bytes_ > kLargestMkvHeader) return damaged("its attachments are larger than 32 MB");
  ebml::forEachChild(bytes, [&](const ebml::Child& file) {
    if (file.id != mkv::kAttachedFile) return;
    std::string name, data;
    ebml::forEachChild(file.data, [&](const ebml::Child& child) {
      if (child.id == mkv::kFileName) name = child.text();
      if (child.id == mkv::kFileData) data.assign(child.data.begin(), child.data.end());
    });
    attachments_.insert_or_assign(std::move(name), std::move(data));
  });
  return {};
}

/// A block: the track's number, ticks since the cluster's, flags, then the image.
Result<void> MatroskaFile::addBlock(const Element& element) {
  constexpr std::size_t kLongestStart = 12;
  constexpr std::uint8_t kLacing = 0x06;
  const Result<ByteView> start = file_.peek(
      element.data, static_cast<std::size_t>(std::min<std::uint64_t>(kLongestStart, element.bytes)));
  if (!start) return fail(start.error());
  ByteCursor cursor(*start, true);
  const auto number = ebml::readNumber(cursor, false);
  const std::int64_t ticks = cursor.get<std::int16_t>();
  const auto flags = cursor.get<std::uint8_t>();
  if (!number || !cursor.isOk()) return damaged("a block has no track");
  const auto track = std::ranges::find(tracks_, *number, &MatroskaTrack::number);
  if (track == tracks_.end()) return {};  // sound, subtitles, motion
  const std::uint64_t bytes = element.bytes - cursor.position();
  if ((flags & kLacing) != 0 || bytes > kLargestMkvImage) return damaged("a block holds no single image");
  if (++blocks_ > kMostBlocks) return damaged("it has more than 4 million images");
  // Wraps instead of overflowing where a damaged file has absurd times.
  const auto time = (static_cast<std::uint64_t>(cluster_ticks_) + static_cast<std::uint64_t>(ticks)) *
                    nanoseconds_per_tick_;
  track->blocks.push_back({std::max<std::int64_t>(0, static_cast<std::int64_t>(time)),
                           element.data + cursor.position(), static_cast<std::uint32_t>(bytes)});
  return {};
}

}  // namespace scantrove
