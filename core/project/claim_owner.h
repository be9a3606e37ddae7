#pragma once
#include <optional>
#include <string>

namespace scantrove {

/// A process that scans a recording, as its claim file names it.
struct ClaimOwner {
  std::string host;           ///< to display
  std::string machine;        ///< identifies a running system with its process numbers; empty: unknown
  long process = 0;           ///< its id there
  std::string process_start;  ///< as the system counts it; tells it from a later process of the same id
  std::string since;          ///< ISO 8601, UTC
  std::string token;          ///< random; identifies the claim

  /// "lab7, process 4711".
  [[nodiscard]] std::string describe() const;
};

/// This process, with a new token.
[[nodiscard]] ClaimOwner thisClaimOwner();

/// Whether `owner` is known to have ended: it ran on this machine and does not any more. False for other
/// machines.
[[nodiscard]] bool hasEnded(const ClaimOwner& owner);

[[nodiscard]] std::string toClaimText(const ClaimOwner& owner, const std::string& source);
/// Empty: no claim of this program, or one that is not completely written.
[[nodiscard]] std::optional<ClaimOwner> claimOwnerFrom(const std::string& text);

}  // namespace scantrove
