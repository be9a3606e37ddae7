#include "core/capture/deflated_frames.h"

#include <zlib.h>

#include <fstream>
#include <utility>
#include <vector>

#include "core/base/regular_file.h"

namespace scantrove {

namespace {

constexpr std::size_t kInputBytes = 1 << 16;

Bytef* inputBytes(const char* data) {
  return reinterpret_cast<Bytef*>(const_cast<char*>(data));  // zlib 1.2 takes no const
}

}  // namespace

/// A stream that is inflated from its start.
class DeflatedFrames::Stream {
 public:
  explicit Stream(const std::filesystem::path& file)
      : name_(file.string()), input_(file, std::ios::binary), buffer_(kInputBytes) {
    is_ready_ = inflateInit2(&zlib_, -MAX_WBITS) == Z_OK;
  }
  Stream(const Stream&) = delete;
  Stream& operator=(const Stream&) = delete;
  ~Stream() {
    if (is_ready_) inflateEnd(&zlib_);
  }

  /// Fills `bytes` with the next ones.
  [[nodiscard]] Result<void> read(std::string& bytes) {
    if (!is_ready_ || !input_.is_open()) return fail("Cannot read " + name_ + ".", "Check its permissions.");
    zlib_.next_out = reinterpret_cast<Bytef*>(bytes.data());
    zlib_.avail_out = static_cast<uInt>(bytes.size());
    while (zlib_.avail_out > 0) {
      if (zlib_.avail_in == 0) {
        input_.read(buffer_.data(), static_cast<std::streamsize>(buffer_.size()));
        zlib_.next_in = inputBytes(buffer_.data());
        zlib_.avail_in = static_cast<uInt>(input_.gcount());
        if (zlib_.avail_in == 0) return fail(name_ + " is truncated: it ends before this frame.");
      }
      const int code = inflate(&zlib_, Z_NO_FLUSH);
      if (zlib_.avail_out == 0) break;
      if (code == Z_STREAM_END) return fail(name_ + " ends before this frame.");
      if (code != Z_OK) return fail(name_ + " is damaged: it cannot be inflated.");
    }
    return {};
  }

 private:
  std::string name_;
  std::ifstream input_;
  std::vector<char> buffer_;
  z_stream zlib_{};
  bool is_ready_ = false;
};

DeflatedFrames::DeflatedFrames(std::filesystem::path file, std::size_t frame_bytes)
    : file_(std::move(file)), frame_bytes_(frame_bytes) {}

DeflatedFrames::~DeflatedFrames() = default;

Result<std::string> DeflatedFrames::frame(int position) {
  if (!last_.empty() && position == next_ - 1) return last_;
  if (!stream_ || position < next_) {
    SCANTROVE_TRY(checkRegularFile(file_));
    stream_ = std::make_unique<Stream>(file_);
    next_ = 0;
  }
  last_.clear();
  std::string bytes(frame_bytes_, '\0');
  for (; next_ <= position; ++next_) SCANTROVE_TRY(stream_->read(bytes));
  last_ = std::move(bytes);
  return last_;
}

Result<std::string> inflateBytes(std::string_view bytes, std::size_t size, const std::string& name) {
  std::string inflated(size, '\0');
  z_stream zlib{};
  if (inflateInit2(&zlib, -MAX_WBITS) != Z_OK) return fail("There is no memory to inflate " + name + ".");
  zlib.next_in = inputBytes(bytes.data());
  zlib.avail_in = static_cast<uInt>(bytes.size());
  zlib.next_out = reinterpret_cast<Bytef*>(inflated.data());
  zlib.avail_out = static_cast<uInt>(size);
  const int code = inflate(&zlib, Z_FINISH);
  const bool is_complete = code == Z_STREAM_END && zlib.avail_out == 0;
  inflateEnd(&zlib);
  return is_complete ? Result<std::string>(std::move(inflated))
                     : fail(name + " is damaged: it cannot be inflated.");
}

}  // namespace scantrove
