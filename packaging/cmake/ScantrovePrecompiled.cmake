# The heavy foreign headers, compiled once for many files:
#   core    the standard library, Eigen, OpenCV's matrices, spdlog, tl::expected
#   window  core and Qt's widgets
#   tests   core and GoogleTest
# And a target's own files, some at a time, as one: what they instantiate alike (Eigen, OpenCV, json) is compiled once.
# A file still includes all that it uses, and its names are its target's only ones: packaging/lint compiles each alone.
option(SCANTROVE_PRECOMPILE "Precompile heavy foreign headers" ON)
option(SCANTROVE_UNITY "Compile the files of a target together" ON)

set(scantrove_core_headers
  <algorithm> <array> <chrono> <cmath> <cstdint> <filesystem> <functional> <map> <memory> <mutex> <optional> <span>
  <string> <string_view> <thread> <unordered_map> <utility> <variant> <vector>
  <Eigen/Geometry> <opencv2/core.hpp> <spdlog/spdlog.h> <tl/expected.hpp>)
set(scantrove_window_headers
  ${scantrove_core_headers}
  <QAction> <QBoxLayout> <QComboBox> <QDialog> <QFileDialog> <QFormLayout> <QImage> <QLabel> <QListView> <QMainWindow>
  <QObject> <QPainter> <QPainterPath> <QPushButton> <QSettings> <QString> <QTimer> <QToolButton> <QUndoStack> <QWidget>)

# FOR_PROGRAMS: for programs with and without Qt, which asks its users for -fPIC.
function(scantrove_declare_precompiled kind)
  cmake_parse_arguments(ARG "FOR_PROGRAMS" "" "HEADERS;LINK" ${ARGN})
  file(CONFIGURE OUTPUT "${CMAKE_BINARY_DIR}/precompiled/${kind}.cpp" CONTENT "int main() {}\n")
  if(ARG_FOR_PROGRAMS)
    add_executable(scantrove_precompiled_${kind} EXCLUDE_FROM_ALL "${CMAKE_BINARY_DIR}/precompiled/${kind}.cpp")
    target_compile_options(scantrove_precompiled_${kind} PRIVATE -fPIC)
  else()
    add_library(scantrove_precompiled_${kind} STATIC EXCLUDE_FROM_ALL "${CMAKE_BINARY_DIR}/precompiled/${kind}.cpp")
  endif()
  set_target_properties(scantrove_precompiled_${kind} PROPERTIES AUTOMOC OFF AUTORCC OFF)
  target_link_libraries(scantrove_precompiled_${kind} PRIVATE scantrove_settings spdlog::spdlog Threads::Threads
    Eigen3::Eigen opencv_core ${ARG_LINK})
  target_include_directories(scantrove_precompiled_${kind} SYSTEM PRIVATE ${EXPECTED_INCLUDE_DIR})
  target_precompile_headers(scantrove_precompiled_${kind} PRIVATE ${ARG_HEADERS})
endfunction()

if(SCANTROVE_PRECOMPILE)
  scantrove_declare_precompiled(core HEADERS ${scantrove_core_headers})
  if(SCANTROVE_BUILD_TESTS)
    find_package(GTest REQUIRED)
    scantrove_declare_precompiled(tests FOR_PROGRAMS LINK GTest::gtest GTest::gmock
      HEADERS ${scantrove_core_headers} <gmock/gmock.h> <gtest/gtest.h>)
  endif()
  scantrove_declare_precompiled(window LINK Qt6::Core Qt6::Gui Qt6::Widgets HEADERS ${scantrove_window_headers})
endif()

# scantrove_precompile(<target> core|window|tests)
function(scantrove_precompile target kind)
  if(SCANTROVE_PRECOMPILE)
    target_precompile_headers(${target} REUSE_FROM scantrove_precompiled_${kind})
  endif()
endfunction()

# Not all at once: a change to one file is compiled again in seconds, and all cores have something to do.
function(scantrove_compile_together target)
  set_target_properties(${target} PROPERTIES UNITY_BUILD ${SCANTROVE_UNITY} UNITY_BUILD_BATCH_SIZE 18)
endfunction()
