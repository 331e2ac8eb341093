# SPDX-License-Identifier: GPL-3.0-or-later

include(CMakePackageConfigHelpers)

set(SMA_PACKAGE_FOLDER "${CMAKE_INSTALL_LIBDIR}/cmake/Surface_mesh_adaptation")

configure_package_config_file(cmake/Surface_mesh_adaptationConfig.cmake.in
  "${PROJECT_BINARY_DIR}/Surface_mesh_adaptationConfig.cmake" INSTALL_DESTINATION "${SMA_PACKAGE_FOLDER}")
write_basic_package_version_file("${PROJECT_BINARY_DIR}/Surface_mesh_adaptationConfigVersion.cmake"
  COMPATIBILITY SameMinorVersion ARCH_INDEPENDENT)

install(DIRECTORY include/ DESTINATION "${CMAKE_INSTALL_INCLUDEDIR}")
install(TARGETS Surface_mesh_adaptation EXPORT Surface_mesh_adaptationTargets)
install(EXPORT Surface_mesh_adaptationTargets NAMESPACE CGAL:: DESTINATION "${SMA_PACKAGE_FOLDER}")
install(FILES
  "${PROJECT_BINARY_DIR}/Surface_mesh_adaptationConfig.cmake"
  "${PROJECT_BINARY_DIR}/Surface_mesh_adaptationConfigVersion.cmake"
  cmake/Surface_mesh_adaptation_dependencies.cmake
  DESTINATION "${SMA_PACKAGE_FOLDER}")
if(TARGET adapt_mesh)
  install(TARGETS adapt_mesh RUNTIME DESTINATION "${CMAKE_INSTALL_BINDIR}")
endif()
