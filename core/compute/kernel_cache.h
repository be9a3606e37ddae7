#pragma once
#include <filesystem>
#include <optional>

#include "core/base/result.h"

namespace scantrove {

/// Where PoCL, which computes OpenCL's kernels on processors, keeps them compiled while this object lives:
/// $POCL_CACHE_DIR, else scantrove/kernels in the person's cache folder. Without a folder that it can write
/// to PoCL has no device, and a damaged file in it ends the program. So damaged files of our own folder are
/// removed; where that is not enough, a private folder takes its place, which is removed at the end. One at a
/// time, on the main thread, before other threads are there and before OpenCL is used.
class KernelCache {
 public:
  KernelCache();
  ~KernelCache();
  KernelCache(const KernelCache&) = delete;
  KernelCache& operator=(const KernelCache&) = delete;

  [[nodiscard]] const std::filesystem::path& folder() const { return folder_; }
  /// What a person should know: why kernels are compiled anew.
  [[nodiscard]] const std::optional<Error>& remark() const { return remark_; }

 private:
  /// Removes what is damaged, where the folder is our own. Error: something damaged stays.
  [[nodiscard]] Result<void> mend(bool is_ours);
  void usePrivateFolder(const Error& reason);

  std::filesystem::path folder_;
  bool is_private_ = false;
  std::optional<Error> remark_;
};

}  // namespace scantrove
