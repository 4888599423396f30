# SPDX-FileCopyrightText: 2026 The lightstripe authors
# SPDX-License-Identifier: Apache-2.0

# The libraries of others that each part of lightstripe needs: the one table, used by this tree and by an installation.

# lightstripe_need(<package> <arguments of find_package>)
macro(lightstripe_need package)
  if(CMAKE_FIND_PACKAGE_NAME STREQUAL "LightStripe")
    find_dependency(${package} ${ARGN})
  else()
    find_package(${package} ${ARGN} REQUIRED)
  endif()
endmacro()

# lightstripe_need_module(<pkg-config module>): the target PkgConfig::<name>.
macro(lightstripe_need_module name module)
  lightstripe_need(PkgConfig)
  pkg_check_modules(${name} REQUIRED IMPORTED_TARGET ${module})
endmacro()

# lightstripe_find_dependencies(<part>): core, io, extraction ...; not those of the parts below it.
macro(lightstripe_find_dependencies part)
  if("${part}" STREQUAL core)
    lightstripe_need(Eigen3 3.4 NO_MODULE)
  elseif("${part}" STREQUAL parallel)
    lightstripe_need(TBB)
  elseif("${part}" STREQUAL io)
    lightstripe_need(fmt)
    lightstripe_need(yaml-cpp)
    lightstripe_need(OpenCV 4.6 COMPONENTS core imgproc imgcodecs videoio)
    lightstripe_need(TIFF)
  elseif("${part}" STREQUAL extraction)
    lightstripe_need(OpenCV 4.6 COMPONENTS core imgproc)
    lightstripe_need_module(hwy libhwy)
  elseif("${part}" STREQUAL calib)
    lightstripe_need(fmt)
    lightstripe_need(OpenCV 4.6 COMPONENTS core imgproc calib3d features2d aruco)
    lightstripe_need(Ceres 2.1)
  elseif("${part}" STREQUAL reconstruct)
    lightstripe_need(fmt)
    # By pkg-config: PCLConfig.cmake would also want all that VTK was built with (MPI, Qt ...).
    lightstripe_need_module(pcl_io pcl_io)
  elseif("${part}" STREQUAL measure)
    lightstripe_need(fmt)
  elseif("${part}" MATCHES "^(simulate|pipeline|report|truth)$")
    lightstripe_need(fmt)
    lightstripe_need(OpenCV 4.6 COMPONENTS core imgproc)
  endif()
endmacro()
