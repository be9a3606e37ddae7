#pragma once

namespace scantrove {

/// What this process has mapped of its program and its libraries leaves its memory; what of that still runs
/// comes back by itself from the system's file cache. Libraries hold 150 MB when a scan has begun, half of it
/// the compiler that OpenCL brings along, which hardly runs once the kernels are built: 45 MB come back.
/// Takes a millisecond or two, and as much again while things come back. From any thread; nothing where there
/// is no way to, or under a debugger.
void releaseProgramPages();

}  // namespace scantrove
