#pragma once

namespace scantrove {

/// Thread priorities as nice(2) values: larger values get less processor time when there are more threads
/// than cores. Threads not listed here keep the program's priority.
enum class Niceness {
  none = 0,
  scan_beside_window = 3,  ///< keeps the window responsive; the scan hardly slows down
  catalogue_writer = 5,    ///< frames come first
  session_writer = 5,      ///< likewise
  label_writer = 10,       ///< uses idle time between frames
};

/// Sets the priority of the calling thread and of threads it starts later. Linux only (priorities per
/// thread); no effect elsewhere.
void lowerThreadPriority(Niceness niceness);

}  // namespace scantrove
