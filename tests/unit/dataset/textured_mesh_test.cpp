#include <gtest/gtest.h>

#include <cstring>
#include <sstream>

#include "core/dataset/obj_file.h"
#include "core/dataset/texture_corners.h"
#include "core/image/image_file.h"
#include "tests/unit/dataset/exported.h"

namespace scantrove::test {
namespace {

/// A Wavefront OBJ with its material and image.
struct TexturedObj {
  struct Corner {
    std::size_t vertex = 0, place = 0, normal = 0;
  };
  std::vector<Eigen::Vector3d> vertices, normals;
  std::vector<Eigen::Vector2d> places;
  std::vector<std::array<Corner, 3>> faces;
  std::string mtl_file, image_file;
  cv::Mat image;

  explicit TexturedObj(const std::filesystem::path& file) {
    std::istringstream lines(readText(file));
    for (std::string line; std::getline(lines, line);) {
      std::istringstream words(line);
      std::string kind;
      words >> kind;
      if (kind == "v") vertices.push_back(vectorFrom(words));
      if (kind == "vn") normals.push_back(vectorFrom(words));
      if (kind == "vt") {
        Eigen::Vector2d place;
        words >> place.x() >> place.y();
        places.push_back(place);
      }
      if (kind == "mtllib") words >> mtl_file;
      if (kind == "f") addFace(words);
      const bool is_complete = !words.fail();
      EXPECT_TRUE(is_complete) << line;
    }
    std::istringstream material(readText(file.parent_path() / mtl_file));
    for (std::string word; material >> word;) {
      if (word == "map_Kd") material >> image_file;
    }
    image = cv::imread((file.parent_path() / image_file).string());
  }

  /// Blue, green, red in the middle of a face.
  [[nodiscard]] Eigen::Vector3d colorOf(std::size_t face) const {
    Eigen::Vector2d place = Eigen::Vector2d::Zero();
    for (const Corner& corner : faces[face]) place += places.at(corner.place - 1) / 3;
    const auto& bgr = image.at<cv::Vec3b>(static_cast<int>((1 - place.y()) * image.rows),
                                          static_cast<int>(place.x() * image.cols));
    return {double(bgr[0]), double(bgr[1]), double(bgr[2])};
  }

 private:
  static Eigen::Vector3d vectorFrom(std::istringstream& words) {
    Eigen::Vector3d v;
    words >> v.x() >> v.y() >> v.z();
    return v;
  }

  void addFace(std::istringstream& words) {
    std::array<Corner, 3> face;
    for (Corner& corner : face) {
      char slash = 0;
      words >> corner.vertex >> slash >> corner.place >> slash >> corner.normal;
    }
    faces.push_back(face);
  }
};

template <class T>
T valueAt(const std::string& bytes, std::size_t at) {
  T value;
  std::memcpy(&value, bytes.data() + at, sizeof value);
  return value;
}

/// A binary glTF with its chunks.
struct GlbFile {
  Json json;
  std::string binary;

  explicit GlbFile(const std::string& bytes) {
    const std::size_t json_bytes = valueAt<std::uint32_t>(bytes, 12);
    json = Json::parse(bytes.substr(20, json_bytes));
    binary = bytes.substr(20 + json_bytes + 8);
  }
  [[nodiscard]] std::string viewBytes(const Json& number) const {
    const Json& view = json["bufferViews"][number.get<std::size_t>()];
    return binary.substr(view["byteOffset"].get<std::size_t>(), view["byteLength"].get<std::size_t>());
  }
  [[nodiscard]] const Json& accessor(const Json& number) const {
    return json["accessors"][number.get<std::size_t>()];
  }
};

class TexturedMeshTest : public testing::Test {
 protected:
  static void SetUpTestSuite() {
    home_ = new TemporaryFolder();
    ScannedScene scene;
    const auto textured = exportDataset(
        scene, {.format = DatasetFormat::mesh, .folder = *home_ / "textured", .texture_size_px = 1024});
    EXPECT_TRUE(textured) << (textured ? "" : textured.error().message());
    EXPECT_TRUE(exportDataset(scene, {.format = DatasetFormat::mesh, .folder = *home_ / "plain"}));
  }
  static void TearDownTestSuite() { delete home_; }
  [[nodiscard]] static std::filesystem::path file(const std::string& name) {
    return *home_ / "textured" / name;
  }

