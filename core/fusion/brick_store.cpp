#include "core/fusion/brick_store.h"

#include <fcntl.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <cstdlib>
#include <iterator>
#include <string>
#include <system_error>
#include <utility>

#include "core/fusion/packed_words.h"

namespace scantrove {
namespace {

constexpr std::uint64_t kUnit_bytes =
    4096;  // size unit of records, because small holes would never be reused
constexpr std::uint64_t kStep_bytes = 16ULL << 20U;  // growth step of the file

std::uint64_t wholeUnits(std::uint64_t bytes) {
  return (bytes + kUnit_bytes - 1) / kUnit_bytes * kUnit_bytes;
}

bool writeAt(int file, std::span<const char> bytes, std::uint64_t offset) {
  while (!bytes.empty()) {
    const ssize_t written = ::pwrite(file, bytes.data(), bytes.size(), static_cast<off_t>(offset));
    if (written < 0 && errno == EINTR) continue;
    if (written <= 0) return false;
    bytes = bytes.subspan(static_cast<std::size_t>(written));
    offset += static_cast<std::uint64_t>(written);
  }
  return true;
}

bool readAt(int file, std::span<char> bytes, std::uint64_t offset) {
  while (!bytes.empty()) {
    const ssize_t got = ::pread(file, bytes.data(), bytes.size(), static_cast<off_t>(offset));
    if (got < 0 && errno == EINTR) continue;
    if (got <= 0) return false;
    bytes = bytes.subspan(static_cast<std::size_t>(got));
    offset += static_cast<std::uint64_t>(got);
  }
  return true;
}

}  // namespace

std::filesystem::path folderForBricks() {
  // Read before any thread that might set it: the program sets none.
  if (const char* chosen = std::getenv("TMPDIR"); chosen != nullptr && *chosen != '\0') return chosen;
  return ::access("/var/tmp", W_OK) == 0 ? "/var/tmp" : "/tmp";
}

BrickStore::BrickStore(std::filesystem::path folder, std::uint64_t most_bytes)
    : folder_(std::move(folder)), most_bytes_(most_bytes) {}

BrickStore::~BrickStore() {
  if (file_ >= 0) ::close(file_);
}

Error BrickStore::writeFailure(int code) const {
  return {"No part of the map can be kept in a temporary file in " + folder_.string() + ": " +
              std::generic_category().message(code) + ".",
          "Make room there or name another folder in TMPDIR."};
}

Result<void> BrickStore::open() {
  if (file_ >= 0) return {};
  std::string name = (folder_ / "scantrove-map-XXXXXX").string();
  file_ = ::mkostemp(name.data(), O_CLOEXEC);
  if (file_ < 0) return fail(writeFailure(errno));
  ::unlink(name.c_str());
  return {};
}

Result<std::uint64_t> BrickStore::take(std::uint64_t bytes) {
  auto best = holes_.end();
  for (auto hole = holes_.begin(); hole != holes_.end(); ++hole) {
    if (hole->second >= bytes && (best == holes_.end() || hole->second < best->second)) best = hole;
  }
  if (best != holes_.end()) {
    const auto [offset, size] = *best;
    holes_.erase(best);
    if (size > bytes) holes_.emplace(offset + bytes, size - bytes);
    return offset;
  }
  if (end_ + bytes > most_bytes_) return fail(writeFailure(ENOSPC));
  if (end_ + bytes > allocated_) {
    // Without this, missing disk space would show only after the bricks have left memory.
    int failure = 0;
    for (const std::uint64_t step : {std::max(bytes, kStep_bytes), bytes}) {
      failure = ::fallocate(file_, 0, static_cast<off_t>(end_), static_cast<off_t>(step)) == 0 ? 0 : errno;
      if (failure == 0) allocated_ = end_ + step;
      if (failure == 0 || failure == EOPNOTSUPP) break;
    }
    if (failure != 0 && failure != EOPNOTSUPP) return fail(writeFailure(failure));
  }
  return std::exchange(end_, end_ + bytes);
}

void BrickStore::giveBack(std::uint64_t offset, std::uint64_t bytes) {
  auto next = holes_.upper_bound(offset);
  if (next != holes_.end() && offset + bytes == next->first) {
    bytes += next->second;
    next = holes_.erase(next);
  }
  if (next != holes_.begin()) {
    const auto before = std::prev(next);
    if (before->first + before->second == offset) {
      offset = before->first;
      bytes += before->second;
      holes_.erase(before);
    }
  }
  if (offset + bytes == end_) {
    end_ = offset;
  } else {
    holes_.emplace(offset, bytes);
  }
}

Result<BrickStore::Record> BrickStore::put(std::span<const std::uint32_t> words) {
  SCANTROVE_TRY(open());
  const PackedWords packed = packWords(words);
  const std::uint64_t size = wholeUnits(packed.bytes.size());
  Result<std::uint64_t> offset = take(size);
  if (!offset) return fail(offset.error());
  if (!writeAt(file_, packed.bytes, *offset)) {
    const int code = errno;
    giveBack(*offset, size);
    return fail(writeFailure(code));
  }
  used_bytes_ += size;
  return Record{*offset, static_cast<std::uint32_t>(packed.bytes.size()), packed.unpacked_bytes,
                packed.checksum};
}

Result<std::vector<std::uint32_t>> BrickStore::get(const Record& record) const {
  PackedWords packed{std::vector<char>(record.stored_bytes), record.bytes, record.checksum};
  if (file_ >= 0 && readAt(file_, packed.bytes, record.offset)) {
    if (auto words = unpackWords(packed)) return std::move(*words);
  }
  return fail("A part of the map cannot be read back from its temporary file in " + folder_.string() + ".",
              "That part is missing from now on. Check the disk, or name another folder in TMPDIR.");
}

void BrickStore::erase(const Record& record) {
  used_bytes_ -= wholeUnits(record.stored_bytes);
  giveBack(record.offset, wholeUnits(record.stored_bytes));
}

}  // namespace scantrove
