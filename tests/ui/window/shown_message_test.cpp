#include "ui/models/shown_message.h"

#include <gtest/gtest.h>

namespace scantrove::test {
namespace {

TEST(ShownMessage, LeavesOutOptionsOfTheCommandLine) {
  EXPECT_EQ(shownMessage(QStringLiteral("Export unfit frames, too (--include-unfit-frames).")),
            QStringLiteral("Export unfit frames, too."));
  EXPECT_EQ(shownMessage(QStringLiteral("Check them (scantrove session review --list), or go on.")),
            QStringLiteral("Check them, or go on."));
}

TEST(ShownMessage, KeepsOtherParentheses) {
  const QString message = QStringLiteral("The file (mug -- 2).png is missing (see above).");
  EXPECT_EQ(shownMessage(message), message);
}

}  // namespace
}  // namespace scantrove::test
