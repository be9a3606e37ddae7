# Every library Scantrove stands on, all from Debian. Two traps:
#  * find_package(PCL) drags in VTK's Qt 5 widgets, so PCL's plain libraries are linked by name;
#  * opencv_highgui and vtkGUISupportQt link Qt 5 and are never linked (a test asserts it).
find_package(Threads REQUIRED)
find_package(Eigen3 3.4 REQUIRED NO_MODULE)
find_package(OpenCV 4.6 REQUIRED COMPONENTS core imgproc imgcodecs calib3d features2d video dnn rgbd ximgproc)
find_package(spdlog REQUIRED)
find_package(Qt6 6.4 REQUIRED COMPONENTS Core Sql Gui Widgets Svg)
find_package(VTK 9.1 REQUIRED COMPONENTS
  CommonCore CommonDataModel CommonTransforms FiltersSources InteractionStyle InteractionWidgets
  RenderingAnnotation RenderingCore RenderingFreeType RenderingOpenGL2 RenderingUI IOImage)

find_path(OPENCL_HPP_DIR CL/opencl.hpp REQUIRED)
find_library(OPENCL_LIBRARY OpenCL REQUIRED)
add_library(scantrove_opencl INTERFACE)
target_link_libraries(scantrove_opencl INTERFACE ${OPENCL_LIBRARY})
target_compile_definitions(scantrove_opencl INTERFACE
  CL_HPP_TARGET_OPENCL_VERSION=120 CL_HPP_MINIMUM_OPENCL_VERSION=120 CL_TARGET_OPENCL_VERSION=120
  CL_HPP_ENABLE_EXCEPTIONS)

find_path(OPENNI2_INCLUDE_DIR OpenNI.h PATH_SUFFIXES openni2 REQUIRED)
find_library(OPENNI2_LIBRARY OpenNI2 REQUIRED)
add_library(scantrove_openni2 INTERFACE)
target_include_directories(scantrove_openni2 SYSTEM INTERFACE ${OPENNI2_INCLUDE_DIR})
target_link_libraries(scantrove_openni2 INTERFACE ${OPENNI2_LIBRARY})

# Kinect v1; without it Scantrove builds and says that it cannot open one.
find_path(FREENECT_INCLUDE_DIR libfreenect.h PATH_SUFFIXES libfreenect)
find_library(FREENECT_LIBRARY freenect)
add_library(scantrove_freenect INTERFACE)
if(FREENECT_LIBRARY AND FREENECT_INCLUDE_DIR)
  target_include_directories(scantrove_freenect SYSTEM INTERFACE ${FREENECT_INCLUDE_DIR})
  target_link_libraries(scantrove_freenect INTERFACE ${FREENECT_LIBRARY})
else()
  message(STATUS "libfreenect was not found: no Kinect v1")
endif()

find_path(PCL_INCLUDE_DIR pcl/point_types.h PATH_SUFFIXES pcl-1.13 pcl-1.12 REQUIRED)
find_library(PCL_COMMON_LIBRARY pcl_common REQUIRED)
find_library(PCL_KDTREE_LIBRARY pcl_kdtree REQUIRED)  # of a benchmark
find_library(PCL_IO_LIBRARY pcl_io REQUIRED)
find_library(PCL_FEATURES_LIBRARY pcl_features REQUIRED)
find_library(PCL_FILTERS_LIBRARY pcl_filters REQUIRED)
add_library(scantrove_pcl INTERFACE)
target_include_directories(scantrove_pcl SYSTEM INTERFACE ${PCL_INCLUDE_DIR})
target_link_libraries(scantrove_pcl INTERFACE
  ${PCL_COMMON_LIBRARY} ${PCL_IO_LIBRARY} ${PCL_FEATURES_LIBRARY} ${PCL_FILTERS_LIBRARY} Eigen3::Eigen)

find_path(EXPECTED_INCLUDE_DIR tl/expected.hpp REQUIRED)
find_path(CLI11_INCLUDE_DIR CLI/CLI.hpp REQUIRED)
find_path(TOMLPP_INCLUDE_DIR toml++/toml.h REQUIRED)
find_path(NLOHMANN_JSON_INCLUDE_DIR nlohmann/json.hpp REQUIRED)
find_path(LIBDEFLATE_INCLUDE_DIR libdeflate.h REQUIRED)
find_library(LIBDEFLATE_LIBRARY deflate REQUIRED)
find_path(SPNG_INCLUDE_DIR spng.h REQUIRED)
find_library(SPNG_LIBRARY spng REQUIRED)
find_path(TURBOJPEG_INCLUDE_DIR turbojpeg.h REQUIRED)
find_library(TURBOJPEG_LIBRARY turbojpeg REQUIRED)
find_path(LZ4_INCLUDE_DIR lz4.h REQUIRED)
find_library(LZ4_LIBRARY lz4 REQUIRED)
find_package(OpenEXR 3.1 CONFIG REQUIRED)
find_package(ZLIB REQUIRED)
find_package(PkgConfig REQUIRED)
pkg_check_modules(LIBAV REQUIRED IMPORTED_TARGET libavformat libavcodec libswscale libavutil)
pkg_check_modules(LIBZIP REQUIRED IMPORTED_TARGET libzip)
# iPhones on USB; it brings what it needs of libplist.
pkg_check_modules(USBMUXD REQUIRED IMPORTED_TARGET libusbmuxd-2.0)
# Containers of recordings: chunks of ROS bags and MCAP files, databases of rosbag2.
find_path(ZSTD_INCLUDE_DIR zstd.h REQUIRED)
find_library(ZSTD_LIBRARY zstd REQUIRED)
find_path(BZ2_INCLUDE_DIR bzlib.h REQUIRED)
find_library(BZ2_LIBRARY bz2 REQUIRED)
find_path(SQLITE3_INCLUDE_DIR sqlite3.h REQUIRED)
find_library(SQLITE3_LIBRARY sqlite3 REQUIRED)

# The labels of NYUv2. The serial library, which VTK and OpenCV use as well; names of its own, because VTK looks for HDF5.
find_path(HDF5_SERIAL_INCLUDE_DIR hdf5.h PATH_SUFFIXES hdf5/serial REQUIRED)
find_library(HDF5_SERIAL_LIBRARY hdf5_serial REQUIRED)
add_library(scantrove_hdf5 INTERFACE)
target_include_directories(scantrove_hdf5 SYSTEM INTERFACE ${HDF5_SERIAL_INCLUDE_DIR})
target_link_libraries(scantrove_hdf5 INTERFACE ${HDF5_SERIAL_LIBRARY})
