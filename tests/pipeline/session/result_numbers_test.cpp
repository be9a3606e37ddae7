// Files of a scan use the region numbers of its session.
#include <pcl/io/pcd_io.h>
#include <pcl/io/ply_io.h>

#include <map>
#include <nlohmann/json.hpp>
#include <set>

#include "core/exchange/label_image_writer.h"
#include "core/session/open_session.h"
#include "tests/pipeline/session/scan_worker_fixture.h"
#include "tests/unit/dataset/ply_reader.h"

namespace scantrove {
namespace {

using Counts = std::map<std::uint32_t, std::int64_t>;

class ResultNumbersTest : public test::ScanWorkerTest {
 protected:
  void scan() {
    ScanRequest scan = request(10);
    scan.output_folder = folder_ / "scan";
    scan.database = (folder_ / "scan" / "catalogue.sqlite").string();
    scan.label_maps = true;
    worker_.post(StartScan{scan});
    worker_.wait();
    ASSERT_EQ(worker_.state(), ScanState::finished) << log_.failure();
  }
  [[nodiscard]] std::unique_ptr<OpenSession> open() const {
    auto session = OpenSession::open(folder_ / "scan");
    EXPECT_TRUE(session) << session.error().message();
    return session ? std::move(*session) : nullptr;
  }
  /// Measured points by region; without 0, which is no region.
  static Counts countsOf(const test::PlyFile& cloud) {
    Counts counts;
    for (std::size_t i = 0; i < cloud.size(); ++i) {
      if (cloud.values.at("estimated")[i] == 0)
        ++counts[static_cast<std::uint32_t>(cloud.values.at("label")[i])];
    }
    counts.erase(0);
    return counts;
  }
  static std::vector<std::uint32_t> labelsOf(const pcl::PointCloud<pcl::PointXYZRGBL>& cloud) {
    std::vector<std::uint32_t> labels;
    for (const auto& point : cloud) labels.push_back(point.label);
    return labels;
  }
};

TEST_F(ResultNumbersTest, AllFilesHaveTheNumbersOfTheSession) {
  scan();
  const auto session = open();
  ASSERT_TRUE(session);
  const auto regions = session->regions();
  ASSERT_TRUE(regions);
  Counts counts;
  for (const RegionSummary& region : *regions) counts[region.region.value] = region.voxels;
  ASSERT_GE(counts.size(), 3U);

  const test::PlyFile ply(test::readText(folder_ / "scan" / "cloud.ply"));
  EXPECT_EQ(countsOf(ply), counts);
  std::vector<std::uint32_t> labels;
  for (const double label : ply.values.at("label")) labels.push_back(static_cast<std::uint32_t>(label));
  pcl::PointCloud<pcl::PointXYZRGBL> cloud;
  ASSERT_EQ(pcl::io::loadPLYFile((folder_ / "scan" / "cloud.ply").string(), cloud), 0);
  EXPECT_EQ(labelsOf(cloud), labels);
  ASSERT_EQ(pcl::io::loadPCDFile((folder_ / "scan" / "cloud.pcd").string(), cloud), 0);
  EXPECT_EQ(labelsOf(cloud), labels);

  const auto map = nlohmann::json::parse(test::readText(folder_ / "scan" / "labels.json"));
  std::set<std::uint32_t> listed;
  for (const auto& [id, entry] : map.items()) listed.insert(static_cast<std::uint32_t>(std::stoul(id)));
  listed.erase(0);
  std::set<std::uint32_t> in_cloud(labels.begin(), labels.end());
  in_cloud.erase(0);
  EXPECT_EQ(listed, in_cloud) << "with regions that have only estimated surface";

  const auto image = readLabelImage(folder_ / "scan" / "labels-final" / "000009.png");
  ASSERT_TRUE(image) << image.error().message();
  std::set<std::uint32_t> shown(image->begin<std::uint16_t>(), image->end<std::uint16_t>());
  shown.erase(0);
  ASSERT_FALSE(shown.empty());
  for (const std::uint32_t id : shown) EXPECT_TRUE(in_cloud.contains(id)) << id;
}

TEST_F(ResultNumbersTest, ResultsAreOutdated_AfterAnEdit) {
  scan();
  const std::string header = test::readText(folder_ / "scan" / "cloud.ply").substr(0, 300);
  EXPECT_NE(header.find("as the scan ended"), std::string::npos) << header;
  {
    const auto session = open();
    ASSERT_TRUE(session);
    EXPECT_EQ(session->areResultsCurrent(), true);
    const auto regions = session->regions();
    ASSERT_TRUE(regions);
    ASSERT_GE(regions->size(), 2U);
    ASSERT_TRUE(session->edit(
        {.kind = OperationKind::join, .regions = {(*regions)[0].region, (*regions)[1].region}}));
  }
  const auto session = open();
  ASSERT_TRUE(session);
  EXPECT_EQ(session->areResultsCurrent(), false);
}

}  // namespace
}  // namespace scantrove
