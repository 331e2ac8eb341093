# SPDX-License-Identifier: GPL-3.0-or-later
#
# The target `doc`: the manual as HTML, in doc/html of the build folder.

find_package(Doxygen QUIET)
find_package(Python3 QUIET COMPONENTS Interpreter) # for the filter of the pages
if(Doxygen_FOUND AND Python3_FOUND)
  # named as in CGAL's documentation system, which reads the same Doxyfile.in
  set(CGAL_PACKAGE_DOC_DIR "${PROJECT_SOURCE_DIR}/doc/Surface_mesh_adaptation")
  set(CGAL_PACKAGE_INCLUDE_DIR "${PROJECT_SOURCE_DIR}/include/")
  set(CGAL_DOC_PACKAGE_DEFAULTS "${PROJECT_BINARY_DIR}/manual_defaults.dxy")
  configure_file(cmake/manual_defaults.dxy.in "${CGAL_DOC_PACKAGE_DEFAULTS}" @ONLY)
  configure_file("${CGAL_PACKAGE_DOC_DIR}/Doxyfile.in" Doxyfile)
  file(APPEND "${PROJECT_BINARY_DIR}/Doxyfile" "PROJECT_NAME = \"Surface Mesh Adaptation\"\n") # no part of a CGAL yet
  add_custom_target(doc COMMAND Doxygen::doxygen "${PROJECT_BINARY_DIR}/Doxyfile" VERBATIM)
endif()
