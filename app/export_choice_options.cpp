#include "app/export_choice_options.h"

#include <algorithm>
#include <array>
#include <cstddef>
#include <set>
#include <utility>

namespace scantrove {
namespace {

CLI::Option* addNames(CLI::App& command, const std::string& name, std::vector<std::string>& target,
                      const std::string& help, const std::string& type) {
  return command.add_option(name, target, help)->allow_extra_args(false)->type_name(type);
}

/// The shares of an option that was checked to be one.
SplitShares checkedShares(const std::string& text) {
  return parseSplitShares(text).value_or(SplitShares{1, 0, 0});
}

std::array<std::pair<DatasetSplit, const std::vector<std::string>*>, 3> givenScans(
    const ExportChoiceOptions& options) {
  return {{{DatasetSplit::train, &options.train},
           {DatasetSplit::val, &options.val},
           {DatasetSplit::test, &options.test}}};
}

}  // namespace

void ExportChoiceOptions::addTo(CLI::App& command) {
  command.add_option("--only", only, "labels to export: with a name, confirmed objects, or all (default)")
      ->check(CLI::IsMember({"named", "confirmed", "all"}))
      ->type_name("named|confirmed|all");
  command.add_flag("--named-only", named_only, "the same as --only named");
  command.add_flag("--confirmed-only", confirmed_only, "the same as --only confirmed");
  addNames(command, "--class", classes, "export only this class; may be repeated", "NAME");
  command
      .add_option("--unlabeled", unlabeled,
                  "objects in images without a label: count them (warn, default), mark them as regions to "
                  "ignore (coco, masks, voc), or leave them")
      ->check(CLI::IsMember({"warn", "ignore", "leave"}))
      ->type_name("warn|ignore|leave");
  addNames(command, "--scan", scans, "with --project: export only this scan; may be repeated", "NAME");
  command
      .add_option("--split", split,
                  "with --project: draw scans for the splits; else the last frames of the scan are for "
                  "validation (yolo, voc)")
      ->type_name("train=0.8,val=0.1,test=0.1");
  seed_option = command.add_option("--seed", seed, "of the draw by --split (default 0)")->type_name("N");
  addNames(command, "--train", train, "with --project: this scan is for training; may be repeated", "SCAN");
  addNames(command, "--val", val, "with --project: this scan is for validation; may be repeated", "SCAN");
  addNames(command, "--test", test, "with --project: this scan is for tests; may be repeated", "SCAN");
}

bool ExportChoiceOptions::isAny() const {
  const bool is_split = !split.empty() || seed_option->count() > 0 || !scanSplit().by_scan.empty();
  return !only.empty() || named_only || confirmed_only || !classes.empty() || !unlabeled.empty() ||
         !scans.empty() || is_split;
}

void ExportChoiceOptions::check(bool is_project, const std::string& format) const {
  if ((only.empty() ? 0 : 1) + (named_only ? 1 : 0) + (confirmed_only ? 1 : 0) > 1)
    throw CLI::ValidationError("--only", "is given twice. --named-only and --confirmed-only mean the same");
  const auto by_scan = scanSplit().by_scan;
  if (!is_project && (!scans.empty() || !by_scan.empty()))
    throw CLI::ValidationError("--scan", "and --train, --val and --test need --project");
  if (!split.empty() && !by_scan.empty())
    throw CLI::ValidationError("--split", "draws scans; it cannot be combined with --train, --val or --test");
  if (seed_option->count() > 0 && (split.empty() || !is_project))
    throw CLI::ValidationError("--seed", "needs --project and --split");
  std::set<std::string> known;
  for (const auto& [one, names] : givenScans(*this)) {
    for (const std::string& name : *names) {
      if (!known.insert(name).second)
        throw CLI::ValidationError("--" + splitName(one), "the scan " + name + " is given twice");
      if (!scans.empty() && std::ranges::find(scans, name) == scans.end())
        throw CLI::ValidationError("--" + splitName(one),
                                   "the scan " + name + " is not among those of --scan");
    }
  }
  if (split.empty()) return;
  const auto shares = parseSplitShares(split);
  if (!shares) throw CLI::ValidationError("--split", shares.error().message());
  if (is_project) return;
  if (format != "yolo" && format != "voc")
    throw CLI::ValidationError("--split",
                               "of one scan needs --format yolo or voc; other formats have no split");
  if ((*shares)[static_cast<std::size_t>(DatasetSplit::test)] > 0)
    throw CLI::ValidationError("--split",
                               "of one scan has train and val only; frames of one scan are no test");
}

ExportChoices ExportChoiceOptions::choices() const {
  ExportChoices choices;
  if (named_only || only == "named") choices.labels = ExportedLabels::named;
  if (confirmed_only || only == "confirmed") choices.labels = ExportedLabels::confirmed;
  choices.classes = classes;
  if (unlabeled == "ignore") choices.unlabeled = UnlabeledObjects::ignore;
  if (unlabeled == "leave") choices.unlabeled = UnlabeledObjects::leave;
  if (!split.empty())
    choices.validation_share = checkedShares(split)[static_cast<std::size_t>(DatasetSplit::val)];
  return choices;
}

ScanSplit ExportChoiceOptions::scanSplit() const {
  ScanSplit result;
  if (!split.empty()) result.shares = checkedShares(split);
  result.seed = seed;
  for (const auto& [one, names] : givenScans(*this)) {
    for (const std::string& name : *names) result.by_scan[name] = one;
  }
  return result;
}

std::vector<std::string> ExportChoiceOptions::scanNames() const {
  if (!scans.empty()) return scans;
  std::vector<std::string> names;
  for (const auto& [name, one] : scanSplit().by_scan) names.push_back(name);
  return names;
}

}  // namespace scantrove
