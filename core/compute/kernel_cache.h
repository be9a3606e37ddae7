#pragma once
#include <filesystem>
#include <optional>

#include "core/base/result.h"

namespace scantrove {

/// Selects PoCL's folder for compiled kernels during this object's lifetime: $POCL_CACHE_DIR, else
/// scantrove/kernels in the user's cache folder. Without a writable folder PoCL has no device, and a damaged
/// file in it ends the program. Removes damaged files from the program's own folder. If problems remain, uses
/// a private folder and removes it at the end. One instance at a time, on the main thread, before other
/// threads and OpenCL.
class KernelCache {
 public:
  KernelCache();
  ~KernelCache();
  KernelCache(const KernelCache&) = delete;
  KernelCache& operator=(const KernelCache&) = delete;

  [[nodiscard]] const std::filesystem::path& folder() const { return folder_; }
  /// Message for the user: why kernels are compiled again.
  [[nodiscard]] const std::optional<Error>& remark() const { return remark_; }

 private:
  /// Removes damaged files if the folder is the program's own. Error: damaged files remain.
  [[nodiscard]] Result<void> mend(bool is_ours);
  void usePrivateFolder(const Error& reason);

  std::filesystem::path folder_;
  bool is_private_ = false;
  std::optional<Error> remark_;
};

}  // namespace scantrove
