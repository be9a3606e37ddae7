#pragma once

namespace scantrove {

/// Whether a signal requested the program to end within seconds: it skips optional work and waits for no
/// other program. State of the process. Any thread.
void setEndUrgent(bool is_urgent);
[[nodiscard]] bool isEndUrgent();

}  // namespace scantrove
