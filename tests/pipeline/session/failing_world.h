#pragma once
#include <filesystem>

namespace scantrove::test {

/// An OpenCL device that can be taken away. The functions that queue work, and wait for it, are this
/// program's own and stand before the library's.
namespace failing_device {
/// Counts from now on.
void count();
[[nodiscard]] int counted();
/// All that comes after the next `works` calls fails.
void failAfter(int works);
/// All is well again.
void heal();
}  // namespace failing_device

/// A disk that is full below `folder`, while it lives, for files that this program itself writes.
class FullDisk {
 public:
  explicit FullDisk(const std::filesystem::path& folder);
  ~FullDisk();
  FullDisk(const FullDisk&) = delete;
  FullDisk& operator=(const FullDisk&) = delete;
};

}  // namespace scantrove::test
