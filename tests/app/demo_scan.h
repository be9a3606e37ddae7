#pragma once
#include <gtest/gtest.h>

#include <algorithm>
#include <cstdlib>
#include <filesystem>
#include <string>
#include <vector>

#include "tests/app/scantrove_program.h"
#include "tests/support/source_tree.h"
#include "tests/support/temporary_folder.h"

namespace scantrove::test {

/// The folder of make_demo_scan: a scan of the demo, its regions and its truth. ctest has made it for all
/// tests; without ctest, the first test of the process makes it.
inline const std::filesystem::path& demoFolder() {
  static const TemporaryFolder own;
  static const std::filesystem::path path = [] {
    if (const char* const made = std::getenv("SCANTROVE_DEMO_SCAN"); made != nullptr)
      return std::filesystem::path(made);
    const Finished run =
        runProgram({sourceTree() / "tests/app/make_demo_scan", SCANTROVE_BINARY, own / "demo"});
    EXPECT_EQ(run.exit_code, 0) << run.err;
    return own / "demo";
  }();
  return path;
}

/// Commands on a copy of the demo's scan.
class DemoScanTest : public testing::Test {
 protected:
  using Json = nlohmann::json;

  DemoScanTest() {
    std::filesystem::copy(demoFolder() / "scan", scan_, std::filesystem::copy_options::recursive);
  }

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
  /// The regions now, by their numbers as text.
  [[nodiscard]] Json regions() const {
    Json by_number = Json::object();
    for (const Json& one : Json::parse(regionTable())) by_number[std::to_string(one["id"].get<int>())] = one;
    return by_number;
  }
  [[nodiscard]] Json region(const std::string& id) const { return regions()[id]; }

  /// The regions of the scan as it was made, largest first.
  static std::vector<Json> regionsAtFirst() {
    std::vector<Json> all = Json::parse(readText(demoFolder() / "regions.json"));
    std::sort(all.begin(), all.end(), [](const Json& a, const Json& b) { return a["voxels"] > b["voxels"]; });
    return all;
  }
  /// Those without an object, largest first.
  static std::vector<std::string> plainRegions() {
    std::vector<std::string> plain;
    for (const Json& one : regionsAtFirst()) {
      if (one["object"].is_null()) plain.push_back(std::to_string(one["id"].get<int>()));
    }
    return plain;
  }

  const TemporaryFolder folder_;
  const std::filesystem::path scan_ = folder_ / "scan";
  const std::string catalogue_ = scan_ / "catalogue.sqlite";
};

}  // namespace scantrove::test
