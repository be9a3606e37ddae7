#pragma once
#include <filesystem>

namespace scantrove::test {

/// An OpenCL device that can fail. This program's functions that queue work and wait for it replace those of
/// the library and call them.
namespace failing_device {
/// Starts to count the calls.
void count();
[[nodiscard]] int counted();
/// All calls after the next `works` fail.
void failAfter(int works);
/// Calls work again.
void heal();
}  // namespace failing_device

/// Makes the disk full below `folder` while it lives, for this program's own writes.
class FullDisk {
 public:
  explicit FullDisk(const std::filesystem::path& folder);
  ~FullDisk();
  FullDisk(const FullDisk&) = delete;
  FullDisk& operator=(const FullDisk&) = delete;
};

}  // namespace scantrove::test
