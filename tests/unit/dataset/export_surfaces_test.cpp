#include <gtest/gtest.h>
#include <pcl/io/pcd_io.h>
#include <pcl/io/ply_io.h>

#include <bit>
#include <cstring>

#include "core/capture/pose_files.h"
#include "core/dataset/centered_mesh.h"
#include "core/dataset/glb_file.h"
#include "core/dataset/ply_file.h"
#include "tests/unit/dataset/exported.h"
#include "tests/unit/dataset/ply_reader.h"

namespace scantrove::test {
namespace {

using PclLabeled = pcl::PointCloud<pcl::PointXYZRGBL>;

void expectSame(const PclLabeled& cloud, const LabeledMesh& truth) {
  ASSERT_EQ(cloud.size(), truth.vertices.size());
  for (std::size_t i = 0; i < cloud.size(); ++i) {
    const SurfacePoint& p = truth.vertices[i];
    ASSERT_EQ(Eigen::Vector3f(cloud[i].getVector3fMap()), p.position_world_m) << i;
    ASSERT_EQ((std::array<std::uint8_t, 3>{cloud[i].r, cloud[i].g, cloud[i].b}), p.rgb) << i;
    ASSERT_EQ(cloud[i].label, p.region) << i;
  }
}

TEST(PlyExport, ReadsBackInPcl) {
  Exported exported(DatasetFormat::ply);
  PclLabeled cloud;
  ASSERT_EQ(pcl::io::loadPLYFile(exported.file("cloud.ply").string(), cloud), 0);
  const LabeledMesh truth = *exported.scene.mesh();
  expectSame(cloud, truth);
  const PlyFile ply(exported.text("cloud.ply"));
  EXPECT_EQ(ply.values.at("nz").back(), double{truth.vertices.back().normal_world.z()});
  EXPECT_EQ(exported.json("labels.json").size(), 5U) << "all regions, including unnamed ones";
  EXPECT_EQ(exported.summary.points, truth.vertices.size());
}

TEST(CloudExports, MarkEstimatedPoints) {
  const auto change = [](ScannedScene& scene) {
    scene.estimated = {
        {.position_world_m = {1, 2, 3}, .rgb = {128, 128, 128}, .region = kBall, .is_estimated = true}};
  };
  const Exported exported(DatasetFormat::ply, change);
  const PlyFile ply(exported.text("cloud.ply"));
  EXPECT_EQ(ply.properties.back(), "uchar estimated");
  const std::vector<double>& marks = ply.values.at("estimated");
  EXPECT_EQ(std::count(marks.begin(), marks.end(), 1.0), 1);
  EXPECT_EQ(marks.back(), 1);
  EXPECT_EQ(ply.values.at("label").back(), kBall);
  EXPECT_EQ(ply.values.at("y").back(), 2);
  EXPECT_EQ(exported.summary.points, ply.size());

  const Exported pcd(DatasetFormat::pcd, change);
  pcl::PCLPointCloud2 cloud;
  ASSERT_EQ(pcl::io::loadPCDFile(pcd.file("cloud.pcd").string(), cloud), 0);
  ASSERT_EQ(cloud.fields.back().name, "estimated");
  EXPECT_EQ(cloud.data.back(), 1);
  EXPECT_EQ(cloud.data[cloud.fields.back().offset], 0);
}

TEST(MeshExport, HasNoEstimatedProperty) {
  const std::string bytes = encodePly(LabeledMesh{}, {}, "metres");
  EXPECT_EQ(bytes.find("estimated"), std::string::npos);
}

TEST(EncodePly, DataNeverBeginWithALineFeed) {
  // assimp skips line ends after the header, so data that begin with one would be misread and refused.
  LabeledMesh mesh;
  mesh.vertices.resize(3);
  mesh.vertices[0].position_world_m = {std::bit_cast<float>(0x3f80000aU), 2, 3};
  mesh.vertices[1].position_world_m = mesh.vertices[0].position_world_m;
  mesh.faces.push_back({0, 1, 2});
  const std::string bytes = encodePly(mesh, {}, "metres");
  const std::size_t data = bytes.find("end_header\n") + std::strlen("end_header\n");
  float first = 0;
  std::memcpy(&first, bytes.data() + data, sizeof first);
  EXPECT_NE(bytes[data], '\n');
  EXPECT_EQ(first, std::bit_cast<float>(0x3f80000bU));  // the next representable number
  constexpr std::size_t kVertexBytes = 6 * sizeof(float) + 3 + sizeof(std::uint32_t);
  std::memcpy(&first, bytes.data() + data + kVertexBytes, sizeof first);
  EXPECT_EQ(first, mesh.vertices[1].position_world_m.x()) << "other vertices are unchanged";
}

TEST(PcdExport, ReadsBackInPclWithTheFirstCamera) {
  Exported exported(DatasetFormat::pcd);
  PclLabeled cloud;
  ASSERT_EQ(pcl::io::loadPCDFile(exported.file("cloud.pcd").string(), cloud), 0);
  expectSame(cloud, *exported.scene.mesh());
  const Eigen::Isometry3d first = exported.scene.poseOf(0);
  EXPECT_LT((cloud.sensor_origin_.head<3>().cast<double>() - first.translation()).norm(), 1e-5);
  EXPECT_LT((cloud.sensor_orientation_.toRotationMatrix().cast<double>() - first.linear()).norm(), 1e-5);
}

TEST(TumExport, ReadsBackAsTheTrajectory) {
  Exported exported(DatasetFormat::tum);
  const auto poses = readTumTrajectory(exported.file("trajectory.txt"));
  ASSERT_TRUE(poses);
  ASSERT_EQ(poses->size(), 30U);
  EXPECT_NEAR((*poses)[7].timestamp_s, 7 / 30.0, 1e-6);
  EXPECT_TRUE((*poses)[7].T_world_camera.isApprox(exported.scene.poseOf(7), 1e-6));
}

SCANTROVE_EXPORTED_ONCE(MeshExportTest, DatasetFormat::mesh);

TEST_F(MeshExportTest, HasTheSceneAndAFileForEachObject) {
  const std::string box = "objects/000012_Kiste__groß____箱_📦";
  EXPECT_EQ(exported().files(),
            (std::vector<std::string>{"labels.json", box + ".glb", box + ".obj", box + ".ply",
                                      "objects/000040_ball.glb", "objects/000040_ball.obj",
                                      "objects/000040_ball.ply", "scene.glb", "scene.obj", "scene.ply"}));
  ScannedScene scene;
  const LabeledMesh truth = *scene.mesh();
  const PlyFile complete(exported().text("scene.ply"));
  EXPECT_EQ(complete.size(), truth.vertices.size());
  EXPECT_EQ(complete.faces.size(), truth.faces.size());
  const PlyFile ball(exported().text("objects/000040_ball.ply"));
  EXPECT_EQ(ball.size(), 25U * 49U);
  EXPECT_EQ(ball.faces.size(), 24U * 48U * 2U);
  for (std::size_t i = 0; i < ball.size(); ++i) {
    const Eigen::Vector3d p(ball.values.at("x")[i], ball.values.at("y")[i], ball.values.at("z")[i]);
    ASSERT_NEAR((p - kBallCenter).norm(), kBallRadius, 1e-6);
    ASSERT_EQ(ball.values.at("label")[i], kBall);
  }
}

TEST_F(MeshExportTest, ObjHasTheSameSurface) {
  std::istringstream lines(exported().text("objects/000040_ball.obj"));
  int vertices = 0, normals = 0, faces = 0, largest = 0;
  Eigen::Vector3f colors = Eigen::Vector3f::Zero();
  for (std::string line; std::getline(lines, line);) {
    std::istringstream words(line);
    std::string kind;
    words >> kind;
    if (kind == "v") {
      Eigen::Vector3f p, c;
      words >> p.x() >> p.y() >> p.z() >> c.x() >> c.y() >> c.z();
      ASSERT_TRUE(words) << line;
      EXPECT_NEAR((p.cast<double>() - kBallCenter).norm(), kBallRadius, 1e-5);
      colors += c;
      ++vertices;
    } else if (kind == "vn") {
      ++normals;
    } else if (kind == "f") {
      for (int corner = 0; corner < 3; ++corner) {
        int vertex = 0, normal = 0;
        char slash = 0;
        words >> vertex >> slash >> slash >> normal;
        ASSERT_TRUE(words && vertex == normal && vertex >= 1) << line;
        largest = std::max(largest, vertex);
      }
      ++faces;
    }
  }
  EXPECT_EQ(vertices, 25 * 49);
  EXPECT_EQ(normals, vertices);
  EXPECT_EQ(largest, vertices);
  EXPECT_EQ(faces, 24 * 48 * 2);
  EXPECT_NEAR(colors.x() / static_cast<float>(vertices), 200 / 255.0, 1e-3);
  EXPECT_EQ(exported().text("objects/000012_Kiste__groß____箱_📦.obj").substr(0, 31),
            "# metres\no Kiste/\"groß\" \\ 箱 ");
}

template <class T>
T numberAt(const std::string& bytes, std::size_t at) {
  T value;
  std::memcpy(&value, bytes.data() + at, sizeof value);
  return value;
}

Json jsonOfGlb(const std::string& bytes) {
  return Json::parse(bytes.substr(20, numberAt<std::uint32_t>(bytes, 12)));
}

// Checks the bytes against glTF 2.0, sections 3.6, 3.7.2 and 4.4.
TEST_F(MeshExportTest, GlbFollowsTheSpecification) {
  const std::string bytes = exported().text("scene.glb");
  EXPECT_EQ(bytes.substr(0, 4), "glTF");
  EXPECT_EQ(numberAt<std::uint32_t>(bytes, 4), 2U);
  EXPECT_EQ(numberAt<std::uint32_t>(bytes, 8), bytes.size());
  const std::size_t json_bytes = numberAt<std::uint32_t>(bytes, 12);
  EXPECT_EQ(bytes.substr(16, 4), "JSON");
  EXPECT_EQ(json_bytes % 4, 0U);
  const Json json = jsonOfGlb(bytes);
  const std::size_t second = 20 + json_bytes;
  const std::size_t binary_bytes = numberAt<std::uint32_t>(bytes, second);
  EXPECT_EQ(bytes.substr(second + 4, 4), std::string("BIN\0", 4));
  EXPECT_EQ(binary_bytes % 4, 0U);
  const std::string binary = bytes.substr(second + 8);
  ASSERT_EQ(binary.size(), binary_bytes);
  EXPECT_EQ(json["asset"]["version"], "2.0");
  EXPECT_EQ(json["buffers"][0]["byteLength"], binary_bytes);
  ASSERT_EQ(json["scenes"][json["scene"].get<std::size_t>()]["nodes"].size(), 3U);
  EXPECT_EQ(json["nodes"][0]["name"], "scene");
  EXPECT_EQ(json["nodes"][1]["name"], kBoxName);
  EXPECT_EQ(json["nodes"][1]["extras"]["region"], kBox);
  EXPECT_EQ(json["nodes"][2]["name"], "ball");

  const auto startOf = [&](const Json& accessor) {
    const Json& view = json["bufferViews"][accessor["bufferView"].get<std::size_t>()];
    EXPECT_EQ(view["byteOffset"].get<std::size_t>() % 4, 0U);
    EXPECT_LE(view["byteOffset"].get<std::size_t>() + view["byteLength"].get<std::size_t>(), binary.size());
    return view["byteOffset"].get<std::size_t>();
  };
  std::size_t faces = 0;
  for (const Json& mesh : json["meshes"]) {
    const Json& primitive = mesh["primitives"][0];
    const auto accessor = [&](const Json& number) -> const Json& {
      return json["accessors"][number.get<std::size_t>()];
    };
    const Json& positions = accessor(primitive["attributes"]["POSITION"]);
    const Json& normals = accessor(primitive["attributes"]["NORMAL"]);
    const Json& colors = accessor(primitive["attributes"]["COLOR_0"]);
    const Json& indices = accessor(primitive["indices"]);
    const auto count = positions["count"].get<std::size_t>();
    EXPECT_EQ(normals["count"], count);
    EXPECT_EQ(colors["count"], count);
    EXPECT_EQ(colors["normalized"], true);
    for (std::size_t i = 0; i < indices["count"].get<std::size_t>(); ++i)
      ASSERT_LT(numberAt<std::uint32_t>(binary, startOf(indices) + 4 * i), count);
    faces += indices["count"].get<std::size_t>() / 3;
    Eigen::AlignedBox3f box;
    for (std::size_t i = 0; i < count; ++i) {
      Eigen::Vector3f p, n;
      for (std::size_t k = 0; k < 3; ++k) {
        p[static_cast<int>(k)] = numberAt<float>(binary, startOf(positions) + 12 * i + 4 * k);
        n[static_cast<int>(k)] = numberAt<float>(binary, startOf(normals) + 12 * i + 4 * k);
      }
      box.extend(p);
      ASSERT_NEAR(n.norm(), 1, 1e-5);
    }
    for (int k = 0; k < 3; ++k) {
      EXPECT_EQ(positions["min"][static_cast<std::size_t>(k)].get<float>(), box.min()[k]);
      EXPECT_EQ(positions["max"][static_cast<std::size_t>(k)].get<float>(), box.max()[k]);
    }
    if (mesh["name"] == kBoxName) {
      EXPECT_NEAR(box.sizes().y(), 0.2, 1e-3) << "y is up: the box is 20 cm high";
      EXPECT_NEAR(box.min().y(), 0, 1e-3);
      // 60 of 255 in sRGB is ((60 / 255 + 0.055) / 1.055)^2.4 = 0.04519 linear.
      EXPECT_NEAR(numberAt<std::uint16_t>(binary, startOf(colors)) / 65535.0, 0.04519, 1e-4);
      EXPECT_EQ(numberAt<std::uint16_t>(binary, startOf(colors) + 6), 65535);
    }
  }
  ScannedScene scene;
  EXPECT_EQ(faces, scene.mesh()->faces.size());
}

Eigen::AlignedBox3d boxOfPly(const PlyFile& ply) {
  Eigen::AlignedBox3d box;
  for (std::size_t i = 0; i < ply.size(); ++i)
    box.extend(Eigen::Vector3d(ply.values.at("x")[i], ply.values.at("y")[i], ply.values.at("z")[i]));
  return box;
}

Eigen::Vector3d vectorOfJson(const Json& list) {
  return {list[0].get<double>(), list[1].get<double>(), list[2].get<double>()};
}

TEST(ExportCenteredMesh, MovesObjectsToTheOriginAndStoresTheirOffsets) {
  ScannedScene scene;
  const TemporaryFolder home;
  ASSERT_TRUE(exportDataset(scene, {.format = DatasetFormat::mesh, .folder = home / "plain"}));
  ASSERT_TRUE(exportCenteredMesh(scene, {.format = DatasetFormat::mesh, .folder = home / "centred"}));
  EXPECT_TRUE(readText(home / "plain/scene.ply") == readText(home / "centred/scene.ply"));
  EXPECT_FALSE(std::filesystem::exists(home / "plain/objects/000040_ball.json"));
  const Json offset = Json::parse(readText(home / "centred/objects/000040_ball.json"));
  const Eigen::Vector3d moved_by = vectorOfJson(offset["offset_m"]);
  EXPECT_LT((moved_by - kBallCenter).norm(), 1e-4);
  EXPECT_EQ(offset["region"], kBall);
  EXPECT_EQ(offset["name"], "ball");
  const PlyFile plain(readText(home / "plain/objects/000040_ball.ply"));
  const PlyFile centered(readText(home / "centred/objects/000040_ball.ply"));
  EXPECT_LT(boxOfPly(centered).center().norm(), 1e-6);
  EXPECT_LT((boxOfPly(centered).center() + moved_by - boxOfPly(plain).center()).norm(), 1e-6);
  ASSERT_EQ(centered.size(), plain.size());
  EXPECT_NEAR(centered.values.at("x")[100] + moved_by.x(), plain.values.at("x")[100], 1e-6);

  const auto lowestCorner = [&](const std::string& folder) {
    const Json json = jsonOfGlb(readText(home / (folder + "/objects/000040_ball.glb")));
    return vectorOfJson(json["accessors"][0]["min"]);
  };
  EXPECT_LT((lowestCorner("centred") + vectorOfJson(offset["glb_offset_m"]) - lowestCorner("plain")).norm(),
            1e-5);
}

TEST(EncodeGlb, IsValid_WithoutASurface) {
  const auto bytes = encodeGlb({});
  ASSERT_TRUE(bytes);
  EXPECT_EQ(numberAt<std::uint32_t>(*bytes, 8), bytes->size());
  EXPECT_EQ(bytes->size(), 20 + numberAt<std::uint32_t>(*bytes, 12)) << "no second chunk";
  EXPECT_FALSE(jsonOfGlb(*bytes).contains("meshes"));
}

TEST(ScannetExport, HasASegmentForEachRegionAndAGroupForEachObject) {
  Exported exported(DatasetFormat::scannet);
  const std::string scene = "kitchen_table";
  EXPECT_EQ(exported.files(),
            (std::vector<std::string>{scene + ".aggregation.json", scene + ".txt",
                                      scene + "_vh_clean_2.0.010000.segs.json", scene + "_vh_clean_2.ply"}));
  const PlyFile mesh(exported.text(scene + "_vh_clean_2.ply"));
  const LabeledMesh truth = *exported.scene.mesh();
  ASSERT_EQ(mesh.size(), truth.vertices.size());
  EXPECT_EQ(mesh.faces.size(), truth.faces.size());
  EXPECT_NEAR(mesh.values.at("z")[0], 0, 1e-3) << "the table is level";
  const Json segments = exported.json(scene + "_vh_clean_2.0.010000.segs.json");
  ASSERT_EQ(segments["segIndices"].size(), mesh.size());
  for (std::size_t i = 0; i < mesh.size(); ++i)
    ASSERT_EQ(segments["segIndices"][i], truth.vertices[i].region);
  const Json groups = exported.json(scene + ".aggregation.json")["segGroups"];
  ASSERT_EQ(groups.size(), 2U);
  EXPECT_EQ(groups[0]["objectId"], 0);
  EXPECT_EQ(groups[0]["segments"], Json::array({kBox}));
  EXPECT_EQ(groups[0]["label"], "box");
  EXPECT_EQ(groups[1]["objectId"], 1);
  EXPECT_EQ(groups[1]["segments"], Json::array({kBall}));
  EXPECT_EQ(groups[1]["label"], "ball");
}

}  // namespace
}  // namespace scantrove::test
