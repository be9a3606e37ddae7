#include "tools/train/samples.h"

#include <spdlog/fmt/fmt.h>
#include <spdlog/fmt/ranges.h>

#include <fstream>
#include <sstream>

#include "core/discovery/objectness/objectness_features.h"
#include "core/labeling/border_features.h"

namespace scantrove::train {
namespace {

/// The first line says what the numbers are.
std::string heading() {
  return fmt::format("{} | {}", fmt::join(namesOf(kObjectnessFeatures), " "),
                     fmt::join(namesOf(kBorderFeatures), " "));
}

/// Reads as many numbers as `into` holds; "nan" is one.
void readNumbers(std::istream& in, std::vector<float>& into) {
  for (float& number : into) {
    std::string word;
    in >> word;
    number = std::strtof(word.c_str(), nullptr);
  }
}

}  // namespace

Result<void> writeSamples(const std::filesystem::path& file, const SceneSamples& samples) {
  std::filesystem::path unfinished = file;
  unfinished += ".part";
  std::ofstream out(unfinished);
  out << heading() << "\n";
  for (const ObjectnessSample& sample : samples.objectness) {
    out << fmt::format("o {} {} {} {} {} {}\n", sample.frame, sample.object, sample.overlap,
                       sample.regions.size(), fmt::join(sample.regions, " "), fmt::join(sample.x, " "));
  }
  for (const BorderSample& sample : samples.borders)
    out << fmt::format("b {} {}\n", sample.is_same_object ? 1 : 0, fmt::join(sample.x, " "));
  out.close();
  if (!out) return fail("The samples cannot be written to " + file.string() + ".", "Is the disk full?");
  std::filesystem::rename(unfinished, file);
  return {};
}

Result<SceneSamples> readSamples(const std::filesystem::path& file, const std::string& scene) {
  std::ifstream in(file);
  std::string line;
  if (!std::getline(in, line) || line != heading())
    return fail(file.string() + " holds samples of other features.",
                "Delete it; the scene is scanned again.");
  SceneSamples samples;
  samples.scene = scene;
  while (std::getline(in, line)) {
    std::istringstream words(line);
    char kind = 0;
    words >> kind;
    if (kind == 'o') {
      ObjectnessSample sample;
      std::size_t regions = 0;
      words >> sample.frame >> sample.object >> sample.overlap >> regions;
      sample.regions.resize(std::min<std::size_t>(regions, line.size()));
      for (std::uint32_t& region : sample.regions) words >> region;
      sample.x.resize(kObjectnessFeatures.size());
      readNumbers(words, sample.x);
      samples.objectness.push_back(std::move(sample));
    } else {
      BorderSample sample;
      words >> sample.is_same_object;
      sample.x.resize(kBorderFeatures.size());
      readNumbers(words, sample.x);
      samples.borders.push_back(std::move(sample));
    }
    if (!words) return fail(file.string() + " is damaged.", "Delete it; the scene is scanned again.");
  }
  return samples;
}

}  // namespace scantrove::train
