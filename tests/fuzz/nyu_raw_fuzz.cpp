// A raw scene of NYUv2: the names of its files, and one depth and one colour image.
#include <spdlog/spdlog.h>

#include <cmath>

#include "core/base/text.h"
#include "core/capture/nyu_raw_folder.h"
#include "core/capture/nyu_raw_names.h"
#include "tests/fuzz/fuzz_target.h"

namespace scantrove::test {

std::vector<std::string> seeds() {
  // 917 with its bytes swapped, 4 x 3 pixels.
  std::string depth = "P5 4 3 65535\n", color = "P6 4 3 255\n" + std::string(36, 'c');
  for (int i = 0; i < 12; ++i) depth += "\x95\x03";
  return {
      "d-1294886360.208451-2996770081.pgm\nr-1294886360.220000-2996770082.ppm\na-1.5-1.dump\nINDEX."
      "txt\n\x1E" +
          depth + "\x1E" + color,
      "d-12942.665769-31455701.pgm\nd-12942.7-1.pgm\nr-12941.6324869-2938947.ppm\n\x1E" + depth + "\x1E"};
}

}  // namespace scantrove::test

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  using namespace scantrove;
  static const test::TemporaryFolder folder;
  spdlog::set_level(spdlog::level::off);  // warnings are not tested
  const auto parts = test::partsOf({reinterpret_cast<const char*>(data), size}, 3);
  std::vector<std::string> names;
  for (const std::string_view line : splitLines(parts[0])) names.emplace_back(line);
  double last_s = 0;
  for (const NyuRawPair& pair : nyuRawPairs(names)) {
    test::require(pair.time_s >= last_s && std::isfinite(pair.time_s), "frames are in order of time");
    last_s = pair.time_s;
    const auto color = nyuFileName(pair.color);
    test::require(pair.color.empty() || (color && std::abs(color->time_s - pair.time_s) <= 0.1 + 1e-9),
                  "colour is near in time");
  }
  const std::vector<std::string> files{"d-1.00-1.pgm", "r-1.00-1.ppm"};
  test::rewrite(folder, files[0], parts[1]);
  test::rewrite(folder, files[1], parts[2]);
  const auto source = openNyuRawFolder(folder.path(), files, {});
  test::require(source || !source.error().what.empty(), "an error has words");
  if (!source) return 0;
  const FrameRead read = (*source)->next();
  if (read.status != FrameRead::Status::frame) return 0;
  test::require(read.frame.depth.type() == CV_16UC1 && read.frame.depth.cols <= 640, "depth has its form");
  for (int i = 0; i < static_cast<int>(read.frame.depth.total()); ++i) {
    const double z = read.frame.depth.ptr<std::uint16_t>()[i] * double{read.frame.meters_per_unit};
    test::require(z == 0 || (z > 0.3 && z < 10.2), "depths are those of a Kinect");
  }
  return 0;
}
