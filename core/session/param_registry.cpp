#include "core/session/param_registry.h"

// toml++ asserts a condition of table names that it reports as an error one line later. The error is
// enough.
#define TOML_ASSERT(condition) static_assert(true)
#include <toml++/toml.h>

#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>
#include <numeric>
#include <string_view>

#include "core/base/regular_file.h"

namespace scantrove {
namespace {

constexpr const char* kNoFile = "off";
constexpr const char* kAutomaticText = "auto";

template <class Group, class Value>
ParamInfo number(std::string key, Group ScanParams::*group, Value Group::*member, std::string unit,
                 double minimum, double maximum, std::string help) {
  ParamInfo info{std::move(key),
                 std::move(unit),
                 minimum,
                 maximum,
                 std::is_integral_v<Value>,
                 false,
                 std::move(help),
                 {},
                 {},
                 {},
                 {}};
  info.get = [=](const ScanParams& params) { return static_cast<double>(params.*group.*member); };
  info.set = [=](ScanParams& params, double value) { params.*group.*member = static_cast<Value>(value); };
  if constexpr (std::is_same_v<Value, bool>) info.choices = {"false", "true"};
  return info;
}

template <class Group, class Value>
ParamInfo choice(std::string key, Group ScanParams::*group, Value Group::*member,
                 std::vector<std::string> choices, std::string help) {
  const auto last = static_cast<double>(choices.size() - 1);
  ParamInfo info{std::move(key), "", 0, last, true, false, std::move(help), std::move(choices), {}, {}, {}};
  info.get = [=](const ScanParams& params) { return static_cast<double>(params.*group.*member); };
  info.set = [=](ScanParams& params, double value) {
    params.*group.*member = static_cast<Value>(static_cast<int>(value));
  };
  return info;
}

template <class Group>
ParamInfo fileName(std::string key, Group ScanParams::*group, std::string Group::*member, std::string help) {
  ParamInfo info{std::move(key), "", 0, 0, false, false, std::move(help), {}, {}, {}, {}};
  info.get = [](const ScanParams&) { return 0.0; };
  info.set = [](ScanParams&, double) {};
  info.file = [=](ScanParams& params) -> std::string& { return params.*group.*member; };
  return info;
}

ParamInfo orAutomatic(ParamInfo info) {
  info.can_be_automatic = true;
  return info;
}

std::vector<ParamInfo> makeRegistry() {
  using F = FusionParams;
  using S = SegmentationParams;
  using L = LabelingParams;
  using D = DiscoveryParams;
  using C = DetectionParams;
  F ScanParams::*const f = &ScanParams::fusion;
  S ScanParams::*const s = &ScanParams::segmentation;
  L ScanParams::*const l = &ScanParams::labeling;
  D ScanParams::*const d = &ScanParams::discovery;
  const auto c = &ScanParams::detection;
  return {
      orAutomatic(number("fusion.voxel_size_m", f, &F::voxel_size_m, "m", 0.001, 0.1,
                         "side of a voxel of the map (auto: by the footprint of a depth pixel)")),
      orAutomatic(number("fusion.min_depth_m", f, &F::min_depth_m, "m", 0, 5,
                         "nearer readings are ignored (auto: 0.3 m, less on close-ups)")),
      orAutomatic(number("fusion.max_depth_m", f, &F::max_depth_m, "m", 0.2, 20,
                         "farther readings are ignored (auto: 5 m, more in halls)")),
      number("fusion.memory_budget_mb", f, &F::memory_budget_mb, "MiB", 0, 1000000,
             "memory of the map; the rest is stored on disk (0: a quarter of the machine's)"),
      number("fusion.working_width", f, &F::working_width, "px", 40, 1920,
             "width of the images in which tracking and segmentation run"),
      choice("segmentation.rule", s, &S::rule, {"graph", "whole"},
             "graph: by the shape of the surface; whole: all surface is one object (scan --object)"),
      number("segmentation.k", s, &S::k, "", 1e-6, 10, "larger k, larger segments (thesis eq. 3.4)"),
      number("segmentation.min_pixels", s, &S::min_pixels, "px", 0, 10000, "smaller segments are absorbed"),
      choice("labeling.rule", l, &L::rule, {"graph", "thesis"},
             "graph: regions join and split by all evidence; thesis: regions join once, for good"),
      number("labeling.joining_bias", l, &L::joining_bias, "", -20, 20,
             "above 0: fragments join more readily (log-odds)"),
      number("discovery.min_size_m", d, &D::min_size_m, "m", 0.001, 10, "minimum object size, longest side"),
      number("discovery.max_size_m", d, &D::max_size_m, "m", 0.01, 10, "maximum object size, longest side"),
      number("discovery.persistent_frames", d, &D::persistent_frames, "frames", 1, 1000,
             "frames with a stable size before a region becomes a candidate"),
      number("detection.max_distance", c, &C::max_distance, "", 0, 2,
             "below: recognised (0 = same picture, 2 = unrelated)"),
      number("detection.max_views", c, &C::max_views, "views", 1, 1000, "views stored per object"),
      fileName("recognition.model", c, &C::model,
               "an ONNX network that also compares objects; FILE.json beside it"),
  };
}

/// Edit distance, to suggest the intended key.
std::size_t editDistance(const std::string& a, const std::string& b) {
  std::vector<std::size_t> row(b.size() + 1);
  std::iota(row.begin(), row.end(), 0U);
  for (std::size_t i = 1; i <= a.size(); ++i) {
    std::size_t diagonal = row[0];
    row[0] = i;
    for (std::size_t j = 1; j <= b.size(); ++j) {
      const std::size_t above = row[j];
      row[j] = std::min({above + 1, row[j - 1] + 1, diagonal + (a[i - 1] == b[j - 1] ? 0U : 1U)});
      diagonal = above;
    }
  }
  return row[b.size()];
}

/// Up to three keys like `key`: those that contain it (the group is missing), then by edit distance.
std::string similarKeys(const std::string& key) {
  std::vector<std::pair<std::size_t, std::string>> near;
  for (const ParamInfo& info : paramRegistry()) {
    const std::size_t distance = info.key.find(key) != std::string::npos ? 0 : editDistance(info.key, key);
    if (distance <= info.key.size() / 4) near.emplace_back(distance, info.key);
  }
  std::ranges::stable_sort(near, {}, &std::pair<std::size_t, std::string>::first);
  near.resize(std::min<std::size_t>(near.size(), 3));
  std::string list;
  for (const auto& [distance, name] : near) list += (list.empty() ? "'" : " or '") + name + "'";
  return list;
}

Result<const ParamInfo*> findParam(const std::string& key) {
  const auto& registry = paramRegistry();
  const auto found = std::ranges::find(registry, key, &ParamInfo::key);
  if (found != registry.end()) return &*found;
  const std::string similar = similarKeys(key);
  return fail(
      "There is no parameter '" + key + "'.",
      (similar.empty() ? "" : "Did you mean " + similar + "? ") + "'scantrove params' lists them all.");
}

/// The shortest text that reads as the same number: continuing a session requires exactly its voxel size.
std::string plain(double value) {
  std::array<char, 400> text{};
  const auto write = [&](auto number) {
    return std::to_chars(text.data(), text.data() + text.size(), number, std::chars_format::fixed).ptr;
  };
  const auto single = static_cast<float>(value);
  return {text.data(), static_cast<double>(single) == value ? write(single) : write(value)};
}

Result<void> setNumber(ScanParams& params, const ParamInfo& info, double value) {
  if (!(value >= info.minimum && value <= info.maximum)) {
    return fail("The value " + plain(value) + " of '" + info.key + "' is out of range.",
                "It must lie between " + plain(info.minimum) + " and " + plain(info.maximum) + ".");
  }
  if (info.is_integer && value != std::floor(value)) {
    return fail("The value " + plain(value) + " of '" + info.key + "' is not a whole number.",
                "Give one from " + plain(info.minimum) + " to " + plain(info.maximum) + ".");
  }
  info.set(params, value);
  return {};
}

Result<void> setFile(ScanParams& params, const ParamInfo& info, const std::string& text) {
  if (text == kNoFile) {
    info.file(params).clear();
    return {};
  }
  const bool is_in_line = std::ranges::none_of(text, [](char c) { return c >= 0 && c < ' '; });
  std::error_code error;
  const std::filesystem::path path = std::filesystem::absolute(text, error);
  if (text.empty() || !is_in_line || error) {
    return fail("'" + text + "' of '" + info.key + "' is no file.",
                "Name a file, or write " + info.key + "=" + kNoFile + ".");
  }
  info.file(params) = path.lexically_normal().string();
  return {};
}

Result<void> setText(ScanParams& params, const ParamInfo& info, const std::string& text) {
  if (info.file) return setFile(params, info, text);
  if (!info.choices.empty()) {
    const auto found = std::find(info.choices.begin(), info.choices.end(), text);
    if (found != info.choices.end()) {
      info.set(params, static_cast<double>(found - info.choices.begin()));
      return {};
    }
    std::string words;
    for (const std::string& word : info.choices) words += (words.empty() ? "" : ", ") + word;
    return fail("'" + text + "' is no value of '" + info.key + "'.", "Choose one of: " + words + ".");
  }
  if (info.can_be_automatic && text == kAutomaticText) {
    info.set(params, static_cast<double>(kAutomatic));
    return {};
  }
  double value = 0;
  const char* end = text.data() + text.size();
  const auto [stop, failure] = std::from_chars(text.data(), end, value);
  if (failure != std::errc{} || stop != end || !std::isfinite(value)) {
    return fail("'" + text + "' is no number.",
                "Write " + info.key + "=" + info.text(params) + ", for example.");
  }
  return setNumber(params, info, value);
}

Result<void> setFromToml(ScanParams& params, const ParamInfo& info, const toml::node& node) {
  if (info.file && !node.is_string()) return fail("The parameter '" + info.key + "' is no text.");
  if (const auto text = node.value_exact<std::string>()) return setText(params, info, *text);
  if (const auto flag = node.value_exact<bool>()) return setText(params, info, *flag ? "true" : "false");
  if (const auto value = node.value<double>()) {
    return info.choices.empty() ? setNumber(params, info, *value) : setText(params, info, plain(*value));
  }
  return fail("The parameter '" + info.key + "' is neither a number nor a word.");
}

/// Text that is safe for the parser: toml++ 3.3 has undefined behaviour for non-ASCII letters where a space
/// may stand. They occur in comments, and are replaced by question marks. The path of a file has \uXXXX.
std::string inAscii(std::string text) {
  constexpr std::string_view kByteOrderMark = "\xEF\xBB\xBF";
  if (text.starts_with(kByteOrderMark)) text.erase(0, kByteOrderMark.size());
  std::ranges::replace_if(
      text, [](char c) { return static_cast<unsigned char>(c) > 127; }, '?');
  return text;
}

/// Whether a line joins too many key parts by dots for the recursive parser. A comment counts as part of
/// the line if quotes precede it.
bool hasDeepKey(std::string_view text) {
  constexpr std::ptrdiff_t kMaxDots = 100;
  while (!text.empty()) {
    const std::size_t end = std::min(text.find('\n'), text.size());
    std::string_view line = text.substr(0, end);
    text.remove_prefix(std::min(end + 1, text.size()));
    const std::size_t comment = line.find_first_of("#\"'");
    if (comment != std::string_view::npos && line[comment] == '#') line = line.substr(0, comment);
    if (std::ranges::count(line, '.') > kMaxDots) return true;
  }
  return false;
}

}  // namespace

bool ParamInfo::isAutomatic(const ScanParams& params) const {
  return can_be_automatic && get(params) == static_cast<double>(kAutomatic);
}

std::string ParamInfo::text(const ScanParams& params) const {
  if (isAutomatic(params)) return kAutomaticText;
  if (file) {
    ScanParams copy = params;
    return file(copy).empty() ? kNoFile : file(copy);
  }
  const double value = get(params);
  return choices.empty() ? plain(value) : choices[static_cast<std::size_t>(value)];
}

const std::vector<ParamInfo>& paramRegistry() {
  static const std::vector<ParamInfo> registry = makeRegistry();
  return registry;
}

Result<void> applySetting(ScanParams& params, const std::string& setting) {
  const std::size_t equals = setting.find('=');
  if (equals == std::string::npos || equals == 0) {
    return fail("'" + setting + "' is no setting.", "Write key=value, for example segmentation.k=0.02.");
  }
  const Result<const ParamInfo*> info = findParam(setting.substr(0, equals));
  if (!info) return fail(info.error());
  return setText(params, **info, setting.substr(equals + 1));
}

Result<void> loadConfig(ScanParams& params, const std::filesystem::path& file) {
  constexpr std::size_t kLargest_bytes = 65536;
  const Result<std::string> text = readFile(file, kLargest_bytes + 1);
  if (!text) return fail(text.error());
  if (text->size() > kLargest_bytes) {
    return fail("The configuration " + file.string() + " is larger than 64 KiB.",
                "'scantrove params' shows what such a file may hold.");
  }
  if (hasDeepKey(*text)) {
    return fail("The configuration " + file.string() + " holds a key of too many parts.",
                "A key is 'group.name'; 'scantrove params' lists them.");
  }
  toml::table table;
  try {
    table = toml::parse(inAscii(*text), file.string());
  } catch (const toml::parse_error& error) {
    return fail("The configuration " + file.string() +
                    " cannot be read: " + std::string(error.description()) + " (line " +
                    std::to_string(error.source().begin.line) + ").",
                "'scantrove params' shows what such a file may hold.");
  }
  ScanParams changed = params;
  for (const auto& [group, node] : table) {
    const toml::table* entries = node.as_table();
    if (entries == nullptr)
      return fail("In " + file.string() + ": '" + std::string(group.str()) + "' is no table.");
    for (const auto& [name, value] : *entries) {
      const Result<const ParamInfo*> info =
          findParam(std::string(group.str()) + "." + std::string(name.str()));
      Result<void> done = info ? setFromToml(changed, **info, value) : Result<void>(fail(info.error()));
      if (!done) {
        return fail("In " + file.string() + ", line " + std::to_string(value.source().begin.line) + ": " +
                        done.error().what,
                    done.error().advice);
      }
    }
  }
  params = changed;
  return {};
}

}  // namespace scantrove
