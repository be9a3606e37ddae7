#include "core/project/recording_claim.h"

#include <fcntl.h>
#include <sys/stat.h>
#include <unistd.h>

#include <cerrno>
#include <condition_variable>
#include <cstdint>
#include <ctime>
#include <iomanip>
#include <mutex>
#include <optional>
#include <sstream>
#include <string_view>
#include <system_error>
#include <utility>

#include "core/base/held_file.h"
#include "core/base/regular_file.h"

namespace scantrove {
namespace {

namespace fs = std::filesystem;

constexpr std::size_t kLargestClaim_bytes = 1 << 16;
constexpr mode_t kEverybodyReads = 0644;

tl::unexpected<Error> cannotClaim(const fs::path& path, int code) {
  return fail("Cannot write the claim " + path.string() + ": " + std::generic_category().message(code) + ".",
              "Give write permission to the project's folder, or use a copy of the project.");
}

std::optional<std::time_t> timeOf(const fs::path& path) {
  struct stat status {};
  if (::stat(path.c_str(), &status) != 0) return std::nullopt;
  return status.st_mtime;
}

/// A file of this claim alone under a name of its own, completely written. Its time is that of the file
/// system's computer, against which the age of other claims is measured.
class ClaimCandidate {
 public:
  explicit ClaimCandidate(fs::path path)
      : path_(std::move(path)),
        file_(::open(path_.c_str(), O_RDWR | O_CREAT | O_EXCL | O_CLOEXEC, kEverybodyReads)),
        error_(file_ < 0 ? errno : 0) {}
  ClaimCandidate(const ClaimCandidate&) = delete;
  ClaimCandidate& operator=(const ClaimCandidate&) = delete;
  ~ClaimCandidate() {
    if (isNameOf(path_, file_)) ::unlink(path_.c_str());
    if (file_ >= 0) ::close(file_);
  }

  [[nodiscard]] Result<void> write(std::string_view text) {
    while (error_ == 0 && !text.empty()) {
      const ssize_t written = ::write(file_, text.data(), text.size());
      if (written < 0 && errno != EINTR) error_ = errno;
      if (written > 0) text.remove_prefix(static_cast<std::size_t>(written));
    }
    if (error_ == 0 && ::fsync(file_) != 0) error_ = errno;
    return error_ == 0 ? Result<void>() : Result<void>(cannotClaim(path_, error_));
  }

  /// Gives the file the name `claim` unless that exists. Result: whether it has it.
  [[nodiscard]] Result<bool> becomeNew(const fs::path& claim) const {
    if (::link(path_.c_str(), claim.c_str()) == 0) return true;
    const int code = errno;
    struct stat status {};
    // A server of files may have made the link and lost the answer.
    if (::fstat(file_, &status) == 0 && status.st_nlink > 1) return true;
    if (code == EEXIST) return false;
    // File systems without links (FAT): the rename is not exclusive there, the look before it has to do.
    if (code != EPERM && code != EOPNOTSUPP && code != ENOSYS) return cannotClaim(claim, code);
    if (timeOf(claim)) return false;
    return replace(claim).map([] { return true; });
  }

  [[nodiscard]] Result<void> replace(const fs::path& claim) const {
    if (::rename(path_.c_str(), claim.c_str()) != 0) return cannotClaim(claim, errno);
    return {};
  }

  [[nodiscard]] std::time_t now() const {
    struct stat status {};
    return ::fstat(file_, &status) == 0 ? status.st_mtime : 0;
  }

  /// The open file, which the caller closes.
  [[nodiscard]] int release() {
    if (isNameOf(path_, file_)) ::unlink(path_.c_str());
    return std::exchange(file_, -1);
  }

 private:
  fs::path path_;
  int file_ = -1;
  int error_ = 0;
};

/// The right to replace one stale claim, which one program has at a time: a file named by the token of that
/// claim.
class Takeover {
 public:
  explicit Takeover(fs::path path)
      : path_(std::move(path)),
        file_(::open(path_.c_str(), O_RDWR | O_CREAT | O_EXCL | O_CLOEXEC, kEverybodyReads)) {}
  Takeover(const Takeover&) = delete;
  Takeover& operator=(const Takeover&) = delete;
  ~Takeover() {
    if (file_ < 0) return;
    if (isNameOf(path_, file_)) ::unlink(path_.c_str());
    ::close(file_);
  }
  [[nodiscard]] bool isOurs() const { return file_ >= 0; }

