#include "core/dataset/scan_list.h"

#include <spdlog/fmt/fmt.h>

namespace scantrove {
namespace {

std::string sceneFolderOf(const DatasetPart& part) {
  return (part.split ? splitName(*part.split) + "/" : "") + fmt::format("{:06}/", part.number);
}

ExportJson textIf(bool has, const std::string& text) { return has ? ExportJson(text) : ExportJson(nullptr); }

}  // namespace

Result<void> writeScanList(ExportJob& job) {
  if (!job.scans().isProject()) return {};
  const DatasetFormat format = job.options().format;
  const bool has_folders = !joinsScans(format) || format == DatasetFormat::bop;
  ExportJson list = ExportJson::array();
  for (const DatasetPart& part : job.scans().parts()) {
    const std::string place = placeInDataset(part, format);
    ExportJson entry = ExportJson::object();
    entry["scan"] = validUtf8(part.name);
    entry["prefix"] = textIf(!has_folders, place);
    entry["folder"] = textIf(has_folders, place);
    entry["split"] = part.split ? ExportJson(splitName(*part.split)) : ExportJson(nullptr);
    entry["images"] = part.images;
    list.push_back(std::move(entry));
  }
  return job.write("scans.json", jsonText(list));
}

std::string placeInDataset(const DatasetPart& part, DatasetFormat format) {
  if (format == DatasetFormat::bop) return sceneFolderOf(part);
  return joinsScans(format) ? part.prefix + "_" : part.folder();
}

}  // namespace scantrove
