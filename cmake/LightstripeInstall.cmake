# SPDX-FileCopyrightText: 2026 The lightstripe authors
# SPDX-License-Identifier: Apache-2.0

# `cmake --install` in three components: program (binary, man page, completion, examples of files), development
# (headers, static libraries, CMake package LightStripe) and python (where it is built).
include(GNUInstallDirs)
include(CMakePackageConfigHelpers)
set(LIGHTSTRIPE_INSTALL_HEADERS ${CMAKE_INSTALL_INCLUDEDIR}/lightstripe)
set(LIGHTSTRIPE_INSTALL_CMAKE ${CMAKE_INSTALL_LIBDIR}/cmake/LightStripe)

# lightstripe_install_library(<name>): called by lightstripe_library in the library's folder. Headers keep their folder, so
# that a program includes "core/rig.h" whether it uses the tree or an installation.
function(lightstripe_install_library name)
  install(TARGETS lightstripe_${name} EXPORT lightstripe ARCHIVE COMPONENT development)
  install(DIRECTORY ${CMAKE_CURRENT_SOURCE_DIR}/ DESTINATION ${LIGHTSTRIPE_INSTALL_HEADERS}/${name} COMPONENT development
          FILES_MATCHING PATTERN "*.h")
  set_property(GLOBAL APPEND PROPERTY LIGHTSTRIPE_LIBRARIES lightstripe::${name})
endfunction()

# lightstripe_install_package(): after all libraries; also makes lightstripe::lightstripe, which stands for all of them.
function(lightstripe_install_package)
  get_property(libraries GLOBAL PROPERTY LIGHTSTRIPE_LIBRARIES)
  add_library(lightstripe_all INTERFACE)
  add_library(lightstripe::lightstripe ALIAS lightstripe_all)
  set_target_properties(lightstripe_all PROPERTIES EXPORT_NAME lightstripe)
  target_link_libraries(lightstripe_all INTERFACE ${libraries})
  install(TARGETS lightstripe_all EXPORT lightstripe COMPONENT development)
  install(EXPORT lightstripe FILE LightStripeTargets.cmake NAMESPACE lightstripe:: DESTINATION ${LIGHTSTRIPE_INSTALL_CMAKE}
          COMPONENT development)
  configure_package_config_file(${PROJECT_SOURCE_DIR}/cmake/LightStripeConfig.cmake.in
                                ${PROJECT_BINARY_DIR}/LightStripeConfig.cmake INSTALL_DESTINATION ${LIGHTSTRIPE_INSTALL_CMAKE})
  # Before 1.0 a minor version may change the interface.
  write_basic_package_version_file(${PROJECT_BINARY_DIR}/LightStripeConfigVersion.cmake COMPATIBILITY SameMinorVersion)
  install(FILES ${PROJECT_SOURCE_DIR}/cmake/LightstripeDependencies.cmake ${PROJECT_BINARY_DIR}/LightStripeConfig.cmake
                ${PROJECT_BINARY_DIR}/LightStripeConfigVersion.cmake
          DESTINATION ${LIGHTSTRIPE_INSTALL_CMAKE} COMPONENT development)
endfunction()
