#include "core/capture/nyu_raw_names.h"

#include <algorithm>
#include <cmath>
#include <tuple>

#include "core/base/text.h"
#include "core/capture/folder_listing.h"

namespace scantrove {
namespace {

/// Colour arrives at 20 to 30 Hz; one further away shows another moment.
constexpr double kFarthestColor_s = 0.1;

bool isMadeOf(std::string_view text, std::string_view characters) {
  return !text.empty() && text.find_first_not_of(characters) == std::string_view::npos;
}

/// Removes `end` from the end of `text`.
bool dropEnd(std::string_view& text, std::string_view end) {
  if (!text.ends_with(end)) return false;
  text.remove_suffix(end.size());
  return true;
}

std::optional<NyuFileKind> kindOf(std::string_view& name) {
  if (name.starts_with("d-") && dropEnd(name, ".pgm")) return NyuFileKind::depth;
  if (name.starts_with("r-") && dropEnd(name, ".ppm")) return NyuFileKind::color;
  if (name.starts_with("a-") && dropEnd(name, ".dump")) return NyuFileKind::acceleration;
  return std::nullopt;
}

struct TimedName {
  double time_s = 0;
  std::string name;
  bool operator<(const TimedName& other) const {
    return std::tie(time_s, name) < std::tie(other.time_s, other.name);
  }
};

std::vector<TimedName> namesOfKind(const std::vector<std::string>& names, NyuFileKind kind) {
  std::vector<TimedName> timed;
  for (const std::string& name : names) {
    const auto parts = nyuFileName(name);
    if (parts && parts->kind == kind) timed.push_back({parts->time_s, name});
  }
  std::sort(timed.begin(), timed.end());
  return timed;
}

/// The name nearest in time; empty if none is near enough. `names` are sorted.
std::string nearestName(const std::vector<TimedName>& names, double time_s) {
  const auto after = std::ranges::lower_bound(names, time_s, {}, &TimedName::time_s);
  const auto distance = [&](auto it) { return std::abs(it->time_s - time_s); };
  auto nearest = after;
  if (after != names.begin() && (after == names.end() || distance(after - 1) <= distance(after)))
    nearest = after - 1;
  return nearest == names.end() || distance(nearest) > kFarthestColor_s ? std::string() : nearest->name;
}

/// The folders in `folder` by name; empty if it cannot be read.
std::vector<std::filesystem::path> subfolders(const std::filesystem::path& folder) {
  std::vector<std::filesystem::path> found;
  for (const std::string& name : listFolder(folder).value_or(std::vector<std::string>())) {
    if (nyuFileName(name)) return found;  // a scene: it has thousands of images and no folders
    std::error_code ignored;
    if (std::filesystem::is_directory(folder / name, ignored)) found.push_back(folder / name);
  }
  return found;
}

}  // namespace

std::optional<NyuFileName> nyuFileName(std::string_view name) {
  constexpr std::size_t kLongestNumber = 20;
  const auto kind = kindOf(name);
  if (!kind || name.size() < 3) return std::nullopt;
  name.remove_prefix(2);
  const std::size_t dash = name.find('-');
  if (dash == std::string_view::npos || dash > kLongestNumber) return std::nullopt;
  const std::string_view time = name.substr(0, dash), ticks = name.substr(dash + 1);
  if (!isMadeOf(time, "0123456789.") || !isMadeOf(ticks, "0123456789") || ticks.size() > kLongestNumber)
    return std::nullopt;
  const auto number = parseNumbers(time);
  if (!number || number->size() != 1 || !std::isfinite(number->front())) return std::nullopt;
  return NyuFileName{*kind, number->front()};
}

std::vector<NyuRawPair> nyuRawPairs(const std::vector<std::string>& names) {
  const std::vector<TimedName> colors = namesOfKind(names, NyuFileKind::color);
  std::vector<NyuRawPair> pairs;
  for (TimedName& depth : namesOfKind(names, NyuFileKind::depth))
    pairs.push_back({depth.time_s, std::move(depth.name), nearestName(colors, depth.time_s)});
  return pairs;
}

Result<std::map<std::string, std::filesystem::path>> nyuSceneFolders(const std::filesystem::path& root) {
  const auto names = listFolder(root);
  if (!names) return fail(names.error());
  std::map<std::string, std::filesystem::path> scenes{{folderName(root), root}};
  for (const std::filesystem::path& folder : subfolders(root)) {
    scenes.emplace(folder.filename().string(), folder);
    for (const std::filesystem::path& inner : subfolders(folder))
      scenes.emplace(inner.filename().string(), inner);
  }
  return scenes;
}

}  // namespace scantrove
