// Metadata of phones' recordings. The first letter of an input says which one it is; the rest is the text of
// its files, separated by 0x1E.
#include <spdlog/spdlog.h>

#include <opencv2/imgcodecs.hpp>

#include "core/capture/open_input.h"
#include "tests/fuzz/fuzz_target.h"
#include "tests/support/zip_bytes.h"

namespace scantrove::test {
namespace {

constexpr int kMaxFrames = 20;

std::string pngBytes(int type) {
  std::vector<unsigned char> bytes;
  cv::imencode(".png", cv::Mat(12, 16, type, cv::Scalar::all(90)), bytes);
  return {bytes.begin(), bytes.end()};
}

/// A folder with the images that a recording of this kind has.
void writeImages(const TemporaryFolder& folder, const std::vector<std::string>& depth,
                 const std::vector<std::string>& color) {
  static const std::string depth_png = pngBytes(CV_16UC1), color_png = pngBytes(CV_8UC3);
  for (const std::string& name : depth) folder.write(name, depth_png);
  for (const std::string& name : color) folder.write(name, color_png);
}

void readRecording(const std::filesystem::path& path) {
  const auto source = openInput(path.string(), {});
  require(source || !source.error().what.empty(), "an error has words");
  for (int i = 0; source && i < kMaxFrames; ++i) {
    const FrameRead read = (*source)->next();
    if (read.status == FrameRead::Status::end || read.status == FrameRead::Status::failed) return;
    require(read.status == FrameRead::Status::frame ? !read.frame.depth.empty() : !read.error.what.empty(),
            "a frame has depth, an error has words");
    require(!read.frame.T_world_camera || read.frame.T_world_camera->matrix().allFinite(),
            "poses are finite");
    require(!read.frame.intrinsics ||
                (read.frame.intrinsics->fx > 0 && read.frame.intrinsics->width == read.frame.depth.cols),
            "a frame's camera is usable");
  }
}

/// Writes the recording of kind `letter` with these texts. Result: its path.
std::filesystem::path writeRecording(const TemporaryFolder& folder, char letter, const std::string& input) {
  const auto texts = partsOf(input, 3);
  switch (letter) {
    case 't':
      writeImages(folder, {"d/0.png", "d/1.png"}, {"c/0.png"});
      folder.write("transforms.json", texts[0]);
      break;
    case 's':
      writeImages(folder, {"depth/000000.png", "depth/000001.png"}, {"rgb/000000.png"});
      folder.write("odometry.csv", texts[0]);
      folder.write("camera_matrix.csv", texts[1]);
      break;
    case 'p':
      writeImages(folder, {"keyframes/depth/12.png"}, {"keyframes/images/12.png"});
      folder.write("keyframes/cameras/12.json", texts[0]);
      break;
    case '3':
      writeImages(folder, {"depth_00000.png"}, {});
      folder.write("frame_00000.json", texts[0]);
      break;
    case 'a':
      writeImages(folder, {"lowres_depth/4_1.500.png"}, {"lowres_wide/4_1.500.png"});
      folder.write("lowres_wide.traj", texts[0]);
      folder.write("lowres_wide_intrinsics/4_1.500.pincam", texts[1]);
      break;
    case '+':
      writeImages(folder, {"depth/frame_000000.png"}, {});
      folder.write("pose_intrinsic_imu.json", texts[0]);
      break;
    case 'm':
      folder.write("s.json", texts[0]);
      folder.write("s.jsonl", texts[1]);
      folder.write("s.depth.zlib", texts[2]);
      break;
    case 'r':
      return folder.write("scan.r3d", zipBytes({{"metadata", texts[0]}, {"rgbd/0.depth", texts[1]}}));
    default:
      return folder.write("scan.r3d", input);
  }
  return folder.path();
}

}  // namespace

std::vector<std::string> seeds() {
  spdlog::set_level(spdlog::level::off);  // warnings are not tested
  const std::string rows = "[1, 0, 0, 1, 0, 1, 0, 2, 0, 0, 1, 3, 0, 0, 0, 1]",
                    K = "[20, 0, 8, 0, 20, 6, 0, 0, 1]", K_columns = "[20, 0, 0, 0, 20, 0, 8, 6, 1]";
  const std::string metadata =
      R"({"w": 16, "h": 12, "dw": 16, "dh": 12, "fps": 60, "K": )" + K_columns +
      R"(, "poses": [[0, 0, 0, 1, 1, 2, 3]], "perFrameIntrinsicCoeffs": [[20, 20, 8, 6]]})";
  const std::string floats(std::size_t{16} * 12 * 4, '\x3F');
  return {
      R"(t{"fl_x": 20, "cx": 8, "cy": 6, "w": 16, "h": 12, "integer_depth_scale": 0.001, "frames": [{"file_path":
             "c/0", "depth_path": "d/0.png", "transform_matrix": [[1, 0, 0, 1], [0, 1, 0, 2], [0, 0, 1, 3],
             [0, 0, 0, 1]]}]})",
      "stimestamp, frame, x, y, z, qx, qy, qz, qw, fx, fy, cx, cy\n"
      "1.5, 000000, 1, 2, 3, 0, 0, 0, 1, 2400, 2400, 960, 720\n1.6, 000001, 1, 2, 3, 0, 0, 0, 1\n\x1E"
      "2400, 0, 960\n0, 2400, 720\n0, 0, 1",
      R"(p{"t_00": 1, "t_01": 0, "t_02": 0, "t_03": 1, "t_10": 0, "t_11": 1, "t_12": 0, "t_13": 1, "t_20": 0,
             "t_21": 0, "t_22": 1, "t_23": 1, "fx": 20, "fy": 20, "cx": 8, "cy": 6, "width": 16, "height": 12})",
      R"(3{"time": 1, "cameraPoseARFrame": )" + rows +
          R"(, "intrinsics": [2400, 0, 960, 0, 2400, 720, 0, 0, 1]})",
      "a1.5 0.1 0.2 0.3 1 2 3\n\x1E"
      "16 12 20 20 8 6\n",
      R"(+{"frame_000000": {"timestamp": 1, "aligned_pose": )" + rows + R"(, "intrinsic": )" + K + "}}",
      R"(m{"depth_unit": "mm", "streams": [{"file_extension": "depth.zlib", "resolution": [2, 2]}]})"
      "\x1E"
      R"({"timestamp": 1, "transform": )" +
          rows + R"(, "intrinsics": )" + K_columns + "}\n\x1E\x01\x08",
      "r" + metadata + "\x1E" + storedLzfse(floats),
      "z" + zipBytes({{"metadata", metadata}, {"rgbd/0.depth", storedLzfse(floats)}})};
}

}  // namespace scantrove::test

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  using namespace scantrove;
  if (size == 0) return 0;
  const test::TemporaryFolder folder;
  const std::string input(reinterpret_cast<const char*>(data) + 1, size - 1);
  test::readRecording(test::writeRecording(folder, static_cast<char>(*data), input));
  return 0;
}
