#include "core/session/operation_json.h"

#include <gtest/gtest.h>

namespace scantrove {
namespace {

TEST(OperationJson, IsRefused_WhenInvalid) {
  EXPECT_FALSE(operationFromJson("{"));
  EXPECT_FALSE(operationFromJson("[]"));
  EXPECT_FALSE(operationFromJson(R"({"kind": "explode", "regions": []})"));
  EXPECT_FALSE(operationFromJson(R"({"kind": "join", "regions": "all"})"));
  EXPECT_FALSE(operationFromJson(R"({"kind": "cut", "regions": [3], "here": [[1, 2, 1e99]]})"));
  EXPECT_FALSE(effectFromJson(R"({"moves": [[1]], "said": [], "notes": []})"));
}

}  // namespace
}  // namespace scantrove
