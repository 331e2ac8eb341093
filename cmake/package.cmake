# SPDX-License-Identifier: GPL-3.0-or-later
#
# The target `man`: the manual page of adapt_mesh. And what `cpack` needs for a Debian package of what is installed:
# headers, CMake package, adapt_mesh and, where these were made, its manual page and the manual as HTML.

set(CPACK_PACKAGE_NAME surface-mesh-adaptation)
set(SMA_DOC_FOLDER "${CMAKE_INSTALL_DATAROOTDIR}/doc/${CPACK_PACKAGE_NAME}")

find_package(Python3 QUIET COMPONENTS Interpreter)
if(TARGET adapt_mesh AND Python3_FOUND AND NOT CMAKE_CROSSCOMPILING)
  set(SMA_MAN_PAGE "${PROJECT_BINARY_DIR}/adapt_mesh.1.gz")
  set(SMA_MANUAL "${PROJECT_SOURCE_DIR}/doc/Surface_mesh_adaptation/User_manual.md")
  add_custom_command(OUTPUT "${SMA_MAN_PAGE}"
    COMMAND "${PROJECT_SOURCE_DIR}/scripts/man_page" $<TARGET_FILE:adapt_mesh> "${SMA_MANUAL}" "${SMA_MAN_PAGE}"
    DEPENDS adapt_mesh "${PROJECT_SOURCE_DIR}/scripts/man_page" "${SMA_MANUAL}" VERBATIM)
  add_custom_target(man DEPENDS "${SMA_MAN_PAGE}")
  install(FILES "${SMA_MAN_PAGE}" DESTINATION "${CMAKE_INSTALL_MANDIR}/man1" OPTIONAL)
endif()
install(DIRECTORY "${PROJECT_BINARY_DIR}/doc/html" DESTINATION "${SMA_DOC_FOLDER}" OPTIONAL)
install(FILES cmake/debian_copyright DESTINATION "${SMA_DOC_FOLDER}" RENAME copyright)

file(READ package_info/Surface_mesh_adaptation/long_description.txt CPACK_DEBIAN_PACKAGE_DESCRIPTION)
file(STRINGS package_info/Surface_mesh_adaptation/maintainer CPACK_DEBIAN_PACKAGE_MAINTAINER)
set(CPACK_GENERATOR DEB)
set(CPACK_DEBIAN_FILE_NAME DEB-DEFAULT)
set(CPACK_DEBIAN_PACKAGE_SECTION math)
set(CPACK_DEBIAN_PACKAGE_DEPENDS "libcgal-dev (>= 5.5), libeigen3-dev (>= 3.3)")
set(CPACK_DEBIAN_PACKAGE_SUGGESTS libtbb-dev)
set(CPACK_DEBIAN_PACKAGE_SHLIBDEPS ON)
set(CPACK_STRIP_FILES ON)
include(CPack)
