// Scans of demo:moving:SEED, in which a person walks and objects move: error of the camera poses, remaining
// ghost points, and whether the moved mug stays one object of the catalogue.
#include <spdlog/fmt/fmt.h>

#include <CLI/CLI.hpp>
#include <iostream>

#include "tests/support/moving_scan.h"
#include "tests/support/qt_main_thread.h"

namespace scantrove {
namespace {

std::string listOf(const std::set<std::uint32_t>& objects) {
  return objects.empty() ? "none" : fmt::format("{}", fmt::join(objects, " "));
}

void report(std::uint32_t seed, const test::MovingScan& scan) {
  const auto partOf = [&](std::int64_t ghosts) {
    return 100 * static_cast<double>(ghosts) / static_cast<double>(std::max<std::int64_t>(scan.points, 1));
  };
  std::cout
      << fmt::format(
             "moving {}: tracked {} of {}, ATE {:.1f} mm, at most {:.1f} off; ghosts over 3 cm {:.3f} % "
             "(where "
             "people were {:.3f}, mug or chair {:.3f}), over 4 cm {:.3f} %; the mug is object {} before, "
             "{} after",
             seed, scan.tracked, scan.frames, 1000 * scan.ate_m, 1000 * scan.farthest_m,
             partOf(scan.ghosts_3cm), partOf(scan.of_people), partOf(scan.of_moved_objects),
             partOf(scan.ghosts_4cm), listOf(scan.mug_before), listOf(scan.mug_after))
      << std::endl;
}

}  // namespace
}  // namespace scantrove

int main(int argc, char** argv) {
  CLI::App app("Scans of scenes with moving objects");
  std::vector<std::uint32_t> seeds;
  int frames = 0;
  app.add_option("seeds", seeds, "of demo:moving")->required();
  app.add_option("--frames", frames, "only the first N");
  CLI11_PARSE(app, argc, argv);
  const scantrove::test::QtMainThread qt;
  const auto compute = scantrove::ComputeContext::create({});
  if (!compute) {
    std::cerr << compute.error().message() << '\n';
    return 1;
  }
  for (const std::uint32_t seed : seeds) {
    const auto scan = scantrove::test::scanMoving(seed, **compute, frames);
    if (!scan) {
      std::cerr << scan.error().message() << '\n';
      return 1;
    }
    scantrove::report(seed, *scan);
  }
  return 0;
}
