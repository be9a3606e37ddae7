# Sources of the built-in scene, relative to core/capture.
set(synthetic_sources
  synthetic/bowls_and_boxes.cpp
  synthetic/furniture.cpp
  synthetic/kinect_noise.cpp
  synthetic/lathe.cpp
  synthetic/lighting.cpp
  synthetic/material.cpp
  synthetic/renderer.cpp
  synthetic/room_scene.cpp
  synthetic/rounded_shapes.cpp
  synthetic/scene.cpp
  synthetic/synthetic_source.cpp
  synthetic/tabletop_scene.cpp
  synthetic/test_scenes.cpp
  synthetic/trajectory.cpp
  synthetic/view_caster.cpp)
# The renderer runs beside the scan: no errno from sqrt, and inlining as for release.
set_source_files_properties(${synthetic_sources} PROPERTIES
  COMPILE_OPTIONS "-fno-math-errno;-fno-trapping-math;$<$<NOT:$<CONFIG:Debug>>:-O3>")
