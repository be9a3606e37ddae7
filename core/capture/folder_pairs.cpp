#include "core/capture/folder_pairs.h"

#include <spdlog/spdlog.h>

#include <algorithm>
#include <cstdint>
#include <functional>
#include <map>

#include "core/base/regular_file.h"
#include "core/base/text.h"
#include "core/capture/folder_listing.h"
#include "core/capture/time_unit.h"
#include "core/image/image_header.h"

namespace scantrove {

namespace {

/// Natural order: a run of digits is one number, so that view2 precedes view10.
struct CountingOrder {
  bool operator()(const std::string& a, const std::string& b) const {
    std::size_t i = 0, j = 0;
    while (i < a.size() && j < b.size()) {
      const std::string_view number_a = digitsAt(a, i), number_b = digitsAt(b, j);
      if (number_a.empty() || number_b.empty()) {
        if (a[i] != b[j]) return static_cast<unsigned char>(a[i]) < static_cast<unsigned char>(b[j]);
        ++i, ++j;
        continue;
      }
      const std::string_view value_a = withoutZeros(number_a), value_b = withoutZeros(number_b);
      if (value_a.size() != value_b.size()) return value_a.size() < value_b.size();
      if (value_a != value_b) return value_a < value_b;
      i += number_a.size(), j += number_b.size();
    }
    if (a.size() - i != b.size() - j) return a.size() - i < b.size() - j;
    return a < b;  // 1 and 01 are different names
  }

