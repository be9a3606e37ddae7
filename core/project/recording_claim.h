#pragma once
#include <chrono>
#include <filesystem>
#include <memory>
#include <string>
#include <thread>

#include "core/base/result.h"
#include "core/project/claim_owner.h"

namespace scantrove {

/// The claim of this process on one recording, so that no other program scans it at the same time: a file in
/// the folder of claims. It works between computers that share the folder, without locks of the file system.
/// The file exists as long as the object. Its time is renewed every minute, so that others recognise the
/// claim of a computer that failed.
class RecordingClaim {
 public:
  /// Claims that are not renewed for so long are stale.
  static constexpr std::chrono::minutes kStale{10};

  struct Attempt {
    std::unique_ptr<RecordingClaim> claim;  ///< null: another program has it
    ClaimOwner owner;                       ///< that program
  };
  /// Claims `source` in `folder`, which exists. Takes over the claims of processes of this machine that have
  /// ended, and stale ones. Error: the folder cannot be written.
  [[nodiscard]] static Result<Attempt> take(const std::filesystem::path& folder, const std::string& source,
                                            ClaimOwner owner = thisClaimOwner());

  RecordingClaim(const RecordingClaim&) = delete;
  RecordingClaim& operator=(const RecordingClaim&) = delete;
  /// Removes the file, unless another program took the claim over.
  ~RecordingClaim();

  /// Whether the file is still this claim's.
  [[nodiscard]] bool isHeld() const;
  /// Sets the file's time to now. Any thread.
  void renew() const;

  /// The file of a claim on `source`.
  [[nodiscard]] static std::filesystem::path fileOf(const std::filesystem::path& folder,
                                                    const std::string& source);

 private:
  RecordingClaim(std::filesystem::path path, int file);

  std::filesystem::path path_;
  int file_ = -1;         // the claim's inode, whatever its name is
  std::jthread renewal_;  // last member: it uses the others
};

}  // namespace scantrove
