#include "core/dataset/export_record.h"

#include <nlohmann/json.hpp>
#include <set>
#include <span>
#include <system_error>
#include <utility>

#include "core/base/checksum.h"
#include "core/base/regular_file.h"
#include "core/dataset/staged_folder.h"
#include "core/dataset/staged_remains.h"
#include "core/exchange/atomic_file.h"

namespace scantrove {
namespace {

namespace fs = std::filesystem;
using RecordJson = nlohmann::ordered_json;

/// The key that marks the file; its value is the version of the format.
constexpr const char* kRecordKey = "scantrove_export";
constexpr int kRecordVersion = 1;

std::uint32_t crcOf(std::string_view bytes) { return crc32Of(std::span(bytes.data(), bytes.size())); }

/// Whether a path of a record stays inside its folder.
bool isInside(const fs::path& name) {
  if (name.empty() || name.is_absolute() || !name.has_filename()) return false;
  for (const fs::path& part : name) {
    if (part == ".." || part == ".") return false;
  }
  return true;
}

bool isRealFolder(const fs::path& folder) {
  std::error_code failure;
  return fs::symlink_status(folder, failure).type() == fs::file_type::directory;
}

/// Whether all folders between `folder` and `name` are real ones. What is behind a link is elsewhere, and not
/// what an export wrote.
bool isReachedWithoutLinks(fs::path folder, const fs::path& name) {
  for (const fs::path& part : name.parent_path()) {
    folder /= part;
    if (!isRealFolder(folder)) return false;
  }
  return true;
}

tl::unexpected<Error> damagedRecord(const fs::path& file) {
  return fail(file.string() + " is damaged: it does not say which files an export wrote.",
              "Export to another folder.");
}

}  // namespace

Result<std::optional<ExportRecord>> ExportRecord::read(const fs::path& folder) {
  const fs::path file = folder / kFile;
  std::error_code failure;
  if (fs::symlink_status(file, failure).type() == fs::file_type::not_found)
    return std::optional<ExportRecord>();
  const Result<std::string> text = readFile(file);
  if (!text) return fail(text.error());
  const RecordJson json = RecordJson::parse(*text, nullptr, false);
  if (!json.is_object() || !json.contains(kRecordKey) || !json.at(kRecordKey).is_number_integer())
    return damagedRecord(file);
  if (json.at(kRecordKey).get<std::int64_t>() > kRecordVersion) {
    return fail("The data set in " + folder.string() + " was written by a newer version of Scantrove.",
                "Update Scantrove, or export to another folder.");
  }
  const auto format = json.find("format"), files = json.find("files");
  if (format == json.end() || !format->is_string() || files == json.end() || !files->is_array())
    return damagedRecord(file);
  ExportRecord record(format->get<std::string>());
  for (const RecordJson& entry : *files) {
    const bool is_complete = entry.is_object() && entry.contains("path") && entry.at("path").is_string() &&
                             entry.contains("bytes") && entry.at("bytes").is_number_unsigned() &&
                             entry.contains("crc32") && entry.at("crc32").is_number_unsigned();
    if (!is_complete) return damagedRecord(file);
    const fs::path name = entry.at("path").get<std::string>();
    if (!isInside(name)) return damagedRecord(file);
    record.files_[name] = {entry.at("bytes").get<std::uintmax_t>(), entry.at("crc32").get<std::uint32_t>()};
  }
  return std::optional<ExportRecord>(std::move(record));
}

void ExportRecord::add(const fs::path& name, std::string_view bytes) {
  files_[name] = {bytes.size(), crcOf(bytes)};
}

Result<void> ExportRecord::addWritten(const fs::path& folder, const fs::path& name) {
  const Result<std::string> bytes = readFile(folder / name);
  if (!bytes) return fail(bytes.error());
  add(name, *bytes);
  return {};
}

Result<void> ExportRecord::writeTo(const fs::path& folder) const {
  RecordJson files = RecordJson::array();
  for (const auto& [name, file] : files_)
    files.push_back({{"path", name.generic_string()}, {"bytes", file.bytes}, {"crc32", file.crc}});
  RecordJson json = RecordJson::object();
  json[kRecordKey] = kRecordVersion;
  json["format"] = format_;
  json["files"] = std::move(files);
  const std::string text = json.dump(1, ' ', false, RecordJson::error_handler_t::replace) + "\n";
  return writeFileAtomically(folder / kFile, text, Durability::process);
}

bool ExportRecord::isUnchanged(const fs::path& file, const File& recorded) const {
  std::error_code failure;
  if (fs::symlink_status(file, failure).type() != fs::file_type::regular) return false;
  if (fs::file_size(file, failure) != recorded.bytes || failure) return false;
  const Result<std::string> bytes = readFile(file);
  return bytes && bytes->size() == recorded.bytes && crcOf(*bytes) == recorded.crc;
}

Result<void> ExportRecord::checkUnchanged(const fs::path& folder) const {
  std::set<fs::path> folders;
  for (const auto& [name, file] : files_) {
    for (fs::path parent = name.parent_path(); !parent.empty(); parent = parent.parent_path())
      folders.insert(parent);
  }
  const auto refuse = [](const fs::path& path, const char* why) {
    return fail(path.string() + " " + why + ", so the data set is not replaced. Nothing was written.",
                "Move it elsewhere, or give another folder for the export.");
  };
  std::error_code failure;
  for (fs::recursive_directory_iterator entry(folder, failure), end; !failure && entry != end;
       entry.increment(failure)) {
    const fs::path name = entry->path().lexically_relative(folder);
    if (name == kFile || (name == StagedFolder::kMarker && hasOurMarker(folder))) continue;
    std::error_code unknown;
    if (entry->symlink_status(unknown).type() == fs::file_type::directory) {
      if (!folders.contains(name)) return refuse(entry->path(), "was not made by the last export");
      continue;
    }
    const auto recorded = files_.find(name);
    if (recorded == files_.end()) return refuse(entry->path(), "was not written by the last export");
    if (!isUnchanged(entry->path(), recorded->second))
      return refuse(entry->path(), "was changed since the last export");
  }
  if (failure) {
    return fail("Cannot read the folder " + folder.string() + ": " + failure.message() + ".",
                "Check that it can be read, or give another folder for the export.");
  }
  return {};
}

bool ExportRecord::removeFrom(const fs::path& folder) const {
  std::error_code ignored;
  std::set<fs::path> folders;  // a parent before what it holds
  for (const auto& [name, file] : files_) {
    if (isReachedWithoutLinks(folder, name) && isUnchanged(folder / name, file))
      fs::remove(folder / name, ignored);
    for (fs::path parent = name.parent_path(); !parent.empty(); parent = parent.parent_path())
      folders.insert(parent);
  }
  for (auto name = folders.rbegin(); name != folders.rend(); ++name) {
    if (isReachedWithoutLinks(folder, *name) && isRealFolder(folder / *name))
      fs::remove(folder / *name, ignored);
  }
  // The record and the marker go last, so that a removal that was killed can go on.
  std::size_t rest = 0;
  for (fs::directory_iterator entry(folder, ignored), end; !ignored && entry != end;
       entry.increment(ignored)) {
    const fs::path name = entry->path().filename();
    rest += name == kFile || (name == StagedFolder::kMarker && hasOurMarker(folder)) ? 0 : 1;
  }
  if (ignored || rest > 0) return false;
  fs::remove(folder / kFile, ignored);
  removeOurMarker(folder);
  return fs::remove(folder, ignored);
}

}  // namespace scantrove
