#pragma once

namespace scantrove {

/// Whether the program must end within seconds, as a signal asked for: what can be left out is, and nothing
/// waits for other programs. Of the process, like the signal. Any thread.
void setEndUrgent(bool is_urgent);
[[nodiscard]] bool isEndUrgent();

}  // namespace scantrove
