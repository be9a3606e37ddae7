// Configuration files, and the same text as a --set option.
#include "core/session/param_registry.h"
#include "tests/fuzz/fuzz_target.h"

namespace scantrove::test {
namespace {

void checkRanges(const ScanParams& params) {
  for (const ParamInfo& info : paramRegistry()) {
    const double value = info.get(params);
    const bool is_inside = value >= info.minimum - 1e-6 && value <= info.maximum * (1 + 1e-6);
    require(is_inside || info.isAutomatic(params), "parameters stay in their range");
    require(!info.text(params).empty(), "parameters can be written");
  }
}

}  // namespace

std::vector<std::string> seeds() {
  return {"[segmentation]\nk = 0.5\nneighbours = 4\nrefine_normals = false\n[labeling]\nrule = \"thesis\"\n",
          "# all kinds\n[fusion]\nvoxel_size_m = 4e-3\nworking_width = 0x140\n[detection]\nmax_views = 12\n",
          "[!labeling]\n",
          "[segmentation]\nkä = 1 # für Möbel\n",
          "fusion.max_depth_m = 4.0\n",
          "segmentation.k=0.25",
          "recognition.model=nets/a.onnx",
          "fusion.voxel_size_m=auto",
          "labeling.rule=thesis"};
}

}  // namespace scantrove::test

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  using namespace scantrove;
  static const test::TemporaryFolder folder;
  const std::string text(reinterpret_cast<const char*>(data), size);
  ScanParams params;
  const auto loaded = loadConfig(params, test::rewrite(folder, "config.toml", text));
  test::require(loaded || !loaded.error().what.empty(), "an error has words");
  test::checkRanges(params);
  const auto applied = applySetting(params, text);
  test::require(applied || !applied.error().what.empty(), "an error has words");
  test::checkRanges(params);
  return 0;
}
