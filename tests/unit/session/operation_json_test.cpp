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

TEST(OperationJson, HoldsThePaintedImage_WithoutItsPixels) {
  Operation paint{.kind = OperationKind::paint, .regions = {RegionId{3}}};
  paint.correction = MaskCorrection{.key_frame = 4,
                                    .image = 12,
                                    .added = {8, 6, {1, 2}},
                                    .removed = {8, 6, {}},
                                    .this_image_only = true,
                                    .makes_region = true};
  const std::string text = operationToJson(paint);
  const auto read = operationFromJson(text);
  ASSERT_TRUE(read);
  paint.correction->added.runs.clear();
  EXPECT_EQ(*read, paint);
  EXPECT_EQ(operationToJson(*read), text);
}

TEST(OperationJson, RefusesAPaintedImage_WhenInvalid) {
  for (const char* mask :
       {"7", "{}", R"({"key_frame": -1, "image": 0, "size": [8, 6]})",
        R"({"key_frame": 4, "image": 0, "size": [8]})", R"({"key_frame": 4, "image": 0, "size": [8, 6.5]})",
        R"({"key_frame": 4, "image": 9999999999, "size": [8, 6]})"})
    EXPECT_FALSE(operationFromJson(R"({"kind": "paint", "regions": [3], "mask": )" + std::string(mask) + "}"))
        << mask;
  EXPECT_FALSE(effectFromJson(R"({"moves": [], "said": [], "notes": [], "anchor": -1})"));
  EXPECT_FALSE(effectFromJson(R"({"moves": [], "said": [], "notes": [], "created": 7})"));
}

}  // namespace
}  // namespace scantrove
