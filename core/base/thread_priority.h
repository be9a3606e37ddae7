#pragma once

namespace scantrove {

/// How far threads give way to the others where there are more of them than cores, as nice(2) counts: the
/// larger, the later. All that are not named here have that of the program.
enum class Niceness {
  none = 0,
  scan_beside_window = 3,  ///< a window that must wait for a core answers late; the scan hardly loses by it
  catalogue_writer = 5,    ///< frames come first
  session_writer = 5,      ///< likewise
  label_writer = 10,       ///< takes what the frames leave idle
};

/// The calling thread and those that it starts from now on. On Linux a thread has a priority of its own;
/// elsewhere nothing happens.
void lowerThreadPriority(Niceness niceness);

}  // namespace scantrove
