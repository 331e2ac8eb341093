# SPDX-License-Identifier: GPL-3.0-or-later
#
# Targets for whoever works on the project: `format` rewrites the sources, `tidy` looks for trouble in the programs.

file(GLOB_RECURSE SMA_SOURCES CONFIGURE_DEPENDS
  include/*.h examples/*.h examples/*.cpp test/*.h test/*.cpp benchmark/*.h benchmark/*.cpp)
set(SMA_PROGRAMS ${SMA_SOURCES})
list(FILTER SMA_PROGRAMS INCLUDE REGEX "\\.cpp$")
list(FILTER SMA_PROGRAMS EXCLUDE REGEX "/test/Surface_mesh_adaptation/package/") # a project of its own

find_program(SMA_CLANG_FORMAT NAMES clang-format clang-format-14)
find_program(SMA_CLANG_TIDY NAMES clang-tidy clang-tidy-14)
mark_as_advanced(SMA_CLANG_FORMAT SMA_CLANG_TIDY)
if(SMA_CLANG_FORMAT)
  add_custom_target(format COMMAND ${SMA_CLANG_FORMAT} -i ${SMA_SOURCES} WORKING_DIRECTORY ${PROJECT_SOURCE_DIR})
endif()
if(SMA_CLANG_TIDY)
  add_custom_target(tidy COMMAND ${SMA_CLANG_TIDY} --quiet -p ${PROJECT_BINARY_DIR} ${SMA_PROGRAMS}
                    WORKING_DIRECTORY ${PROJECT_SOURCE_DIR})
endif()
