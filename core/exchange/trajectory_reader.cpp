#include "core/exchange/trajectory_reader.h"

#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>
#include <fstream>
#include <optional>
#include <sstream>
#include <string>

namespace scantrove {
namespace {

namespace fs = std::filesystem;

constexpr double kFramesPerSecond = 30.0;  // sources without times

tl::unexpected<Error> notUnderstood(const fs::path& path, int line, const std::string& expected) {
  return fail(path.string() + ", line " + std::to_string(line) + ": not understood.",
              "Expected " + expected + ".");
}

/// Iostreams reject "nan"; recordings contain it, so numbers are read as words.
std::optional<std::vector<double>> numbersOf(const std::string& line) {
  std::vector<double> numbers;
  std::istringstream words(line);
  std::string word;
  while (words >> word) {
    double number = 0;
    const auto [end, failure] = std::from_chars(word.data(), word.data() + word.size(), number);
    if (failure != std::errc{} || end != word.data() + word.size()) return std::nullopt;
    numbers.push_back(number);
  }
  return numbers;
}

Result<Trajectory> readTum(std::istream& file, const fs::path& path) {
  Trajectory poses;
  std::string line;
  for (int number = 1; std::getline(file, line); ++number) {
    line = line.substr(0, line.find('#'));
    if (line.find_first_not_of(" \t\r") == std::string::npos) continue;
    std::replace(line.begin(), line.end(), ',', ' ');
    const auto v = numbersOf(line);
    if (!v || v->size() != 8) return notUnderstood(path, number, "'timestamp tx ty tz qx qy qz qw'");
    StampedPose pose;
    pose.timestamp_s = (*v)[0];
    const Eigen::Quaterniond q((*v)[7], (*v)[4], (*v)[5], (*v)[6]);
    pose.T_world_camera.translation() << (*v)[1], (*v)[2], (*v)[3];
    if (q.norm() < 1e-6) return notUnderstood(path, number, "a quaternion that is not zero");
    pose.T_world_camera.linear() = q.normalized().toRotationMatrix();
    if (std::isfinite(pose.timestamp_s) && pose.T_world_camera.matrix().allFinite()) poses.push_back(pose);
  }
  return poses;
}

/// The next four lines as a 4x4; none at a line that is not four numbers.
std::optional<Eigen::Isometry3d> readMatrix(std::istream& file) {
  Eigen::Isometry3d T = Eigen::Isometry3d::Identity();
  for (int row = 0; row < 4; ++row) {
    std::string line;
    if (!std::getline(file, line)) return std::nullopt;
    const auto v = numbersOf(line);
    if (!v || v->size() != 4) return std::nullopt;
    for (int column = 0; column < 4; ++column)
      T.matrix()(row, column) = (*v)[static_cast<std::size_t>(column)];
  }
  return T;
}

Result<Trajectory> readLog(std::istream& file, const fs::path& path) {
  Trajectory poses;
  std::string line;
  for (int number = 1; std::getline(file, line); number += 5) {
    if (line.find_first_not_of(" \t\r") == std::string::npos) continue;
    const auto header = numbersOf(line);
    const auto T = readMatrix(file);
    if (!header || header->empty() || !T)
      return notUnderstood(path, number, "a line of frame numbers, then a 4x4 matrix");
    if (T->matrix().allFinite()) poses.push_back({header->front() / kFramesPerSecond, *T});
  }
  return poses;
}

Result<Trajectory> readFile(const fs::path& path) {
  std::ifstream file(path);
  if (!file) return fail("Cannot read " + path.string() + ".", "Check the path.");
  auto poses = path.extension() == ".log" ? readLog(file, path) : readTum(file, path);
  if (poses && poses->empty()) return fail("There is no pose in " + path.string() + ".");
  return poses;
}

/// The NNNNNN of frame-NNNNNN.pose.txt.
std::optional<int> frameNumber(const std::string& name) {
  constexpr std::string_view kPrefix = "frame-";
  constexpr std::string_view kSuffix = ".pose.txt";
  if (!name.starts_with(kPrefix) || !name.ends_with(kSuffix)) return std::nullopt;
  int number = 0;
  const char* end = name.data() + name.size() - kSuffix.size();
  const auto [stop, failure] = std::from_chars(name.data() + kPrefix.size(), end, number);
  if (failure != std::errc{} || stop != end) return std::nullopt;
  return number;
}

Result<Trajectory> readPoseFiles(const std::vector<fs::path>& files) {
  Trajectory poses;
  for (const fs::path& path : files) {
    std::ifstream file(path);
    const auto T = readMatrix(file);
    if (!T) return notUnderstood(path, 1, "a 4x4 matrix");
    if (T->matrix().allFinite())
      poses.push_back({*frameNumber(path.filename().string()) / kFramesPerSecond, *T});
  }
  return poses;
}

Result<Trajectory> readFolder(const fs::path& folder) {
  for (const char* name : {"groundtruth.txt", "trajectory.txt", "trajectory.log"}) {
    if (fs::exists(folder / name)) return readFile(folder / name);
  }
  std::vector<fs::path> pose_files;
  std::optional<fs::path> log_below;
  for (const fs::directory_entry& entry : fs::directory_iterator(folder)) {
    if (frameNumber(entry.path().filename().string())) pose_files.push_back(entry.path());
    if (entry.is_directory() && fs::exists(entry.path() / "trajectory.log"))
      log_below = entry.path() / "trajectory.log";
  }
  if (!pose_files.empty()) return readPoseFiles(pose_files);
  if (log_below) return readFile(*log_below);
  return fail("There are no poses in " + folder.string() + ".",
              "Looked for groundtruth.txt, trajectory.txt, trajectory.log and frame-NNNNNN.pose.txt.");
}

}  // namespace

Result<Trajectory> readTrajectory(const fs::path& path) {
  try {
    if (!fs::exists(path)) return fail(path.string() + " does not exist.", "Check the path.");
    auto poses = fs::is_directory(path) ? readFolder(path) : readFile(path);
    if (!poses) return poses;
    std::stable_sort(poses->begin(), poses->end(), [](const StampedPose& a, const StampedPose& b) {
      return a.timestamp_s < b.timestamp_s;
    });
    return poses;
  } catch (const fs::filesystem_error& error) {
    return fail("Cannot read " + path.string() + ": " + error.code().message() + ".");
  }
}

}  // namespace scantrove
