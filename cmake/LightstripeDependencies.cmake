# SPDX-FileCopyrightText: 2026 The lightstripe authors
# SPDX-License-Identifier: Apache-2.0

# The libraries of others that the public targets name; used by this tree and by an installation alike.
include(CMakeFindDependencyMacro)
find_dependency(Eigen3 3.4 NO_MODULE)
find_dependency(fmt)
find_dependency(nlohmann_json)
find_dependency(yaml-cpp)
find_dependency(OpenCV 4.6 COMPONENTS core imgproc imgcodecs videoio calib3d features2d)
find_dependency(Ceres 2.1)
find_dependency(TBB)
find_dependency(PkgConfig)
pkg_check_modules(hwy REQUIRED IMPORTED_TARGET libhwy)
# By pkg-config: PCLConfig.cmake would also want all that VTK was built with (MPI, Qt ...).
pkg_check_modules(pcl_io REQUIRED IMPORTED_TARGET pcl_io)
