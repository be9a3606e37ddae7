#include "core/session/final_label_record.h"

#include <gtest/gtest.h>

namespace scantrove {
namespace {

TEST(FinalLabelRecord, IsEmpty_WhenTheMetadataIsDamaged) {
  SessionMetadata metadata{{kFinalLabelsKey, finalLabelsToText({{3, 4, 0.001F, 5, 6}})}};
  const FinalLabelRecord record = finalLabelsFrom(metadata);
  ASSERT_EQ(record.size(), 1U);
  EXPECT_EQ(record[0].frame_index, 3);
  EXPECT_EQ(record[0].depth_checksum, 4U);
  EXPECT_EQ(record[0].checksum, 5U);
  EXPECT_EQ(record[0].next_checksum, 6U);
  metadata[kFinalLabelsKey] = "nonsense";
  EXPECT_TRUE(finalLabelsFrom(metadata).empty());
}

}  // namespace
}  // namespace scantrove
