// Recordings of an Azure Kinect: elements, tracks, blocks, the calibration.
#include "tests/fuzz/container_fuzz.h"
#include "tests/support/container_bytes.h"

namespace scantrove::test {

std::vector<std::string> seeds() {
  const std::string calibration =
      R"({"CalibrationInformation":{"Cameras":[{"Location":"CALIBRATION_CameraLocationD0","Intrinsics":)"
      R"({"ModelParameters":[0.5,0.5,0.5,0.5,0.1,0,0,0.1,0,0,0,0,0,0]},"Rt":{"Rotation":[1,0,0,0,1,0,0,0,1],)"
      R"("Translation":[0,0,0]}},{"Location":"CALIBRATION_CameraLocationPV0","Intrinsics":)"
      R"({"ModelParameters":[0.5,0.5,0.5,0.5,0,0,0,0,0,0,0,0,0,0]},"Rt":{"Rotation":[1,0,0,0,1,0,0,0,1],)"
      R"("Translation":[-0.03,0,0]}}]}})";
  // Images without a mode of the camera are the small ones; their calibration is read before that is said.
  const MatroskaTestTrack depth{
      "DEPTH", "b16g", 8, 6, {{0, std::string(96, '\3')}, {33, std::string(96, '\2')}}};
  const MatroskaTestTrack color{"COLOR", "YUY2", 8, 6, {{1, std::string(96, '\x80')}}};
  const MatroskaTestTrack binned{
      "DEPTH", "b16g", 320, 288, {{0, std::string(std::size_t{2} * 320 * 288, '\3')}}};
  return {matroskaBytes({depth, color}, calibration), matroskaBytes({binned}, calibration)};
}

}  // namespace scantrove::test

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  scantrove::test::readContainer(data, size, "input.mkv");
  return 0;
}
