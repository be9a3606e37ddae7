#pragma once
#include <gtest/gtest.h>

#include <algorithm>
#include <filesystem>
#include <string>
#include <vector>

#include "tests/app/scantrove_program.h"
#include "tests/support/temporary_folder.h"

namespace scantrove::test {

/// A scan of the demo, made once: tests copy its folder.
inline const std::filesystem::path& demoScan() {
  static const TemporaryFolder folder;
  static const std::filesystem::path path = [] {
    const Finished run = scantrove({"scan", "demo", "--frames", "40", "--out", folder / "scan"});
    EXPECT_EQ(run.exit_code, 0) << run.err;
    return folder / "scan";
  }();
  return path;
}

/// Commands on a copy of demoScan().
class DemoScanTest : public testing::Test {
 protected:
  using Json = nlohmann::json;

  DemoScanTest() { std::filesystem::copy(demoScan(), scan_, std::filesystem::copy_options::recursive); }

  /// Runs `scantrove session COMMAND SCAN ...`.
  Finished session(std::vector<std::string> arguments) const {
    arguments.insert(arguments.begin(), "session");
    arguments.insert(arguments.begin() + 2, scan_);
    return scantrove(arguments);
  }
  /// The output of `session regions --json`.
  [[nodiscard]] std::string regionTable() const {
    const Finished run = session({"regions", "--json"});
    EXPECT_EQ(run.exit_code, 0) << run.err;
    return run.out;
  }
  /// The regions of the table, largest first.
  [[nodiscard]] std::vector<Json> regions() const {
    std::vector<Json> all = Json::parse(regionTable());
    std::sort(all.begin(), all.end(), [](const Json& a, const Json& b) { return a["voxels"] > b["voxels"]; });
    return all;
  }
  [[nodiscard]] Json region(const std::string& id) const {
    for (const Json& one : regions()) {
      if (std::to_string(one["id"].get<int>()) == id) return one;
    }
    return {};
  }
  /// Regions without an object, largest first.
  [[nodiscard]] std::vector<std::string> plainRegions() const {
    std::vector<std::string> plain;
    for (const Json& one : regions()) {
      if (one["object"].is_null()) plain.push_back(std::to_string(one["id"].get<int>()));
    }
    return plain;
  }

  const TemporaryFolder folder_;
  const std::filesystem::path scan_ = folder_ / "scan";
  const std::string catalogue_ = scan_ / "catalogue.sqlite";
};

}  // namespace scantrove::test
