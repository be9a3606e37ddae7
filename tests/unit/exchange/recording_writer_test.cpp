#include "core/exchange/recording_writer.h"

#include <gmock/gmock.h>

#include <optional>

#include "tests/support/temporary_folder.h"

namespace scantrove {
namespace {

using testing::HasSubstr;

TEST(RecordingWriter, AFolderIsOfOneRecordingAtATime) {
  const test::TemporaryFolder folder;
  std::optional<Result<RecordingWriter>> first = RecordingWriter::create(folder / "out", {});
  ASSERT_TRUE(*first) << first->error().message();
  const Result<RecordingWriter> second = RecordingWriter::create(folder / "out", {});
  ASSERT_FALSE(second) << "nothing is in it yet, but something will be";
  EXPECT_THAT(second.error().message(), HasSubstr("Another program is writing to the folder"));
  first.reset();
  EXPECT_TRUE(RecordingWriter::create(folder / "out", {})) << "that one recorded nothing";
}

}  // namespace
}  // namespace scantrove
