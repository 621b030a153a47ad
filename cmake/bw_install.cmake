# SPDX-FileCopyrightText: 2026 The Bladewright authors
# SPDX-License-Identifier: MIT
#
# What an installed Bladewright consists of, and its packages. The programs find their resources from where they lie themselves
# (../share/bladewright), so that a prefix can be moved as a whole; a build tree has a link to the sources there.

file(MAKE_DIRECTORY ${CMAKE_BINARY_DIR}/share)
file(CREATE_LINK ${PROJECT_SOURCE_DIR}/resources ${CMAKE_BINARY_DIR}/share/bladewright SYMBOLIC)

# Whoever installs, others read it too.
set(CMAKE_INSTALL_DEFAULT_DIRECTORY_PERMISSIONS
    OWNER_READ OWNER_WRITE OWNER_EXECUTE GROUP_READ GROUP_EXECUTE WORLD_READ WORLD_EXECUTE)
foreach(program blade bladewright)
  if(TARGET ${program})
    install(TARGETS ${program} RUNTIME DESTINATION bin)
  endif()
endforeach()
install(DIRECTORY resources/blades resources/cells resources/robots resources/examples DESTINATION share/bladewright)
install(FILES LICENSE DESTINATION share/doc/bladewright RENAME copyright)
install(FILES README.md CHANGELOG.md DESTINATION share/doc/bladewright)
install(DIRECTORY docs DESTINATION share/doc/bladewright)
if(TARGET bladewright)
  install(FILES resources/desktop/bladewright.desktop DESTINATION share/applications)
  install(FILES resources/desktop/bladewright.xml DESTINATION share/mime/packages)
  install(FILES resources/icons/bladewright.svg DESTINATION share/icons/hicolor/scalable/apps)
  install(FILES resources/desktop/bladewright-48.png DESTINATION share/icons/hicolor/48x48/apps RENAME bladewright.png)
endif()

set(CPACK_GENERATOR DEB TGZ)
set(CPACK_PACKAGE_NAME bladewright)
set(CPACK_PACKAGE_VENDOR "The Bladewright authors")
set(CPACK_PACKAGE_CONTACT "The Bladewright authors <authors@bladewright.invalid>")
set(CPACK_PACKAGE_DESCRIPTION_SUMMARY "design and programs for robotic hot-blade cutting")
string(CONCAT CPACK_PACKAGE_DESCRIPTION
  "Takes a CAD surface, finds the motion of a thin heated blade between two robots that cuts it from foam,\n"
  "shows deviation, speeds, angles and curvature, and writes the programs of the robots.\n"
  "Holds the desktop program bladewright and the command line blade.")
set(CPACK_PACKAGE_CHECKSUM SHA256)
set(CPACK_RESOURCE_FILE_LICENSE ${PROJECT_SOURCE_DIR}/LICENSE)
set(CPACK_RESOURCE_FILE_README ${PROJECT_SOURCE_DIR}/README.md)
set(CPACK_STRIP_FILES ON)
set(CPACK_THREADS 0)
set(CPACK_DEBIAN_FILE_NAME DEB-DEFAULT)
set(CPACK_DEBIAN_PACKAGE_SECTION graphics)
set(CPACK_DEBIAN_PACKAGE_SHLIBDEPS ON)
# Loaded while the program runs, so that shlibdeps does not see them: drawing in software, and the letters of pictures.
set(CPACK_DEBIAN_PACKAGE_DEPENDS "libgl1-mesa-dri, fonts-dejavu-core")
include(CPack)
