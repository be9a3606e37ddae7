#include "core/catalogue/appearance_network.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <string>
#include <vector>

#include "tests/support/temporary_folder.h"

namespace scantrove::test {
namespace {

using testing::AllOf;
using testing::HasSubstr;

// A network as ONNX's protobuf has it: fields of numbers (wire type 0) and of bytes (wire type 2).
std::string varint(std::uint64_t value) {
  std::string bytes;
  for (; value > 127; value >>= 7U) bytes += static_cast<char>(value % 128 + 128);
  return bytes + static_cast<char>(value);
}
std::string numberField(unsigned field, std::uint64_t value) { return varint(field << 3U) + varint(value); }
std::string bytesField(unsigned field, const std::string& bytes) {
  return varint(field << 3U | 2U) + varint(bytes.size()) + bytes;
}

/// ValueInfoProto of floats.
std::string valueInfo(const std::string& name, const std::vector<std::uint64_t>& sides) {
  std::string shape;
  for (const std::uint64_t side : sides) shape += bytesField(1, numberField(1, side));
  return bytesField(1, name) + bytesField(2, bytesField(1, numberField(1, 1) + bytesField(2, shape)));
}

/// ModelProto of layers in a row, for pictures of 4 x 4.
std::string networkOf(const std::vector<std::string>& layers) {
  std::string graph, before = "picture";
  for (std::size_t i = 0; i < layers.size(); ++i) {
    const std::string after = i + 1 == layers.size() ? "vector" : "value" + std::to_string(i);
    graph += bytesField(1, bytesField(1, before) + bytesField(2, after) + bytesField(3, "layer" + after) +
                               bytesField(4, layers[i]));
    before = after;
  }
  graph += bytesField(2, "test") + bytesField(11, valueInfo("picture", {1, 3, 4, 4})) +
           bytesField(12, valueInfo("vector", {1, 3}));
  return numberField(1, 7) + bytesField(8, numberField(2, 11)) + bytesField(7, graph);
}

class AppearanceNetworkTest : public testing::Test {
 protected:
  static constexpr const char* kSettings = R"({"input": [4, 4], "mean": [0, 0, 0], "scale": 0.00392157})";

