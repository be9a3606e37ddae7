#include "app/nyu2_results.h"

#include <algorithm>
#include <charconv>
#include <cmath>
#include <utility>

#include "core/base/regular_file.h"
#include "core/exchange/atomic_file.h"

namespace scantrove {
namespace {

namespace fs = std::filesystem;
using Record = nlohmann::ordered_json;

constexpr const char* kProgram = "scantrove evaluate nyu2";

std::optional<std::size_t> countFrom(const std::string& text) {
  std::size_t value = 0;
  const char* const end = text.data() + text.size();
  const auto [stop, error] = std::from_chars(text.data(), end, value);
  return error == std::errc() && stop == end ? std::optional(value) : std::nullopt;
}

Record toRecord(const Nyu2Outcome& outcome) {
  return {outcome.single.all, outcome.single.annotated, outcome.merged.all, outcome.merged.annotated,
          outcome.is_lost ? 1 : 0};
}

std::optional<Nyu2Outcome> outcomeFrom(const Record& numbers) {
  constexpr std::size_t kNumbers = 5;
  if (!numbers.is_array() || numbers.size() != kNumbers) return std::nullopt;
  std::vector<double> values;
  for (const Record& number : numbers) {
    if (!number.is_number()) return std::nullopt;
    values.push_back(number.get<double>());
    if (!std::isfinite(values.back()) || values.back() < 0) return std::nullopt;
  }
  return Nyu2Outcome{{values[0], values[1]}, {values[2], values[3]}, values[4] != 0};
}

/// Empty if something in `record` is no outcome.
std::optional<Nyu2Image> imageFrom(const Record& record) {
  if (!record.is_object()) return std::nullopt;
  Nyu2Image image;
  for (const auto& [key, value] : record.items()) {
    const auto frames = countFrom(key);
    const auto outcome = outcomeFrom(value);
    if (!frames || *frames < 1 || *frames > 1'000'000 || !outcome) return std::nullopt;
    image[static_cast<int>(*frames)] = *outcome;
  }
  return image;
}

std::optional<std::map<std::size_t, Nyu2Image>> imagesFrom(const Record& record) {
  if (!record.is_object()) return std::nullopt;
  std::map<std::size_t, Nyu2Image> images;
  for (const auto& [key, value] : record.items()) {
    const auto number = countFrom(key);
    auto image = imageFrom(value);
    if (!number || !image) return std::nullopt;
    images[*number] = std::move(*image);
  }
  return images;
}

std::optional<std::vector<std::string>> namesFrom(const Record& record) {
  if (!record.is_array()) return std::nullopt;
  std::vector<std::string> names;
  for (const Record& name : record) {
    if (!name.is_string()) return std::nullopt;
    names.push_back(name.get<std::string>());
  }
  return names;
}

tl::unexpected<Error> isDamaged(const fs::path& file) {
  return fail("The record " + file.string() + " is damaged or not of 'scantrove evaluate nyu2'.",
              "Name another folder with --out.");
}

/// The first key whose values differ.
std::string firstDifference(const Record& was, const Record& is) {
  for (const auto& [key, value] : is.items()) {
    if (!was.contains(key)) return key;
    if (was[key] == value) continue;
    return value.is_object() && was[key].is_object() ? firstDifference(was[key], value) : key;
  }
  return "number of parameters";
}

}  // namespace

Result<Nyu2Results> Nyu2Results::open(const fs::path& folder, const Record& setup) {
  std::error_code ignored;
  const bool is_new = !fs::exists(folder, ignored) || fs::is_empty(folder, ignored);
  const bool has_record = fs::is_regular_file(folder / "nyu2.json", ignored);
  if (!is_new && !has_record) {
    return fail(
        "The folder " + folder.string() + " holds files that 'scantrove evaluate nyu2' did not write.",
        "Name a new folder with --out.");
  }
  SCANTROVE_TRY(prepareOutputFolder(folder));
  auto lock = FileLock::take(folder, {"Another program evaluates into " + folder.string() + ".",
                                      "Wait for it, or name another folder with --out."});
  if (!lock) return fail(lock.error());
  Nyu2Results results(folder, std::move(*lock));
  if (has_record) {
    SCANTROVE_TRY(results.readRecord(setup));
  } else {
    results.setup_ = setup;
    SCANTROVE_TRY(results.writeRecord());
  }
  return results;
}

const Nyu2Image& Nyu2Results::of(std::size_t image) const {
  static const Nyu2Image kNone;
  const auto found = images_.find(image);
  return found == images_.end() ? kNone : found->second;
}

Result<void> Nyu2Results::store(std::size_t image, const Nyu2Image& outcomes) {
  images_[image] = outcomes;
  return writeRecord();
}

Result<void> Nyu2Results::write(const std::string& name, const std::string& bytes) {
  std::error_code ignored;
  if (std::ranges::find(files_, name) == files_.end()) {
    if (fs::exists(fs::symlink_status(folder_ / name, ignored))) {
      return fail((folder_ / name).string() + " was not written by 'scantrove evaluate nyu2'.",
                  "Move it away, or name another folder with --out.");
    }
    files_.push_back(name);
    SCANTROVE_TRY(writeRecord());
  }
  return writeFileAtomically(folder_ / name, bytes);
}

Result<void> Nyu2Results::readRecord(const Record& setup) {
  const auto text = readFile(recordFile());
  if (!text) return fail(text.error());
  const Record record = Record::parse(*text, nullptr, false);
  if (!record.is_object() || !record.contains("program") || record["program"] != kProgram ||
      !record.contains("setup") || !record.contains("files") || !record.contains("images")) {
    return isDamaged(recordFile());
  }
  auto images = imagesFrom(record["images"]);
  auto files = namesFrom(record["files"]);
  if (!images || !files) return isDamaged(recordFile());
  if (record["setup"] != setup) {
    return fail("The results in " + folder_.string() + " are of another setup (" +
                    firstDifference(record["setup"], setup) + " differs).",
                "Name another folder with --out, or evaluate with the same parameters, device and files.");
  }
  setup_ = setup;
  files_ = std::move(*files);
  images_ = std::move(*images);
  return {};
}

Result<void> Nyu2Results::writeRecord() const {
  Record images = Record::object();
  for (const auto& [number, outcomes] : images_) {
    Record& image = images[std::to_string(number)] = Record::object();
    for (const auto& [frames, outcome] : outcomes) image[std::to_string(frames)] = toRecord(outcome);
  }
  const Record record{{"program", kProgram},
                      {"outcome", {"single", "single, annotated", "merged", "merged, annotated", "lost"}},
                      {"setup", setup_},
                      {"files", files_},
                      {"images", std::move(images)}};
  return writeFileAtomically(recordFile(), record.dump(1, ' ', false, Record::error_handler_t::replace),
                             Durability::process);
}

}  // namespace scantrove
