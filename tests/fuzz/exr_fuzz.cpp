// Depth images in metres: OpenEXR.
#include "core/image/metric_depth.h"

#include <ImfChannelList.h>
#include <ImfCompression.h>
#include <ImfFrameBuffer.h>
#include <ImfHeader.h>
#include <ImfOutputFile.h>

#include <cmath>

#include "tests/fuzz/fuzz_target.h"

namespace scantrove::test {
namespace {

std::string exrBytes(Imf::Compression compression) {
  const TemporaryFolder folder;
  cv::Mat1f image(20, 8, 1.5F);
  Imf::Header header(image.cols, image.rows);
  header.compression() = compression;
  header.channels().insert("R", Imf::Channel(Imf::FLOAT));
  {
    Imf::OutputFile file((folder / "d.exr").c_str(), header, 1);
    Imf::FrameBuffer buffer;
    buffer.insert("R",
                  Imf::Slice(Imf::FLOAT, reinterpret_cast<char*>(image.data), sizeof(float), image.step[0]));
    file.setFrameBuffer(buffer);
    file.writePixels(image.rows);
  }
  return readText(folder / "d.exr");
}

}  // namespace

std::vector<std::string> seeds() {
  return {exrBytes(Imf::NO_COMPRESSION), exrBytes(Imf::ZIP_COMPRESSION), exrBytes(Imf::PIZ_COMPRESSION)};
}

}  // namespace scantrove::test

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  using namespace scantrove;
  static const test::TemporaryFolder folder;
  const auto file = test::rewrite(folder, "depth", {reinterpret_cast<const char*>(data), size});
  const auto depth = readMetricDepth(file);
  test::require(depth || !depth.error().what.empty(), "an error has words");
  if (!depth) return 0;
  test::require(depth->type() == CV_32FC1, "depth is float");
  for (const float value : cv::Mat1f(*depth))
    test::require(std::isfinite(value) && value >= 0, "depth is finite and not negative");
  test::require(toDepthUnits(*depth, 0.001F).size() == depth->size(), "units keep the size");
  return 0;
}