 private:
  static std::string_view digitsAt(const std::string& text, std::size_t at) {
    const std::size_t end = std::min(text.find_first_not_of("0123456789", at), text.size());
    return std::string_view(text).substr(at, end - at);
  }
  static std::string_view withoutZeros(std::string_view digits) {
    return digits.substr(std::min(digits.find_first_not_of('0'), digits.size()));
  }
};

using FilesByNumber = std::map<int, std::filesystem::path>;
using FilesByName = std::map<std::string, std::filesystem::path, CountingOrder>;

/// Empty if two files have the same number, or one has none.
std::optional<FilesByNumber> byNumber(const std::vector<std::filesystem::path>& images, DigitRun run) {
  FilesByNumber numbered;
  for (const std::filesystem::path& image : images) {
    const auto number = numberInName(image.stem().string(), run);
    if (!number || !numbered.emplace(*number, image).second) {
      return std::nullopt;
    }
  }
  return numbered;
}

std::vector<ImageSequenceEntry> pairByNumber(const FilesByNumber& depth, const FilesByNumber* color) {
  std::vector<ImageSequenceEntry> entries;
  for (const auto& [number, file] : depth) {
    ImageSequenceEntry entry;
    if (color != nullptr) {
      const auto found = color->find(number);
      if (found == color->end()) {
        continue;
      }
      entry.color = found->second;
    }
    entry.index = number;
    entry.timestamp_s = number / kFrameRateHz;
    entry.depth = file;
    entries.push_back(std::move(entry));
  }
  return entries;
}

/// Empty if two files differ by their extension only.
std::optional<FilesByName> byName(const std::vector<std::filesystem::path>& images) {
  FilesByName named;
  for (const std::filesystem::path& image : images) {
    if (!named.emplace(image.stem().string(), image).second) return std::nullopt;
  }
  return named;
}

/// Parses names as times: plain decimals with a point or more digits than a number has. Empty if a name is no
/// time.
std::optional<std::vector<double>> timesInNames(const std::vector<ImageSequenceEntry>& entries) {
  std::vector<double> times;
  bool is_long = false;
  for (const ImageSequenceEntry& entry : entries) {
    const std::string stem = entry.depth.stem().string();
    const auto numbers =
        stem.find_first_not_of("0123456789.") == std::string::npos ? parseNumbers(stem) : std::nullopt;
    if (!numbers || numbers->size() != 1) return std::nullopt;
    is_long = is_long || !parseFrameNumber(stem);
    times.push_back(numbers->front());
  }
  return is_long ? std::optional(times) : std::nullopt;
}

/// Sorts names that are times by time, others in natural order.
void orderByName(std::vector<ImageSequenceEntry>& entries, const std::string& source) {
  auto times = timesInNames(entries);
  if (times) {
    for (std::size_t i = 0; i < entries.size(); ++i) entries[i].timestamp_s = (*times)[i];
    std::ranges::stable_sort(entries, {}, &ImageSequenceEntry::timestamp_s);
    std::ranges::sort(*times);
  }
  const TimeUnit unit = times ? unitOfImageTimes(*times) : TimeUnit();
  if (unit != TimeUnit())
    spdlog::warn("{}: by their spacing, the times in its names are {}.", source, unit.name);
  for (std::size_t i = 0; i < entries.size(); ++i) {
    entries[i].index = static_cast<int>(i);
    entries[i].timestamp_s =
        times ? entries[i].timestamp_s * unit.seconds : static_cast<double>(i) / kFrameRateHz;
  }
}

/// Pairs files by equal names. `color`: null without colour.
std::vector<ImageSequenceEntry> pairByName(const FilesByName& depth, const FilesByName* color,
                                           const std::string& source) {
  std::vector<ImageSequenceEntry> entries;
  for (const auto& [name, file] : depth) {
    ImageSequenceEntry entry;
    entry.depth = file;
    if (color != nullptr) {
      const auto found = color->find(name);
      if (found == color->end()) continue;
      entry.color = found->second;
    }
    entries.push_back(std::move(entry));
  }
  orderByName(entries, source);
  return entries;
}

/// Whether names are times, or their order differs from their numbers' order: then the number is a wrapping
/// part of the name, such as the fraction of a second.
bool areNamesBetter(const std::vector<ImageSequenceEntry>& by_number) {
  if (timesInNames(by_number)) return true;
  const auto nameOf = [](const std::filesystem::path& file) { return file.stem().string(); };
  const bool are_equal = std::ranges::all_of(by_number, [&](const ImageSequenceEntry& entry) {
    return entry.color.empty() || nameOf(entry.color) == nameOf(entry.depth);
  });
  const auto isBehind = [&](const ImageSequenceEntry& a, const ImageSequenceEntry& b) {
    return CountingOrder()(nameOf(b.depth), nameOf(a.depth));
  };
  return are_equal && std::ranges::adjacent_find(by_number, isBehind) != by_number.end();
}

struct ImageFiles {
  std::vector<std::filesystem::path> depth, color;
  bool has_color = false;
};

bool isArray(const std::filesystem::path& file) {
  const std::string extension = lowerCase(file.extension().string());
  return extension == ".npy" || extension == ".exr";
}

/// Pictures beside arrays of depth are previews of them.
void removePreviews(std::vector<std::filesystem::path>& depth) {
  if (std::ranges::any_of(depth, isArray)) std::erase_if(depth, std::not_fn(isArray));
}

Result<ImageFiles> listImageFiles(const std::filesystem::path& depth_folder,
                                  const std::optional<std::filesystem::path>& color_folder) {
  ImageFiles files;
  files.has_color = color_folder.has_value();
  SCANTROVE_TRY(moveInto(files.depth, listImages(depth_folder)));
  removePreviews(files.depth);
  if (color_folder) SCANTROVE_TRY(moveInto(files.color, listImages(*color_folder)));
  return files;
}

/// Pairs by the last number in each name, else the first; empty if neither works.
std::vector<ImageSequenceEntry> pairByNumbers(const ImageFiles& files) {
  for (const DigitRun run : {DigitRun::last, DigitRun::first}) {
    const auto depth = byNumber(files.depth, run);
    const auto color = byNumber(files.color, run);
    if (!depth || !color) continue;
    auto entries = pairByNumber(*depth, files.has_color ? &*color : nullptr);
    if (!entries.empty()) return entries;
  }
  return {};
}

std::vector<ImageSequenceEntry> pairByNames(const ImageFiles& files, const std::string& source) {
  const auto depth = byName(files.depth);
  const auto color = byName(files.color);
  if (!depth || !color) return {};
  return pairByName(*depth, files.has_color ? &*color : nullptr, source);
}

}  // namespace

Result<std::vector<std::filesystem::path>> listImages(const std::filesystem::path& folder) {
  const auto names = listFolder(folder);
  if (!names) {
    return fail(names.error());
  }
  std::vector<std::filesystem::path> images;
  for (const std::string& name : *names) {
    const std::string extension = lowerCase(std::filesystem::path(name).extension().string());
    for (const char* const known :
         {".png", ".jpg", ".jpeg", ".ppm", ".pgm", ".bmp", ".tif", ".tiff", ".exr", ".npy"}) {
      if (extension == known) {
        images.push_back(folder / name);
      }
    }
  }
  if (images.empty()) {
    return fail(folder.string() + " holds no images.",
                "Looked for numbered .png, .jpg, .ppm, .pgm, .bmp, .tif, .exr and .npy files, one a frame.");
  }
  return images;
}

Result<std::vector<ImageSequenceEntry>> pairFolders(const std::filesystem::path& depth_folder,
                                                    const std::optional<std::filesystem::path>& color_folder,
                                                    const std::string& source) {
  const auto files = listImageFiles(depth_folder, color_folder);
  if (!files) return fail(files.error());
  const char* equal = "numbers";
  auto entries = pairByNumbers(*files);
  if (entries.empty() || areNamesBetter(entries)) {
    equal = "names";
    entries = pairByNames(*files, source);
  }
  if (entries.empty()) {
    return fail(depth_folder.parent_path().string() +
                    ": colour and depth images cannot be paired by their names (such as " +
                    files->depth.front().filename().string() +
                    (files->has_color ? " and " + files->color.front().filename().string() : "") + ").",
                "Give both images of a frame the same name, or its number, e.g. color/000012.jpg and "
                "depth/000012.png.");
  }
  const std::size_t left_out = std::max(files->depth.size(), files->color.size()) - entries.size();
  if (files->has_color && left_out > 0) {
    spdlog::warn("{}: {} colour and {} depth images; using the {} {} that both have.", source,
                 files->color.size(), files->depth.size(), entries.size(), equal);
  }
  return entries;
}

/// The log numbers frames like the files, or from 0 while the files start elsewhere.
void addPosesByNumber(ImageSequence& sequence, const std::vector<NumberedPose>& poses) {
  std::map<int, const NumberedPose*> by_number;
  for (const NumberedPose& pose : poses) {
    by_number.emplace(pose.number, &pose);
  }
  const bool has_file_numbers =
      by_number.contains(sequence.entries.front().index) && by_number.contains(sequence.entries.back().index);
  int position = 0;
  for (ImageSequenceEntry& entry : sequence.entries) {
    if (const auto pose = by_number.find(has_file_numbers ? entry.index : position);
        pose != by_number.end()) {
      entry.T_world_camera = pose->second->T_world_camera;
    }
    ++position;
  }
}

void addPoseFiles(ImageSequence& sequence, const std::filesystem::path& folder) {
  const auto names = listFolder(folder);
  if (!names) return;
  for (ImageSequenceEntry& entry : sequence.entries) {
    const std::string name = entry.depth.stem().string() + ".txt";
    if (!std::ranges::binary_search(*names, name)) continue;
    entry.pose_file = folder / name;
    sequence.has_poses = true;
  }
}

std::optional<cv::Size> depthSizeOf(const std::vector<ImageSequenceEntry>& entries) {
  constexpr std::size_t kTried = 20;
  for (std::size_t i = 0; i < std::min(entries.size(), kTried); ++i) {
    const auto start = readFile(entries[i].depth, kImageHeaderBytes);
    if (!start) continue;
    const auto size = imageSize({reinterpret_cast<const std::uint8_t*>(start->data()), start->size()});
    if (size && checkImageSize(*size, ""))
      return cv::Size(static_cast<int>(size->width), static_cast<int>(size->height));
  }
  return std::nullopt;
}

bool hasNumberedFiles(const std::filesystem::path& folder, std::string_view prefix) {
  const auto names = listFolder(folder);
  if (!names || names->empty() || !names->front().starts_with(prefix)) return false;
  const std::string stem = std::filesystem::path(names->front()).stem().string();
  return parseFrameNumber(std::string_view(stem).substr(prefix.size())).has_value();
}

std::optional<int> numberInName(const std::string& stem, DigitRun run) {
  constexpr const char* kDigits = "0123456789";
  std::size_t begin = 0;
  std::size_t end = 0;
  if (run == DigitRun::first) {
    begin = stem.find_first_of(kDigits);
    if (begin == std::string::npos) {
      return std::nullopt;
    }
    end = std::min(stem.find_first_not_of(kDigits, begin), stem.size());
  } else {
    const std::size_t last = stem.find_last_of(kDigits);
    if (last == std::string::npos) {
      return std::nullopt;
    }
    end = last + 1;
    const std::size_t before = stem.find_last_not_of(kDigits, last);
    begin = before == std::string::npos ? 0 : before + 1;
  }
  return parseFrameNumber(std::string_view(stem).substr(begin, end - begin));
}

}  // namespace scantrove
