// Linked into every executable of a build with a sanitizer, so that `ctest --preset asan` (or tsan) reports
// this project's errors only. The runtime of the sanitizer calls these functions by name.

extern "C" {

const char* __asan_default_options();
const char* __lsan_default_suppressions();
const char* __tsan_default_suppressions();
int dlclose(void* library);

// Otherwise the leak check crashes in a process with many OpenCL threads ("Tracer caught signal 11").
const char* __asan_default_options() { return "intercept_tls_get_addr=0"; }

// Memory that libraries hold until the process ends: OpenNI2 and its drivers, D-Bus of Qt, Mesa's software
// OpenGL with LLVM and X libraries; HDF5 after it has read a damaged file; and PoCL, 16 bytes for each kernel
// compiled without its cache. The last also hides leaked OpenCL objects; cl:: handles hold all of ours.
const char* __lsan_default_suppressions() {
  return "leak:libOpenNI2\n"
         "leak:OpenNI2/Drivers\n"
         "leak:libdbus-1\n"
         "leak:_dri.so\n"
         "leak:libGLX_mesa\n"
         "leak:libLLVM\n"
         "leak:libhdf5\n"
         "leak:libpocl\n"
         "leak:libxcb\n";
}

// Libraries built without the thread sanitizer, which does not see their locks: OpenNI2 and its drivers, Qt's
// lock of database connections, and GDAL, which OpenCV loads and which orders its locks at its start. Also
// OpenCV's reference counts of images.
const char* __tsan_default_suppressions() {
  return "race:libOpenNI2\n"
         "race:OpenNI2/Drivers\n"
         "mutex:libOpenNI2\n"
         "race:QReadWriteLock\n"
         "race:cv::Mat::deallocate\n"
         "thread:OpenNI2/Drivers\n"
         "deadlock:libgdal\n";
}

}  // extern "C"

#ifdef __SANITIZE_THREAD__
// The thread sanitizer does not see the locks of TBB, which runs OpenCV's threads: reads after a parallel
// loop would count as races. So loops run on the calling thread.
namespace cv {
void setNumThreads(int threads) __attribute__((weak));  // a program need not have OpenCV
}
__attribute__((constructor)) static void runLoopsOnOneThread() {
  if (cv::setNumThreads != nullptr) cv::setNumThreads(0);
}
#endif

extern "C" {

// Plug-ins stay loaded, so that a report can name the library of a leak.
int dlclose(void* /*library*/) { return 0; }

}  // extern "C"
