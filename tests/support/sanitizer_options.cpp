// Linked into every executable of a build with a sanitizer, so that `ctest --preset asan` (or tsan) reports
// this project's errors only. The sanitizer's runtime calls these functions by name; nothing else does.

extern "C" {

const char* __asan_default_options();
const char* __lsan_default_suppressions();
const char* __tsan_default_suppressions();
int dlclose(void* library);

// Without this the leak check of a process with many OpenCL threads fails on its own ("Tracer caught signal
// 11").
const char* __asan_default_options() { return "intercept_tls_get_addr=0"; }

// Memory that libraries keep for the life of the process: OpenNI2 and its drivers, D-Bus below Qt, Mesa's
// software OpenGL with the LLVM and X libraries that it brings; and PoCL, 16 bytes whenever it compiles a
// kernel that is not in its cache yet (which hides an OpenCL object that we forget, too; all of them are held
// by cl:: handles).
const char* __lsan_default_suppressions() {
  return "leak:libOpenNI2\n"
         "leak:OpenNI2/Drivers\n"
         "leak:libdbus-1\n"
         "leak:_dri.so\n"
         "leak:libGLX_mesa\n"
         "leak:libLLVM\n"
         "leak:libpocl\n"
         "leak:libxcb\n";
}

// Libraries built without the thread sanitizer, whose locks it does not see: OpenNI2 and its drivers, Qt's
// lock of its list of database connections, and GDAL, which OpenCV loads and which orders its locks when it
// starts. And OpenCV's own counting of who holds an image: the last one to let go frees it.
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
// OpenCV's threads are TBB's, of whose locks the thread sanitizer sees nothing either: what a loop over an
// image writes on one of them would be a race with whoever reads it afterwards. So they all run on their
// caller's.
namespace cv {
void setNumThreads(int threads) __attribute__((weak));  // a program need not have OpenCV
}
__attribute__((constructor)) static void runLoopsOnOneThread() {
  if (cv::setNumThreads != nullptr) cv::setNumThreads(0);
}
#endif

extern "C" {

// Plug-ins stay loaded: the report could not name the library of a leak otherwise.
int dlclose(void* /*library*/) { return 0; }

}  // extern "C"
