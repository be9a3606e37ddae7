// Stored operations and effects of a session.
#include "core/session/operation_json.h"
#include "tests/fuzz/fuzz_target.h"

namespace scantrove::test {

std::vector<std::string> seeds() {
  return {
      R"({"kind": "join", "regions": [3, 7]})",
      R"({"kind": "name", "regions": [3], "name": "cup", "category": "mug"})",
      R"({"kind": "cut", "regions": [3], "here_world": [[1, 2, 3]], "there_world": [[4, 5, 6]], "frame": 12})",
      operationToJson({.kind = OperationKind::cut,
                       .regions = {RegionId{3}},
                       .here_world = {{1, 2, 3}},
                       .there_world = {{4, 5, 6}},
                       .frame = 12}),
      R"({"kind": "paint", "regions": [3], "mask": {"key_frame": 4, "image": 12, "size": [640, 480]}})",
      R"({"moves": [], "said": [], "notes": [], "anchor": 7, "created": [9]})",
      effectToJson({.moves = {{FragmentId{7}, RegionId{3}, RegionId{5}}}, .constraints = {}, .notes = {}})};
}

}  // namespace scantrove::test

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  using namespace scantrove;
  const std::string text(reinterpret_cast<const char*>(data), size);
  if (const auto operation = operationFromJson(text)) {
    for (const auto* points : {&operation->here_world, &operation->there_world}) {
      for (const Eigen::Vector3f& point : *points) test::require(point.allFinite(), "points are finite");
    }
    const std::string written = operationToJson(*operation);
    const auto again = operationFromJson(written);
    test::require(again && operationToJson(*again) == written, "what is read can be written");
  }
  if (const auto effect = effectFromJson(text)) {
    const std::string written = effectToJson(*effect);
    const auto again = effectFromJson(written);
    test::require(again && effectToJson(*again) == written, "what is read can be written");
  }
  return 0;
}
