# The package for Debian (packaging/package): what is installed, and what the package says of itself.
# The version is that of project(), the date that of SOURCE_DATE_EPOCH: the same commit gives the same bytes.
include(GNUInstallDirs)

set(SCANTROVE_APP_ID io.github.scantrove.Scantrove)
set(SCANTROVE_MAINTAINER "Scantrove maintainers <scantrove@users.noreply.github.com>")
set(desktop "${PROJECT_SOURCE_DIR}/packaging/desktop")
set(made "${PROJECT_BINARY_DIR}/packaging")
file(MAKE_DIRECTORY "${made}")
if(DEFINED ENV{SOURCE_DATE_EPOCH})
  set(date "$ENV{SOURCE_DATE_EPOCH}")
else()
  string(TIMESTAMP date "%s" UTC)
endif()

# The manual page and the completions come from the program's own parser.
find_program(GZIP_PROGRAM gzip REQUIRED)
set(documents "")
foreach(kind IN ITEMS man bash zsh)
  add_custom_command(OUTPUT "${made}/scantrove.${kind}"
    COMMAND $<TARGET_FILE:scantrove> reference ${kind} > "${made}/scantrove.${kind}"
    DEPENDS scantrove COMMENT "Writing the reference for ${kind}" VERBATIM)
  list(APPEND documents "${made}/scantrove.${kind}")
endforeach()
add_custom_command(OUTPUT "${made}/scantrove.1.gz"
  COMMAND "${GZIP_PROGRAM}" -9 -n -c "${made}/scantrove.man" > "${made}/scantrove.1.gz"
  DEPENDS "${made}/scantrove.man" VERBATIM)
add_custom_command(OUTPUT "${made}/changelog"
  COMMAND "${PROJECT_SOURCE_DIR}/packaging/debian/make-changelog" "${PROJECT_SOURCE_DIR}/CHANGELOG.md"
          "${SCANTROVE_MAINTAINER}" "${date}" > "${made}/changelog"
  DEPENDS "${PROJECT_SOURCE_DIR}/CHANGELOG.md" "${PROJECT_SOURCE_DIR}/packaging/debian/make-changelog" VERBATIM)
add_custom_command(OUTPUT "${made}/changelog.gz"
  COMMAND "${GZIP_PROGRAM}" -9 -n -c "${made}/changelog" > "${made}/changelog.gz"
  DEPENDS "${made}/changelog" VERBATIM)
add_custom_target(scantrove_documents ALL DEPENDS ${documents} "${made}/scantrove.1.gz" "${made}/changelog.gz")

install(FILES "${made}/scantrove.1.gz" DESTINATION "${CMAKE_INSTALL_MANDIR}/man1")
install(FILES "${made}/scantrove.bash" DESTINATION "${CMAKE_INSTALL_DATADIR}/bash-completion/completions"
        RENAME scantrove)
install(FILES "${made}/scantrove.zsh" DESTINATION "${CMAKE_INSTALL_DATADIR}/zsh/vendor-completions"
        RENAME _scantrove)
install(FILES "${made}/changelog.gz" "${PROJECT_SOURCE_DIR}/packaging/debian/copyright"
        DESTINATION "${CMAKE_INSTALL_DATADIR}/doc/scantrove")
# packaging/package builds the guide first; without it the program says where its pages are.
set(guide "${PROJECT_SOURCE_DIR}/build/guide")
if(EXISTS "${guide}/index.html")
  install(DIRECTORY "${guide}/" DESTINATION "${CMAKE_INSTALL_DATADIR}/doc/scantrove/guide")
else()
  message(STATUS "The guide is not installed: packaging/guide builds it")
endif()
install(FILES "${desktop}/${SCANTROVE_APP_ID}.desktop" DESTINATION "${CMAKE_INSTALL_DATADIR}/applications")
install(FILES "${desktop}/${SCANTROVE_APP_ID}.metainfo.xml" DESTINATION "${CMAKE_INSTALL_DATADIR}/metainfo")
install(FILES "${desktop}/${SCANTROVE_APP_ID}.mime.xml" DESTINATION "${CMAKE_INSTALL_DATADIR}/mime/packages"
        RENAME ${SCANTROVE_APP_ID}.xml)
install(FILES "${PROJECT_SOURCE_DIR}/resources/icons/scantrove.svg"
        DESTINATION "${CMAKE_INSTALL_DATADIR}/icons/hicolor/scalable/apps" RENAME ${SCANTROVE_APP_ID}.svg)

set(CPACK_GENERATOR DEB)
set(CPACK_PACKAGE_NAME scantrove)
set(CPACK_PACKAGE_VERSION "${PROJECT_VERSION}")
set(CPACK_PACKAGE_CONTACT "${SCANTROVE_MAINTAINER}")
set(CPACK_PACKAGE_DESCRIPTION_SUMMARY "sweep an RGB-D camera, collect an object database")
set(CPACK_PACKAGE_DESCRIPTION
"Scantrove fuses the frames of a depth camera, or of a recording, into a map. It
segments the scene while the camera moves and discovers the objects in it. It
recognises those that it knows and adds the others to a catalogue, where a
person names and confirms them. A click on a region labels it in every frame.
.
Data sets are exported as COCO, BOP, YOLO, Pascal VOC, Label Studio, meshes and
labelled point clouds. Everything works in a window and on the command line.")
set(CPACK_PACKAGING_INSTALL_PREFIX /usr)
set(CPACK_INSTALL_DEFAULT_DIRECTORY_PERMISSIONS
    OWNER_READ OWNER_WRITE OWNER_EXECUTE GROUP_READ GROUP_EXECUTE WORLD_READ WORLD_EXECUTE)
set(CPACK_STRIP_FILES ON)
set(CPACK_DEBIAN_FILE_NAME DEB-DEFAULT)
set(CPACK_DEBIAN_COMPRESSION_TYPE xz)
set(CPACK_DEBIAN_PACKAGE_SECTION science)
set(CPACK_DEBIAN_PACKAGE_CONTROL_STRICT_PERMISSION ON)
set(CPACK_DEBIAN_PACKAGE_SHLIBDEPS ON)
# What is loaded at run time, which dpkg-shlibdeps cannot see: a driver of OpenCL, Qt's plugins (database, platforms,
# icons), the driver of OpenGL, the drivers of OpenNI, a font for the 3D view. See packaging/install-dependencies.
string(JOIN ", " CPACK_DEBIAN_PACKAGE_DEPENDS
  "pocl-opencl-icd | opencl-icd" libqt6sql6-sqlite qt6-qpa-plugins libqt6svg6 libxcb-cursor0 libxkbcommon-x11-0
  libgl1-mesa-dri libopenni2-0 fonts-dejavu-core hicolor-icon-theme)
string(JOIN ", " CPACK_DEBIAN_PACKAGE_RECOMMENDS shared-mime-info qt6-translations-l10n)
# A Kinect v1, an iPhone on USB, a catalogue on a server.
string(JOIN ", " CPACK_DEBIAN_PACKAGE_SUGGESTS libfreenect0.5 usbmuxd libqt6sql6-psql)
include(CPack)
