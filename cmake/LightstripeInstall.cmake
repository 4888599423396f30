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
# Each library is an export set of its own: who asks for one part needs the libraries of others for that part only.
function(lightstripe_install_library name)
  install(TARGETS lightstripe_${name} EXPORT lightstripe_${name} ARCHIVE COMPONENT development)
  install(EXPORT lightstripe_${name} FILE LightStripe-${name}.cmake NAMESPACE lightstripe:: COMPONENT development
          DESTINATION ${LIGHTSTRIPE_INSTALL_CMAKE})
  install(DIRECTORY ${CMAKE_CURRENT_SOURCE_DIR}/ DESTINATION ${LIGHTSTRIPE_INSTALL_HEADERS}/${name} COMPONENT development
          FILES_MATCHING PATTERN "*.h")
  set_property(GLOBAL APPEND PROPERTY LIGHTSTRIPE_LIBRARIES ${name})
endfunction()

# lightstripe_install_package(): after all libraries; also makes lightstripe::lightstripe, which stands for all of them.
function(lightstripe_install_package)
  get_property(parts GLOBAL PROPERTY LIGHTSTRIPE_LIBRARIES)
  set(lightstripe_part_deps "")
  foreach(part ${parts})
    get_property(deps GLOBAL PROPERTY LIGHTSTRIPE_DEPS_${part})
    string(APPEND lightstripe_part_deps "set(lightstripe_deps_${part} ${deps})\n")
    lightstripe_install_pkg_config(${part} "${deps}")
  endforeach()
  add_library(lightstripe_all INTERFACE)
  add_library(lightstripe::lightstripe ALIAS lightstripe_all)
  list(TRANSFORM parts PREPEND lightstripe:: OUTPUT_VARIABLE libraries)
  target_link_libraries(lightstripe_all INTERFACE ${libraries})
  configure_package_config_file(${PROJECT_SOURCE_DIR}/cmake/LightStripeConfig.cmake.in
                                ${PROJECT_BINARY_DIR}/LightStripeConfig.cmake INSTALL_DESTINATION ${LIGHTSTRIPE_INSTALL_CMAKE})
  # Before 1.0 a minor version may change the interface.
  write_basic_package_version_file(${PROJECT_BINARY_DIR}/LightStripeConfigVersion.cmake COMPATIBILITY SameMinorVersion)
  install(FILES ${PROJECT_SOURCE_DIR}/cmake/LightstripeDependencies.cmake ${PROJECT_BINARY_DIR}/LightStripeConfig.cmake
                ${PROJECT_BINARY_DIR}/LightStripeConfigVersion.cmake
          DESTINATION ${LIGHTSTRIPE_INSTALL_CMAKE} COMPONENT development)
endfunction()

# What a static library of ours needs in `pkg-config --libs`: modules that Debian has, and plain libraries.
set(pkg_config_requires_core eigen3)
set(pkg_config_requires_parallel tbb)
set(pkg_config_requires_io fmt yaml-cpp opencv4 libdeflate libtiff-4)
set(pkg_config_requires_extraction opencv4 libhwy)
set(pkg_config_requires_calib fmt opencv4)
set(pkg_config_libs_calib -lceres -lglog)
set(pkg_config_requires_reconstruct fmt)
set(pkg_config_requires_measure fmt)
set(pkg_config_requires_simulate fmt opencv4)
set(pkg_config_requires_pipeline fmt opencv4)
set(pkg_config_requires_report fmt opencv4)

# lightstripe_install_pkg_config(<part> <parts below it>): lightstripe-<part>.pc.
function(lightstripe_install_pkg_config part deps)
  list(TRANSFORM deps PREPEND lightstripe- OUTPUT_VARIABLE requires)
  list(APPEND requires ${pkg_config_requires_${part}})
  list(JOIN requires ", " LIGHTSTRIPE_REQUIRES)
  list(JOIN pkg_config_libs_${part} " " LIGHTSTRIPE_LIBS)
  set(LIGHTSTRIPE_PART ${part})
  file(RELATIVE_PATH LIGHTSTRIPE_PC_UP /${CMAKE_INSTALL_LIBDIR} /)
  configure_file(${PROJECT_SOURCE_DIR}/cmake/lightstripe.pc.in ${PROJECT_BINARY_DIR}/generated/lightstripe-${part}.pc @ONLY)
  install(FILES ${PROJECT_BINARY_DIR}/generated/lightstripe-${part}.pc DESTINATION ${CMAKE_INSTALL_LIBDIR}/pkgconfig
          COMPONENT development)
endfunction()