 private:
  fs::path path_;
  int file_ = -1;
};

struct FoundClaim {
  ClaimOwner owner;
  bool is_stale = false;
};

/// The claim that stands there; empty: none any more.
std::optional<FoundClaim> findClaim(const fs::path& path, std::time_t now) {
  const std::optional<std::time_t> renewed = timeOf(path);
  if (!renewed) return std::nullopt;
  const Result<std::string> text = readFile(path, kLargestClaim_bytes);
  const std::optional<ClaimOwner> owner = text ? claimOwnerFrom(*text) : std::nullopt;
  const bool is_old = now - *renewed > std::chrono::seconds(RecordingClaim::kStale).count();
  if (!owner) return FoundClaim{{}, is_old};
  return FoundClaim{*owner, is_old || hasEnded(*owner)};
}

fs::path besideClaim(const fs::path& path, const std::string& token, const char* ending) {
  std::string name = path.filename().string() + '.';
  for (const char letter : token) name += letter == '/' ? '-' : letter;
  return path.parent_path() / (name + ending);
}

/// A program that was killed while it took a claim over leaves the file of its right.
void removeLeftTakeover(const fs::path& path, std::time_t now) {
  const std::optional<std::time_t> made = timeOf(path);
  if (made && now - *made > std::chrono::seconds(RecordingClaim::kStale).count()) ::unlink(path.c_str());
}

/// Replaces the stale claim `stale` by `candidate`. Result: whether it did.
Result<bool> takeOver(const ClaimCandidate& candidate, const fs::path& path, const FoundClaim& stale) {
  const fs::path right = besideClaim(path, stale.owner.token, ".takeover");
  removeLeftTakeover(right, candidate.now());
  const Takeover takeover(right);
  if (!takeover.isOurs()) return false;
  // Another program may have had the right before, and the claim is that program's now.
  const std::optional<FoundClaim> found = findClaim(path, candidate.now());
  if (!found || found->owner.token != stale.owner.token || !found->is_stale) return false;
  return candidate.replace(path).map([] { return true; });
}

std::uint64_t fnv1a(std::string_view text) {
  std::uint64_t hash = 0xcbf29ce484222325U;
  for (const char letter : text) hash = (hash ^ static_cast<unsigned char>(letter)) * 0x100000001b3U;
  return hash;
}

}  // namespace

fs::path RecordingClaim::fileOf(const fs::path& folder, const std::string& source) {
  std::ostringstream name;
  name << std::hex << std::setw(16) << std::setfill('0') << fnv1a(source) << ".claim";
  return folder / name.str();
}

Result<RecordingClaim::Attempt> RecordingClaim::take(const fs::path& folder, const std::string& source,
                                                     ClaimOwner owner) {
  const fs::path path = fileOf(folder, source);
  ClaimCandidate candidate(besideClaim(path, owner.token, ".new"));
  SCANTROVE_TRY(candidate.write(toClaimText(owner, source)));
  // The claim may be released or taken over by others meanwhile; then it is looked at once more.
  constexpr int kAttempts = 3;
  std::optional<FoundClaim> found;
  for (int attempt = 0; attempt < kAttempts; ++attempt) {
    Result<bool> is_ours = candidate.becomeNew(path);
    if (is_ours && !*is_ours) {
      found = findClaim(path, candidate.now());
      if (found && found->is_stale) is_ours = takeOver(candidate, path, *found);
    }
    if (!is_ours) return fail(is_ours.error());
    if (*is_ours)
      return Attempt{std::unique_ptr<RecordingClaim>(new RecordingClaim(path, candidate.release())), owner};
    if (found && !found->is_stale) break;
  }
  return Attempt{nullptr, found ? found->owner : ClaimOwner{}};
}

RecordingClaim::RecordingClaim(fs::path path, int file)
    : path_(std::move(path)), file_(file), renewal_([this](const std::stop_token& stop) {
        constexpr std::chrono::minutes kRenewal{1};
        std::mutex mutex;
        std::condition_variable_any stopped;
        std::unique_lock lock(mutex);
        while (!stopped.wait_for(lock, stop, kRenewal, [&] { return stop.stop_requested(); })) renew();
      }) {}

RecordingClaim::~RecordingClaim() {
  renewal_.request_stop();
  renewal_.join();
  if (isHeld()) ::unlink(path_.c_str());
  ::close(file_);
}

bool RecordingClaim::isHeld() const { return isNameOf(path_, file_); }

void RecordingClaim::renew() const { static_cast<void>(::futimens(file_, nullptr)); }

}  // namespace scantrove
