#pragma once
#include <cstdint>
#include <filesystem>
#include <memory>
#include <string>
#include <string_view>

#include "core/base/result.h"

namespace scantrove {

/// Frames of equal size, one after another in one raw DEFLATE stream (a .zlib file without zlib's header).
/// Inflated as they are asked for; the file is never in memory as a whole. One thread at a time.
class DeflatedFrames {
 public:
  DeflatedFrames(std::filesystem::path file, std::size_t frame_bytes);
  DeflatedFrames(const DeflatedFrames&) = delete;
  DeflatedFrames& operator=(const DeflatedFrames&) = delete;
  ~DeflatedFrames();

  /// The bytes of the frame at `position`, counted from 0. Inflates all frames between the last one and this;
  /// a smaller position starts over. Error: names the file; damaged, or the stream is shorter.
  [[nodiscard]] Result<std::string> frame(int position);

 private:
  class Stream;
  std::filesystem::path file_;
  std::size_t frame_bytes_;
  std::unique_ptr<Stream> stream_;
  int next_ = 0;      ///< position of the frame that the stream returns next
  std::string last_;  ///< of position next_ - 1
};

/// Inflates raw DEFLATE data to exactly `size` bytes. Error: names `name`; damaged, or another size.
[[nodiscard]] Result<std::string> inflateBytes(std::string_view bytes, std::size_t size,
                                               const std::string& name);

}  // namespace scantrove
