#include "core/dataset/export_scans.h"

#include <spdlog/fmt/fmt.h>

#include <algorithm>
#include <map>
#include <set>
#include <string_view>
#include <utility>

#include "core/base/check.h"
#include "core/dataset/region_choice.h"
#include "core/dataset/scan_prefix.h"

namespace scantrove {
namespace {

std::string listOfNames(const std::vector<std::string>& names) {
  std::string text;
  for (const std::string& name : names) text += (text.empty() ? "" : ", ") + name;
  return text;
}

/// The visible classes by id.
std::map<std::uint32_t, std::string> visibleNames(const std::vector<ObjectClass>& classes) {
  std::map<std::uint32_t, std::string> names;
  for (const ObjectClass& one : classes) {
    if (!one.hidden) names[one.id.value] = one.name;
  }
  return names;
}

/// Formats have a folder for each scan; FoundationPose replaces every "rgb" in a path.
std::string withoutRgb(std::string name) {
  for (std::size_t at = 0; (at = name.find("rgb", at)) != std::string::npos; at += 5)
    name.replace(at, 3, "r_g_b");
  return name;
}

std::vector<std::string> namesOf(const std::vector<ScanToExport>& scans) {
  std::vector<std::string> names;
  for (const ScanToExport& scan : scans) names.push_back(scan.name);
  return names;
}

}  // namespace

std::string DatasetPart::folder() const {
  if (prefix.empty()) return {};
  return (split ? splitName(*split) + "/" : "") + withoutRgb(prefix) + "/";
}

ExportScans::ExportScans(LabeledScan& scan) : title_(scan.name()) {
  // Not owned: the caller keeps the scan.
  const std::shared_ptr<LabeledScan> shared(std::shared_ptr<void>(), &scan);
  sources_.push_back({title_, [shared]() -> Result<std::shared_ptr<LabeledScan>> { return shared; }});
}

ExportScans::ExportScans(ProjectToExport project)
    : title_(std::move(project.name)),
      is_project_(true),
      split_(std::move(project.split)),
      sources_(std::move(project.scans)) {
  std::ranges::sort(sources_, {}, &ScanToExport::name);
}

Result<void> ExportScans::read(const ExportOptions& options, bool needs_regions, const BeforeScan& before,
                               std::vector<std::string>& notes) {
  if (sources_.empty())
    return fail("The project " + title_ + " has no scans: there is nothing to export.",
                "Scan something into it first, with 'scantrove project scan'.");
  for (const auto& [scan, split] : split_.by_scan) {
    if (std::ranges::find(sources_, scan, &ScanToExport::name) == sources_.end()) {
      return fail("There is no scan " + scan + " among those to export, but it was given for " +
                      splitName(split) + ".",
                  "Scans: " + listOfNames(namesOf(sources_)) + ".");
    }
  }
  int done = 0;
  for (const ScanToExport& source : sources_) {
    const std::string what = is_project_ ? "regions of " + source.name : "regions";
    SCANTROVE_TRY(before(done++, static_cast<int>(sources_.size()), what));
    SCANTROVE_TRY(readOne(source, options));
  }
  SCANTROVE_TRY(checkChosenClasses(options.choices));
  if (is_project_) {
    const std::vector<std::string> prefixes = scanPrefixes(namesOf(sources_));
    for (std::size_t i = 0; i < parts_.size(); ++i) parts_[i].prefix = prefixes[i];
    if (needs_regions) SCANTROVE_TRY(leaveOutEmpty(options, notes));
    SCANTROVE_TRY(splitScans(notes));
    numberParts();
  }
  return {};
}

Result<void> ExportScans::readOne(const ScanToExport& source, const ExportOptions& options) {
  const auto scan = source.open();
  if (!scan) return fail(scan.error());
  auto regions = (*scan)->regions();
  if (!regions) return fail(regions.error());
  std::ranges::sort(*regions, {}, &LabeledRegion::id);
  RegionChoice choice = chooseRegions(*regions, options.background, options.choices);
  DatasetPart part;
  part.name = source.name;
  part.origin = (*scan)->origin();
  part.all = std::move(*regions);
  part.chosen = std::move(choice.exported);
  part.unlabeled = std::move(choice.unlabeled);
  parts_.push_back(std::move(part));
  return takeClasses(source.name, (*scan)->classes());
}

Result<void> ExportScans::takeClasses(const std::string& scan, const std::vector<ObjectClass>& classes) {
  const auto known = visibleNames(classes_);
  for (const auto& [id, name] : visibleNames(classes)) {
    const auto found = known.find(id);
    if (found == known.end() || found->second == name) continue;
    return fail(fmt::format("The scan {} has another list of classes than the scans before it: class {} is "
                            "\"{}\", not \"{}\".",
                            scan, id, name, found->second),
                "Scans of one data set need one catalogue. Export this scan apart.");
  }
  if (classes_.size() < classes.size()) classes_ = classes;
  return {};
}

Result<void> ExportScans::checkChosenClasses(const ExportChoices& choices) const {
  if (choices.classes.empty()) return {};
  std::set<std::string> known;
  for (const auto& [id, name] : visibleNames(classes_)) known.insert(validUtf8(name));
  for (const DatasetPart& part : parts_) {
    for (const LabeledRegion& region : part.all) {
      if (isNamed(region)) known.insert(classOf(region));
    }
  }
  for (const std::string& name : choices.classes) {
    if (known.contains(name)) continue;
    return fail("There is no class \"" + name + "\".",
                known.empty() ? "Nothing has a class or a name yet."
                              : "Classes: " + listOfNames({known.begin(), known.end()}) + ".");
  }
  return {};
}

Result<void> ExportScans::leaveOutEmpty(const ExportOptions& options, std::vector<std::string>& notes) {
  std::optional<Error> first;
  for (std::size_t i = 0; i < parts_.size();) {
    if (!parts_[i].chosen.empty()) {
      ++i;
      continue;
    }
    Error why = nothingToExport(parts_[i].name, options);
    if (const auto given = split_.by_scan.find(parts_[i].name); given != split_.by_scan.end()) {
      why.what += " It was given for " + splitName(given->second) + ".";
      return fail(std::move(why));
    }
    notes.push_back(why.what);
    if (!first) first = std::move(why);
    parts_.erase(parts_.begin() + static_cast<std::ptrdiff_t>(i));
    sources_.erase(sources_.begin() + static_cast<std::ptrdiff_t>(i));
  }
  if (!parts_.empty()) return {};
  return fail("Nothing in the project " + title_ + " is to be exported. " + first->what, first->advice);
}

Result<void> ExportScans::splitScans(std::vector<std::string>& notes) {
  std::map<std::string, DatasetSplit> splits = split_.by_scan;
  if (splits.empty() && split_.shares) splits = drawSplit(namesOf(sources_), *split_.shares, split_.seed);
  if (splits.empty()) return {};
  std::set<DatasetSplit> used;
  for (DatasetPart& part : parts_) {
    const auto found = splits.find(part.name);
    if (found == splits.end()) {
      return fail("The scan " + part.name + " is in none of train, val and test.",
                  "Give it for one of them, or choose scans without it.");
    }
    part.split = found->second;
    used.insert(found->second);
  }
  for (const DatasetSplit split : kAllSplits) {
    const bool is_wanted = split_.shares && (*split_.shares)[static_cast<std::size_t>(split)] > 0;
    if (is_wanted && split_.by_scan.empty() && !used.contains(split)) {
      notes.push_back("There are too few scans for " + splitName(split) +
                      ": a scan is never divided, so that split is empty.");
    }
  }
  return {};
}

void ExportScans::numberParts() {
  std::uint32_t offset = 0;
  int number = 0;
  for (DatasetPart& part : parts_) {
    part.number = ++number;
    part.id_offset = offset;
    offset += part.all.empty() ? 0 : part.all.back().id;
  }
}

std::vector<LabeledRegion> ExportScans::chosen() const {
  std::vector<LabeledRegion> regions;
  for (const DatasetPart& part : parts_)
    regions.insert(regions.end(), part.chosen.begin(), part.chosen.end());
  return regions;
}

Result<void> ExportScans::forEach(const std::function<Result<void>()>& use) {
  for (current_ = 0; current_ < parts_.size(); ++current_) {
    open_.reset();  // a device may not hold the maps of two scans
    SCANTROVE_TRY(moveInto(open_, sources_[current_].open()));
    SCANTROVE_TRY(use());
  }
  current_ = 0;
  open_.reset();
  return {};
}

LabeledScan& ExportScans::scan() {
  SCANTROVE_CHECK(open_ != nullptr);
  return *open_;
}

Error nothingToExport(const std::string& scan, const ExportOptions& options) {
  const ExportChoices& choices = options.choices;
  if (!choices.classes.empty()) {
    return {"Nothing in the scan " + scan +
                " is to be exported: no region of it that could be is of the class " +
                listOfNames(choices.classes) + ".",
            "Choose other classes, or all."};
  }
  if (choices.labels == ExportedLabels::confirmed) {
    return {"Nothing in the scan " + scan + " is to be exported: no object of it is confirmed.",
            "Confirm some first, or export those with a name (--only named)."};
  }
  const bool needs_name =
      choices.labels == ExportedLabels::named || choices.unlabeled == UnlabeledObjects::ignore;
  return {needs_name
              ? "Nothing in the scan " + scan + " is to be exported: no region of it has a name."
              : "No region of the scan " + scan + " has a name or is an object: there is nothing to export.",
          options.background ? "Give one a name first."
                             : "Give one a name first, or include background (--background)."};
}

void addToLegend(ExportJson& legend, const ExportJson& of_scan, const DatasetPart& part) {
  for (const auto& [id, entry] : of_scan.items()) {
    ExportJson& added = legend[std::to_string(part.idOf(static_cast<std::uint32_t>(std::stoul(id))))];
    added = entry;
    if (!part.prefix.empty()) added["scan"] = validUtf8(part.name);
  }
}

}  // namespace scantrove
