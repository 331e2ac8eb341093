# SPDX-License-Identifier: GPL-3.0-or-later
#
# The target `doc`: the manual as HTML, in doc/html of the build folder.

find_package(Doxygen QUIET)
find_package(Python3 QUIET COMPONENTS Interpreter) # for the filter of the pages
if(Doxygen_FOUND AND Python3_FOUND)
  set(SMA_DOC "${PROJECT_SOURCE_DIR}/doc/Surface_mesh_adaptation")
  set(SMA_HEADERS "${PROJECT_SOURCE_DIR}/include/CGAL/Surface_mesh_adaptation")
  configure_file(doc/Surface_mesh_adaptation/Doxyfile.in Doxyfile @ONLY)
  add_custom_target(doc COMMAND Doxygen::doxygen "${PROJECT_BINARY_DIR}/Doxyfile" VERBATIM)
endif()
