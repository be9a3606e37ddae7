#include "tests/benchmarks/wholeness_sample.h"

#include <spdlog/fmt/fmt.h>

#include <cmath>
#include <fstream>
#include <map>
#include <sstream>

namespace scantrove::benchmarks {
namespace {

constexpr double kMostLooks = 0.8;  // as a view of an object has to be whole

}  // namespace

Result<void> writeSamples(const std::filesystem::path& file, const std::vector<WholenessSample>& samples) {
  std::ofstream out(file);
  for (const WholenessSample& sample : samples) {
    std::vector<std::uint32_t> regions;
    for (const RegionId region : sample.regions) regions.push_back(region.value);
    out << fmt::format("{} {} {} {:.3f} {} {} {:.6g}\n", sample.scene, sample.frame, sample.thing,
                       sample.overlap, regions.size(), fmt::join(regions, " "), fmt::join(sample.x, " "));
  }
  out.close();
  if (!out)
    return fail("The samples could not be written to " + file.string() + ".", "Is there space on the disk?");
  return {};
}

Result<std::vector<WholenessSample>> readSamples(const std::filesystem::path& file) {
  std::ifstream in(file);
  std::vector<WholenessSample> samples;
  for (std::string line; std::getline(in, line);) {
    std::istringstream words(line);
    WholenessSample sample;
    std::size_t regions = 0;
    words >> sample.scene >> sample.frame >> sample.thing >> sample.overlap >> regions;
    for (std::uint32_t region = 0; regions > 0 && words >> region; --regions)
      sample.regions.add(RegionId{region});
    for (float& x : sample.x) words >> x;
    if (!words)
      return fail(file.string() + " does not hold samples of these features.", "Delete it and scan again.");
    samples.push_back(std::move(sample));
  }
  return samples;
}

std::vector<WeighedSample> weigh(const std::vector<WholenessSample>& samples) {
  struct Looks {
    int all = 0, whole = 0;
  };
  std::map<std::pair<std::size_t, RegionSet>, Looks> looks;
  for (const WholenessSample& sample : samples) {
    Looks& of = looks[{sample.scene, sample.regions}];
    ++of.all;
    of.whole += sample.isWhole() ? 1 : 0;
  }
  std::vector<WeighedSample> weighed;
  float sum = 0;
  for (const WholenessSample& sample : samples) {
    const Looks& of = looks[{sample.scene, sample.regions}];
    weighed.push_back({&sample, of.whole >= kMostLooks * of.all, 1 / std::sqrt(static_cast<float>(of.all))});
    sum += weighed.back().weight;
  }
  for (WeighedSample& sample : weighed) sample.weight *= static_cast<float>(weighed.size()) / sum;
  return weighed;
}

}  // namespace scantrove::benchmarks