  [[nodiscard]] std::filesystem::path write(const std::string& network,
                                            const std::string& settings = kSettings,
                                            const std::string& name = "net") const {
    static_cast<void>(folder_.write(name + ".json", settings));
    return folder_.write(name + ".onnx", network);
  }
  static std::string refusal(const std::filesystem::path& file) {
    const Result<AppearanceNetwork> network = AppearanceNetwork::load(file);
    return network ? "(loaded)" : network.error().message();
  }
  const std::string mean_color_ = networkOf({"GlobalAveragePool", "Flatten"});
  TemporaryFolder folder_;
};

const cv::Mat kMask(6, 6, CV_8UC1, cv::Scalar(255));

// The network gives the mean of each channel.
TEST_F(AppearanceNetworkTest, DescribesAPictureByAVectorOfLengthOne) {
  Result<AppearanceNetwork> network = AppearanceNetwork::load(write(mean_color_));
  ASSERT_TRUE(network) << network.error().message();
  const auto vector = network->describe(cv::Mat(6, 6, CV_8UC3, cv::Scalar(20, 30, 60)), kMask);
  ASSERT_TRUE(vector);
  EXPECT_EQ(vector->network, network->hash());
  ASSERT_EQ(vector->values.size(), 3U);
  EXPECT_NEAR(vector->values[0], 60.0 / 70, 1e-3) << "red comes first";
  EXPECT_NEAR(vector->values[1], 30.0 / 70, 1e-3);
  EXPECT_NEAR(vector->values[2], 20.0 / 70, 1e-3);
}

TEST_F(AppearanceNetworkTest, FillsBackgroundAndPaddingWithTheMean) {
  const char* settings =
      R"({"input": [4, 4], "mean": [100, 50, 10], "scale": 1, "rgb": false, "unrelated": 0.5})";
  Result<AppearanceNetwork> network = AppearanceNetwork::load(write(mean_color_, settings));
  ASSERT_TRUE(network) << network.error().message();
  cv::Mat wide(4, 8, CV_8UC3, cv::Scalar(0, 250, 0)), mask(4, 8, CV_8UC1, cv::Scalar(0));
  wide.colRange(0, 4).setTo(cv::Scalar(110, 70, 10));
  mask.colRange(0, 4).setTo(255);
  const auto vector = network->describe(wide, mask);
  ASSERT_TRUE(vector);
  const float length = std::sqrt(10.0F * 10 + 20 * 20);  // of the object's difference from the mean
  EXPECT_NEAR(vector->values[0], 10 / length, 1e-3);
  EXPECT_NEAR(vector->values[1], 20 / length, 1e-3);
  EXPECT_NEAR(vector->values[2], 0, 1e-3);
  EXPECT_FALSE(network->describe(wide, cv::Mat(4, 8, CV_8UC1, cv::Scalar(0))));
  EXPECT_FALSE(network->describe(cv::Mat(6, 6, CV_8UC3, cv::Scalar(100, 50, 10)), kMask)) << "length 0";
}

TEST_F(AppearanceNetworkTest, DistanceIsRelativeToThatOfUnrelatedObjects) {
  const char* settings = R"({"input": [4, 4], "mean": [0, 0, 0], "scale": 1, "unrelated": 0.5})";
  const Result<AppearanceNetwork> network = AppearanceNetwork::load(write(mean_color_, settings));
  ASSERT_TRUE(network);
  const NetworkVector a{network->hash(), {1, 0, 0}}, b{network->hash(), {0.6F, 0.8F, 0}};
  EXPECT_FLOAT_EQ(*network->distance(a, b), (1 - 0.6F) / 0.5F);
  EXPECT_FLOAT_EQ(*network->distance(a, a), 0);
  EXPECT_FALSE(network->distance(a, std::nullopt));
  EXPECT_FALSE(network->distance(a, NetworkVector{"another", {1, 0, 0}}));
  EXPECT_FALSE(network->distance(a, NetworkVector{network->hash(), {1, 0}}));
}

TEST_F(AppearanceNetworkTest, HashDependsOnNetworkAndSettings) {
  const auto hashOf = [](const std::filesystem::path& file) {
    return AppearanceNetwork::load(file).value().hash();
  };
  const std::string hash = hashOf(write(mean_color_));
  EXPECT_THAT(hash, testing::MatchesRegex("[0-9a-f]{64}"));
  EXPECT_EQ(hashOf(write(mean_color_, kSettings, "copy")), hash);
  EXPECT_NE(hashOf(write(mean_color_, R"({"input": [4, 4], "mean": [0, 0, 0], "scale": 1})")), hash);
  EXPECT_NE(hashOf(write(networkOf({"GlobalMaxPool", "Flatten"}))), hash);
}

TEST_F(AppearanceNetworkTest, NamesALayer_WhenOpenCvDoesNotKnowIt) {
  EXPECT_THAT(refusal(write(networkOf({"GlobalAveragePool", "Einsum"}))),
              AllOf(HasSubstr("net.onnx"), HasSubstr("has a layer that cannot be read: Einsum.")));
}

TEST_F(AppearanceNetworkTest, NamesTheFile_WhenItIsMissingOrNoNetwork) {
  EXPECT_THAT(refusal(folder_ / "none.onnx"), HasSubstr("none.onnx"));
  EXPECT_THAT(refusal(write("This is a letter.")), AllOf(HasSubstr("net.onnx"), HasSubstr("cannot be read")));
  EXPECT_THAT(refusal(write("")), HasSubstr("net.onnx"));
}

TEST_F(AppearanceNetworkTest, NamesTheSettings_WhenTheyAreMissingOrWrong) {
  const std::filesystem::path alone = folder_.write("alone.onnx", mean_color_);
  EXPECT_THAT(refusal(alone), AllOf(HasSubstr("alone.json"), HasSubstr("input, mean and scale")));
  for (const char* settings :
       {"", "[]", "{\"input\": [4, 4]}", R"({"input": [4], "mean": [0, 0, 0], "scale": 1})",
        R"({"input": [0, 4], "mean": [0, 0, 0], "scale": 1})",
        R"({"input": [4, 90000], "mean": [0, 0, 0], "scale": 1})",
        R"({"input": [4, 4], "mean": "gray", "scale": 1})",
        R"({"input": [4, 4], "mean": [0, 0, 0], "scale": 1, "unrelated": 0})"}) {
    EXPECT_THAT(refusal(write(mean_color_, settings)), HasSubstr("net.json")) << settings;
  }
}

}  // namespace
}  // namespace scantrove::test
