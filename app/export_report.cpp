#include "app/export_report.h"

#include <spdlog/fmt/fmt.h>

#include <cmath>
#include <iostream>
#include <utility>
#include <vector>

#include "app/command.h"

namespace scantrove {
namespace {

Json countsToJson(const std::vector<ClassCount>& counts) {
  Json classes = Json::array();
  for (const ClassCount& count : counts) {
    classes.push_back({{"name", count.name},
                       {"images", count.images},
                       {"instances", count.instances},
                       {"pixels", count.pixels}});
  }
  return classes;
}

void printCounts(const std::string& split, const std::vector<ClassCount>& counts) {
  for (const ClassCount& count : counts) {
    std::cout << fmt::format("{:<6} {:>8} {:>10} {:>12}  {}\n", split, count.images, count.instances,
                             count.pixels, inLine(count.name));
  }
}

}  // namespace

Json exportToJson(const ExportSummary& summary, const std::string& format, bool is_dry_run) {
  Json splits = Json::array();
  for (const SplitCount& split : summary.splits) {
    splits.push_back({{"split", splitName(split.split)},
                      {"scans", split.scans},
                      {"images", split.images},
                      {"classes", countsToJson(split.classes)}});
  }
  return {{"format", format},
          {"folder", summary.folder.string()},
          {"dry_run", is_dry_run},
          {"scans", summary.scans},
          {"images", summary.images},
          {"regions", summary.regions},
          {"annotations", summary.annotations},
          {"unlabeled", summary.unlabeled},
          {"points", summary.points},
          {"faces", summary.faces},
          {"bytes", summary.bytes},
          {"unfit", summary.unfit},
          {"skipped", summary.skipped},
          {"notes", summary.notes},
          {"classes", countsToJson(summary.classes)},
          {"splits", std::move(splits)}};
}

void printExport(const ExportSummary& summary, const std::string& format, bool is_dry_run) {
  std::cout << format << "     ";
  if (summary.scans > 1) std::cout << summary.scans << " scans, ";
  std::cout << summary.images << " images, " << summary.regions << " regions, " << summary.annotations
            << " annotations";
  if (!summary.classes.empty()) std::cout << " of " << summary.classes.size() << " classes";
  if (summary.points > 0) std::cout << ", " << summary.points << " points";
  if (summary.faces > 0) std::cout << ", " << summary.faces << " faces";
  std::cout << ", " << std::lround(static_cast<double>(summary.bytes) / 1e6) << " MB\n";
  if (!summary.classes.empty()) {
    std::cout << fmt::format("{:<6} {:>8} {:>10} {:>12}  {}\n", "split", "images", "instances", "pixels",
                             "class");
    for (const SplitCount& split : summary.splits) printCounts(splitName(split.split), split.classes);
    printCounts("all", summary.classes);
  }
  std::cout << (is_dry_run ? "results  nothing was written (--dry-run)"
                           : "results  " + inLine(summary.folder.string()))
            << '\n';
}

}  // namespace scantrove
