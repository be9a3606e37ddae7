#pragma once
#include <cstdint>
#include <map>
#include <memory>
#include <string>
#include <vector>

#include "core/capture/containers/opening_progress.h"
#include "core/capture/containers/random_access_file.h"

namespace scantrove {

/// One image of a track.
struct MatroskaBlock {
  std::int64_t time_ns = 0;
  std::uint64_t offset = 0;  ///< of its bytes in the file
  std::uint32_t bytes = 0;
};

/// A video track.
struct MatroskaTrack {
  std::uint64_t number = 0;
  std::string name;
  /// Four characters of the pixel format: "MJPG", "b16g", "NV12", ...; else the codec ("V_MPEG4/ISO/AVC").
  std::string codec;
  int width = 0, height = 0;
  std::vector<MatroskaBlock> blocks;  ///< by time
};

/// A Matroska file whose images are single blocks. Opening reads the headers of all blocks, not the images.
/// One thread.
class MatroskaFile {
 public:
  /// Error: names the file; damaged, without tracks or images. A file without its end opens with a warning.
  [[nodiscard]] static Result<std::unique_ptr<MatroskaFile>> open(const std::filesystem::path& path,
                                                                  OpeningProgress& progress);

  [[nodiscard]] const std::filesystem::path& path() const { return file_.path(); }
  [[nodiscard]] const std::vector<MatroskaTrack>& tracks() const { return tracks_; }
  /// Contents of attached files by name (calibration.json).
  [[nodiscard]] const std::map<std::string, std::string>& attachments() const { return attachments_; }

  /// The bytes of a block. Error: names the file; truncated, or the system's reason.
  [[nodiscard]] Result<ByteBlock> read(const MatroskaBlock& block) const;

 private:
  struct Element {
    std::uint32_t id = 0;
    std::uint64_t data = 0;   ///< where its data lie in the file
    std::uint64_t bytes = 0;  ///< kUnknownSize: up to the next of its level
  };

  explicit MatroskaFile(RandomAccessFile file) : file_(std::move(file)) {}
  [[nodiscard]] Result<void> readIndex(OpeningProgress& progress);
  [[nodiscard]] Result<Element> elementAt(std::uint64_t at);
  [[nodiscard]] Result<void> readElement(const Element& element);
  [[nodiscard]] Result<void> readTracks(ByteView bytes);
  [[nodiscard]] Result<void> readAttachments(ByteView bytes);
  [[nodiscard]] Result<void> addBlock(const Element& element);
  [[nodiscard]] tl::unexpected<Error> damaged(const std::string& why) const;

  RandomAccessFile file_;
  std::vector<MatroskaTrack> tracks_;
  std::map<std::string, std::string> attachments_;
  std::uint64_t nanoseconds_per_tick_ = 1'000'000;
  std::int64_t cluster_ticks_ = 0;
  std::size_t blocks_ = 0;
  std::uint64_t attached_bytes_ = 0;
  bool is_cut_ = false;
};

/// Whether a file begins as Matroska (or WebM).
[[nodiscard]] bool isMatroska(ByteView start);

}  // namespace scantrove