  inline static TemporaryFolder* home_ = nullptr;
  inline static const std::string kBoxStem = "objects/000012_Kiste__groß____箱_📦";
};

TEST_F(TexturedMeshTest, HasAnImageAndAMaterialForEachObject) {
  std::vector<std::string> expected{"README.md", "labels.json"};
  for (const std::string& stem : {std::string("scene"), kBoxStem, std::string("objects/000040_ball")}) {
    for (const char* extension : {".glb", ".mtl", ".obj", ".ply", ".png"})
      expected.push_back(stem + extension);
  }
  std::ranges::sort(expected);
  EXPECT_EQ(Exported::filesIn(*home_ / "textured"), expected);
  for (const std::string& stem : {std::string("scene"), kBoxStem, std::string("objects/000040_ball")})
    EXPECT_TRUE(readText(file(stem + ".ply")) == readText(*home_ / ("plain/" + stem + ".ply"))) << stem;
}

TEST_F(TexturedMeshTest, ObjReadsBackWithItsColors) {
  const TexturedObj ball(file("objects/000040_ball.obj"));
  EXPECT_EQ(ball.vertices.size(), 25U * 49U);
  EXPECT_EQ(ball.normals.size(), ball.vertices.size());
  ASSERT_EQ(ball.faces.size(), 24U * 48U * 2U);
  ASSERT_FALSE(ball.image.empty());
  std::size_t alike = 0;
  for (std::size_t face = 0; face < ball.faces.size(); ++face) {
    for (const TexturedObj::Corner& corner : ball.faces[face]) {
      ASSERT_LE(corner.vertex, ball.vertices.size());
      ASSERT_EQ(corner.vertex, corner.normal);
      ASSERT_TRUE(corner.place >= 1 && corner.place <= ball.places.size());
    }
    // The image of the ball is 200, 60, 50, less 10 % at most, with noise of 3 levels.
    const Eigen::Vector3d red_ball(50, 60, 200);
    alike += (ball.colorOf(face) - red_ball).cwiseAbs().maxCoeff() < 40 ? 1U : 0U;
  }
  EXPECT_GT(static_cast<double>(alike), 0.97 * static_cast<double>(ball.faces.size()));
}

TEST_F(TexturedMeshTest, NamesOfFilesAreSafe) {
  const TexturedObj box(file(kBoxStem + ".obj"));
  EXPECT_EQ(box.mtl_file, std::filesystem::path(kBoxStem).filename().string() + ".mtl");
  EXPECT_EQ(box.image_file, std::filesystem::path(kBoxStem).filename().string() + ".png");
  for (const std::string& name : {box.mtl_file, box.image_file})
    EXPECT_EQ(name.find_first_of(" \t\"'\\/"), std::string::npos) << name;
  EXPECT_FALSE(box.image.empty());
}

TEST_F(TexturedMeshTest, GlbHoldsTheImage) {
  for (const std::string& stem : {std::string("scene"), kBoxStem}) {
    const GlbFile glb(readText(file(stem + ".glb")));
    ASSERT_EQ(glb.json["images"].size(), 1U);
    EXPECT_EQ(glb.json["images"][0]["mimeType"], "image/png");
    EXPECT_TRUE(glb.viewBytes(glb.json["images"][0]["bufferView"]) == readText(file(stem + ".png"))) << stem;
    const Json& material = glb.json["materials"][0]["pbrMetallicRoughness"];
    EXPECT_EQ(material["baseColorTexture"]["index"], 0);
    EXPECT_EQ(glb.json["textures"][0]["source"], 0);
    std::size_t faces = 0;
    for (const Json& mesh : glb.json["meshes"]) {
      const Json& primitive = mesh["primitives"][0];
      EXPECT_FALSE(primitive["attributes"].contains("COLOR_0")) << "it would darken the texture";
      const Json& positions = glb.accessor(primitive["attributes"]["POSITION"]);
      const Json& places = glb.accessor(primitive["attributes"]["TEXCOORD_0"]);
      const Json& indices = glb.accessor(primitive["indices"]);
      EXPECT_EQ(places["type"], "VEC2");
      EXPECT_EQ(places["count"], positions["count"]);
      faces += indices["count"].get<std::size_t>() / 3;
      const std::string bytes = glb.viewBytes(places["bufferView"]);
      ASSERT_EQ(bytes.size(), 8 * places["count"].get<std::size_t>());
      for (std::size_t at = 0; at < bytes.size(); at += 4) {
        ASSERT_GE(valueAt<float>(bytes, at), 0);
        ASSERT_LE(valueAt<float>(bytes, at), 1);
      }
    }
    EXPECT_EQ(faces, TexturedObj(file(stem + ".obj")).faces.size());
  }
}

TEST(TexturedMesh, SaysThatColorIsMissing) {
  ScannedScene scene;
  scene.without_color = {0, 10, 20};
  const TemporaryFolder home;
  const auto exported =
      exportDataset(scene, {.format = DatasetFormat::mesh, .folder = home / "out", .texture_size_px = 512});
  ASSERT_FALSE(exported);
  EXPECT_TRUE(contains(exported.error().message(), "no colour image that textures could be made of"));
  EXPECT_FALSE(std::filesystem::exists(home / "out"));
}

TEST(TexturedMesh, NamesFramesThatCannotBeRead) {
  ScannedScene scene;
  scene.with_damaged_color = {10};
  const TemporaryFolder home;
  const auto exported =
      exportDataset(scene, {.format = DatasetFormat::mesh, .folder = home / "out", .texture_size_px = 512});
  ASSERT_TRUE(exported) << exported.error().message();
  ASSERT_EQ(exported->skipped.size(), 1U);
  EXPECT_TRUE(contains(exported->skipped.front(), "Key frame 10 was left out"));
}

TEST(TextureCorners, AreSharedWithinChartsAndApartAtSeams) {
  LabeledMesh mesh;
  mesh.vertices.resize(4);
  mesh.faces = {{0, 1, 2}, {1, 3, 2}, {2, 3, 0}};
  const Eigen::Vector2f a(0.1F, 0.1F), b(0.2F, 0.1F), c(0.1F, 0.2F), d(0.3F, 0.3F), other(0.7F, 0.7F);
  const std::vector<FaceTexture> textures{{a, b, c}, {b, d, c}, {other, d, a}};
  const TextureCorners corners = textureCornersOf(mesh, textures);
  ASSERT_EQ(corners.corners.size(), 5U) << "vertex 2 has two places";
  for (std::size_t face = 0; face < 3; ++face) {
    for (std::size_t i = 0; i < 3; ++i) {
      const TextureCorners::Corner& corner = corners.corners[corners.faces[face][i]];
      EXPECT_EQ(corner.vertex, mesh.faces[face][i]);
      EXPECT_EQ(corner.place, textures[face][i]);
    }
  }
}

}  // namespace
}  // namespace scantrove::test
