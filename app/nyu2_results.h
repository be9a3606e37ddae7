#pragma once
#include <filesystem>
#include <map>
#include <nlohmann/json.hpp>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "core/base/file_lock.h"
#include "core/base/result.h"
#include "core/evaluation/nyu2.h"

namespace scantrove {

/// The folder with results of `evaluate nyu2`: a record (nyu2.json) of what was evaluated with which setup,
/// so that an interrupted run continues, and the files that it names. Nothing else in a folder is ever
/// replaced. One thread; one program at a time.
class Nyu2Results {
 public:
  /// A new or empty folder, or that of an earlier run with the same `setup` (any JSON object). Error: it
  /// holds other files, results of another setup, or a damaged record; another program uses it; it cannot be
  /// written.
  [[nodiscard]] static Result<Nyu2Results> open(const std::filesystem::path& folder,
                                                const nlohmann::ordered_json& setup);

  /// The outcomes so far of a labelled image (counted from 0); empty if there are none.
  [[nodiscard]] const Nyu2Image& of(std::size_t image) const;
  /// Stores the outcomes of an image; they survive a killed program. Error: the disk.
  [[nodiscard]] Result<void> store(std::size_t image, const Nyu2Image& outcomes);

  /// Writes a file with these bytes into the folder, or replaces that of an earlier run. Error: a file of
  /// that name is not ours; the disk.
  [[nodiscard]] Result<void> write(const std::string& name, const std::string& bytes);

 private:
  Nyu2Results(std::filesystem::path folder, FileLock lock)
      : folder_(std::move(folder)), lock_(std::move(lock)) {}
  [[nodiscard]] Result<void> readRecord(const nlohmann::ordered_json& setup);
  [[nodiscard]] Result<void> writeRecord() const;
  [[nodiscard]] std::filesystem::path recordFile() const { return folder_ / "nyu2.json"; }

  std::filesystem::path folder_;
  FileLock lock_;
  nlohmann::ordered_json setup_;
  std::vector<std::string> files_;  // written by us, besides the record
  std::map<std::size_t, Nyu2Image> images_;
};

}  // namespace scantrove
