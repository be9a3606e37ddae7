#include "core/capture/live/video_system.h"

#include <fcntl.h>
#include <sys/ioctl.h>
#include <sys/mman.h>
#include <unistd.h>

#include <cerrno>

namespace scantrove {

namespace {

class KernelVideoSystem final : public VideoSystem {
 public:
  int open(const std::filesystem::path& node) override {
    const int descriptor = ::open(node.c_str(), O_RDWR | O_NONBLOCK | O_CLOEXEC);
    return descriptor < 0 ? -errno : descriptor;
  }
  void close(int descriptor) override { ::close(descriptor); }
  int control(int descriptor, unsigned long request, void* argument) override {
    int result = 0;
    do {
      result = ::ioctl(descriptor, request, argument);
    } while (result < 0 && errno == EINTR);
    return result < 0 ? -errno : 0;
  }
  void* map(int descriptor, std::size_t bytes, std::int64_t offset) override {
    void* const memory = mmap(nullptr, bytes, PROT_READ | PROT_WRITE, MAP_SHARED, descriptor, offset);
    return memory == MAP_FAILED ? nullptr : memory;
  }
  void unmap(void* memory, std::size_t bytes) override { munmap(memory, bytes); }
  int poll(std::span<pollfd> descriptors, std::chrono::milliseconds timeout) override {
    const int ready = ::poll(descriptors.data(), descriptors.size(), static_cast<int>(timeout.count()));
    return ready < 0 ? -errno : ready;
  }
};

}  // namespace

VideoSystem& kernelVideoSystem() {
  static KernelVideoSystem system;
  return system;
}

}  // namespace scantrove
