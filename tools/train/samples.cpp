#include "tools/train/samples.h"

#include <spdlog/fmt/fmt.h>
#include <spdlog/fmt/ranges.h>

#include <charconv>
#include <cmath>
#include <optional>

#include "core/base/checksum.h"
#include "core/base/regular_file.h"
#include "core/base/text.h"
#include "core/discovery/objectness/objectness_features.h"
#include "core/exchange/atomic_file.h"
#include "core/labeling/border_features.h"

namespace scantrove::train {
namespace {

constexpr std::string_view kTitle = "scantrove samples 2";
constexpr std::size_t kHeaderLines = 6;
constexpr std::size_t kMaxBytes = std::size_t{1} << 30U;
constexpr const char* kAdvice = "Delete it; the scene is scanned again.";

/// Names in one line, separated by blanks.
template <class Names>
std::string inOneLine(const Names& names) {
  return fmt::format("{}", fmt::join(names, " "));
}

/// The words of a line, read from left to right.
class Words {
 public:
  explicit Words(std::string_view line) : rest_(line) {}

  /// Empty: there are no more.
  std::string_view next() {
    rest_ = trimmed(rest_);
    const std::string_view word = rest_.substr(0, rest_.find(' '));
    rest_.remove_prefix(word.size());
    return word;
  }
  template <class Number>
  [[nodiscard]] bool read(Number& number) {
    const std::string_view word = next();
    const auto [end, error] = std::from_chars(word.data(), word.data() + word.size(), number);
    return !word.empty() && error == std::errc() && end == word.data() + word.size();
  }
  /// `count` features, each finite or NaN, and then the end of the line.
  [[nodiscard]] bool readToEnd(std::size_t count, std::vector<float>& features) {
    features.resize(count);
    for (float& feature : features)
      if (!read(feature) || std::isinf(feature)) return false;
    return next().empty();
  }
  /// What follows, without blanks at its ends.
  [[nodiscard]] std::string_view rest() const { return trimmed(rest_); }

 private:
  std::string_view rest_;
};

std::optional<ObjectnessSample> objectnessSampleOf(Words words) {
  ObjectnessSample sample;
  std::size_t regions = 0;
  if (!words.read(sample.frame) || !words.read(sample.object) || !words.read(sample.overlap) ||
      !words.read(regions))
    return std::nullopt;
  for (std::uint32_t region = 0; sample.regions.size() < regions; sample.regions.push_back(region))
    if (!words.read(region)) return std::nullopt;
  if (!words.readToEnd(kObjectnessFeatures.size(), sample.x)) return std::nullopt;
  return sample;
}

std::optional<BorderSample> borderSampleOf(Words words) {
  BorderSample sample;
  int is_same = 0;
  if (!words.read(is_same) || is_same < 0 || is_same > 1) return std::nullopt;
  sample.is_same_object = is_same == 1;
  if (!words.readToEnd(kBorderFeatures.size(), sample.x)) return std::nullopt;
  return sample;
}

/// The text before its last line, if that line confirms it; empty: damaged.
std::string_view confirmed(std::string_view text) {
  if (text.empty() || text.back() != '\n') return {};
  const std::size_t end = text.rfind('\n', text.size() - 2);
  if (end == std::string_view::npos) return {};
  const std::string_view before = text.substr(0, end + 1);
  return text.substr(end + 1) == fmt::format("end {:08x}\n", crc32Of(before)) ? before : std::string_view();
}

/// The value of a header line; empty: the line has another name.
std::string_view valueOf(std::string_view line, std::string_view name) {
  Words words(line);
  return words.next() == name ? words.rest() : std::string_view();
}

/// Error: the file has others than the program computes.
Result<void> checkSampledFeatures(std::string_view in_file, const std::string& computed,
                                  const std::filesystem::path& file) {
  if (in_file == computed) return {};
  return fail(file.string() + " holds samples of other features than the program computes.", kAdvice);
}

}  // namespace

std::string textOf(const SceneSamples& samples) {
  const auto& [scene, frames, commit] = samples.origin;
  std::string text =
      fmt::format("{}\nscene {}\nframes {}\ncommit {}\nobjectness {}\nborders {}\n", kTitle, scene, frames,
                  commit, inOneLine(namesOf(kObjectnessFeatures)), inOneLine(namesOf(kBorderFeatures)));
  for (const ObjectnessSample& sample : samples.objectness) {
    text += fmt::format("o {} {} {} {}", sample.frame, sample.object, sample.overlap, sample.regions.size());
    for (const std::uint32_t region : sample.regions) text += fmt::format(" {}", region);
    text += fmt::format(" {}\n", inOneLine(sample.x));
  }
  for (const BorderSample& sample : samples.borders)
    text += fmt::format("b {:d} {}\n", sample.is_same_object ? 1 : 0, inOneLine(sample.x));
  return text + fmt::format("end {:08x}\n", crc32Of(text));
}

Result<SceneSamples> parseSamples(std::string_view text, const std::filesystem::path& file) {
  if (text.substr(0, text.find('\n')) != kTitle)
    return fail(file.string() + " is no file of samples, or one of another version.", kAdvice);
  const std::vector<std::string_view> lines = splitLines(confirmed(text));
  const auto damaged = [&file] { return fail(file.string() + " is damaged.", kAdvice); };
  if (lines.size() < kHeaderLines) return damaged();
  SceneSamples samples;
  samples.origin.scene = valueOf(lines[1], "scene");
  samples.origin.commit = valueOf(lines[3], "commit");
  if (samples.origin.scene.empty() || !Words(valueOf(lines[2], "frames")).read(samples.origin.frames))
    return damaged();
  SCANTROVE_TRY(
      checkSampledFeatures(valueOf(lines[4], "objectness"), inOneLine(namesOf(kObjectnessFeatures)), file));
  SCANTROVE_TRY(
      checkSampledFeatures(valueOf(lines[5], "borders"), inOneLine(namesOf(kBorderFeatures)), file));
  for (const std::string_view line : std::span(lines).subspan(kHeaderLines)) {
    Words words(line);
    const std::string_view kind = words.next();
    if (kind == "o") {
      auto sample = objectnessSampleOf(words);
      if (!sample) return damaged();
      samples.objectness.push_back(std::move(*sample));
    } else {
      auto sample = kind == "b" ? borderSampleOf(words) : std::nullopt;
      if (!sample) return damaged();
      samples.borders.push_back(std::move(*sample));
    }
  }
  return samples;
}

Result<void> writeSamples(const std::filesystem::path& file, const SceneSamples& samples) {
  return writeFileAtomically(file, textOf(samples));
}

Result<SceneSamples> readSamples(const std::filesystem::path& file) {
  const Result<std::string> text = readFile(file, kMaxBytes);
  if (!text) return fail(text.error());
  return parseSamples(*text, file);
}

}  // namespace scantrove::train
