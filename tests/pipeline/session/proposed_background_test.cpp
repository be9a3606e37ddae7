// Proposals of background in a saved scan.
#include <gtest/gtest.h>

#include <algorithm>

#include "core/pipeline/mapping_pipeline.h"
#include "core/session/open_session.h"
#include "tests/pipeline/session/scan_worker_fixture.h"

namespace scantrove::test {
namespace {

TEST_F(ScanWorkerTest, SavedScanProposesASupport_UntilItIsMarked) {
  ScanRequest scan = request(6);
  scan.output_folder = folder_ / "scan";
  scan.skip_refinement = true;
  worker_.post(StartScan{scan});
  worker_.wait();
  ASSERT_EQ(worker_.state(), ScanState::finished) << log_.failure();
  RegionId region;
  const auto isProposed = [&](OpenSession& session) {
    const auto regions = session.regions();
    EXPECT_TRUE(regions);
    const auto found = std::ranges::find(*regions, region, &RegionSummary::region);
    return found != regions->end() && found->is_proposed_background;
  };
  {
    const auto session = OpenSession::open(folder_ / "scan");
    ASSERT_TRUE(session) << session.error().message();
    const auto regions = (*session)->regions();
    ASSERT_TRUE(regions);
    for (const RegionSummary& one : *regions) {
      if (!one.label.is_object && !one.is_proposed_background) region = one.region;
    }
    ASSERT_TRUE(region);
    RegionTable& table = (*session)->pipeline().labels().table();
    constexpr float kMuch = 1e7F;  // more than the scan has pixels
    table.addSupportPixels(table.fragmentsOf(region).front(), {kMuch, kMuch, 0});
    EXPECT_TRUE(isProposed(**session));
    ASSERT_TRUE((*session)->saveMetadata());
  }
  const auto session = OpenSession::open(folder_ / "scan");
  ASSERT_TRUE(session) << session.error().message();
  EXPECT_TRUE(isProposed(**session)) << "sessions keep what is a support";
  Operation mark;
  mark.kind = OperationKind::background;
  mark.regions = {region};
  ASSERT_TRUE((*session)->edit(mark));
  EXPECT_FALSE(isProposed(**session));
  ASSERT_TRUE((*session)->undo());
  EXPECT_TRUE(isProposed(**session));
}

}  // namespace
}  // namespace scantrove::test
