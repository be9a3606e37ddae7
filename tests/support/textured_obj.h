#pragma once
#include <Eigen/Core>
#include <array>
#include <filesystem>
#include <fstream>
#include <opencv2/imgcodecs.hpp>
#include <optional>
#include <sstream>
#include <string>
#include <vector>

namespace scantrove::test {

/// A triangle mesh with one texture, as an OBJ file describes it. Reads what any other program would: `v`,
/// `vt`, and `f` with corners `v/vt` or `v/vt/vn`, and the image of the material that `mtllib` names.
struct TexturedObj {
  struct Corner {
    std::size_t vertex = 0, place = 0;
  };
  std::vector<Eigen::Vector3d> vertices;
  std::vector<Eigen::Vector2d> places;  ///< 0 .. 1, from the left and the lower edge of the image
  std::vector<std::array<Corner, 3>> faces;
  cv::Mat image;  ///< CV_8UC3, BGR

  [[nodiscard]] static std::optional<TexturedObj> read(const std::filesystem::path& file) {
    TexturedObj mesh;
    std::ifstream lines(file);
    for (std::string line; std::getline(lines, line);) {
      std::istringstream words(line);
      std::string kind;
      words >> kind;
      if (kind == "v") {
        Eigen::Vector3d& p = mesh.vertices.emplace_back();
        words >> p.x() >> p.y() >> p.z();
      } else if (kind == "vt") {
        Eigen::Vector2d& at = mesh.places.emplace_back();
        words >> at.x() >> at.y();
      } else if (kind == "f") {
        std::array<Corner, 3>& face = mesh.faces.emplace_back();
        for (Corner& corner : face) {
          std::string numbers;
          words >> numbers;
          std::istringstream pair(numbers);
          char slash = 0;
          pair >> corner.vertex >> slash >> corner.place;
          if (corner.vertex < 1 || corner.vertex > mesh.vertices.size() || corner.place < 1 ||
              corner.place > mesh.places.size()) {
            return std::nullopt;
          }
          --corner.vertex;
          --corner.place;
        }
      } else if (kind == "mtllib") {
        words >> std::ws;
        std::string name;
        std::getline(words, name);
        mesh.image = textureOf(file.parent_path() / name);
      }
    }
    if (mesh.faces.empty() || mesh.image.empty()) return std::nullopt;
    return mesh;
  }

 private:
  static cv::Mat textureOf(const std::filesystem::path& materials) {
    std::ifstream lines(materials);
    for (std::string line; std::getline(lines, line);) {
      if (line.starts_with("map_Kd ")) {
        return cv::imread((materials.parent_path() / line.substr(7)).string(), cv::IMREAD_COLOR);
      }
    }
    return {};
  }
};

}  // namespace scantrove::test
