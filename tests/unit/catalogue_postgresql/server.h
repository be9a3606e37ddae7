#pragma once
#include "tests/support/private_postgresql.h"

namespace scantrove::test {

/// The server of this program's tests.
[[nodiscard]] PrivatePostgresql& server();

}  // namespace scantrove::test
