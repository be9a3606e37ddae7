#pragma once
#include <poll.h>

#include <chrono>
#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <span>

namespace scantrove {

/// The system calls that a video device needs. Tests replace them to play recorded buffers. A negative result
/// is an errno. Any thread.
class VideoSystem {
 public:
  virtual ~VideoSystem() = default;

  /// Opens a node for reading and writing without waiting. Result: a descriptor.
  [[nodiscard]] virtual int open(const std::filesystem::path& node) = 0;
  virtual void close(int descriptor) = 0;
  /// An ioctl; 0 or a negative errno.
  [[nodiscard]] virtual int control(int descriptor, unsigned long request, void* argument) = 0;
  /// Maps a buffer of the device; null: impossible.
  [[nodiscard]] virtual void* map(int descriptor, std::size_t bytes, std::int64_t offset) = 0;
  virtual void unmap(void* memory, std::size_t bytes) = 0;
  /// Number of descriptors that have something to read or failed; 0: timeout.
  [[nodiscard]] virtual int poll(std::span<pollfd> descriptors, std::chrono::milliseconds timeout) = 0;
};

/// The kernel's own calls.
[[nodiscard]] VideoSystem& kernelVideoSystem();

}  // namespace scantrove
