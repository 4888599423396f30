# SPDX-FileCopyrightText: 2026 The lightstripe authors
# SPDX-License-Identifier: Apache-2.0

# Warnings are errors in our own code; the headers of others are system headers.
add_library(lightstripe_flags INTERFACE)
# -Wrestrict raises false alarms in std::string of g++ 12 (gcc bug 105651).
target_compile_options(lightstripe_flags INTERFACE -Wall -Wextra -Wpedantic -Wshadow -Wconversion -Werror
                                                   $<$<CXX_COMPILER_ID:GNU>:-Wno-restrict>)
set(instruments_address -fsanitize=address,undefined -fno-sanitize-recover=undefined -fno-omit-frame-pointer)
set(instruments_thread -fsanitize=thread -fno-omit-frame-pointer)
set(instruments_coverage --coverage -fprofile-update=atomic)
if(LIGHTSTRIPE_SANITIZE)
  if(NOT DEFINED instruments_${LIGHTSTRIPE_SANITIZE})
    message(FATAL_ERROR "LIGHTSTRIPE_SANITIZE is '${LIGHTSTRIPE_SANITIZE}'; use address, thread, coverage or nothing")
  endif()
  target_compile_options(lightstripe_flags INTERFACE ${instruments_${LIGHTSTRIPE_SANITIZE}})
  target_link_options(lightstripe_flags INTERFACE ${instruments_${LIGHTSTRIPE_SANITIZE}})
endif()
if(LIGHTSTRIPE_SANITIZE STREQUAL "address")
  # Under ASan Eigen aligns its memory in another way than in Debian's Ceres and PCL: what one allocates, the other cannot free.
  target_compile_definitions(lightstripe_flags INTERFACE EIGEN_MALLOC_ALREADY_ALIGNED=1)
endif()
if(LIGHTSTRIPE_FUZZ)
  target_compile_options(lightstripe_flags INTERFACE -fsanitize=fuzzer-no-link)
endif()

# More than half of a first build is reading the headers of Eigen, OpenCV and the standard library again and again. Two ways
# out: a library as one unit (the least work, for who builds once), or precompiled headers (for who edits a file and builds
# again). gcc's precompiled headers do not go together with ccache.
option(LIGHTSTRIPE_UNITY "compile each library as one file: a first build in a third of the time" OFF)
if(CMAKE_CXX_COMPILER_ID STREQUAL GNU AND NOT CMAKE_CXX_COMPILER_LAUNCHER)
  set(precompile_by_default ON)
else()
  set(precompile_by_default OFF)
endif()
option(LIGHTSTRIPE_PRECOMPILE "precompile the headers of others" ${precompile_by_default})
# What holds in each file need not hold in a unit of many: a local name like another file's constant.
target_compile_options(lightstripe_flags INTERFACE $<$<BOOL:$<TARGET_PROPERTY:UNITY_BUILD>>:-Wno-shadow>
                       $<$<AND:$<BOOL:$<TARGET_PROPERTY:UNITY_BUILD>>,$<CXX_COMPILER_ID:GNU>>:-Wno-subobject-linkage>)
if(CMAKE_CXX_COMPILER_ID STREQUAL GNU)
  # What g++ 12 wrongly finds in std::string and std::vector, with precompiled headers and (fewer) without.
  target_compile_options(lightstripe_flags INTERFACE -Wno-array-bounds -Wno-stringop-overread -Wno-stringop-overflow)
endif()
set(lightstripe_precompiled <algorithm> <cmath> <filesystem> <functional> <map> <memory> <optional> <string> <vector>
                            <Eigen/Dense> <fmt/format.h>)

# lightstripe_leave_out_parts(): takes out of LIGHTSTRIPE_PARTS what Ceres is missing for, and says so.
function(lightstripe_leave_out_parts)
  find_package(Ceres 2.1 QUIET)
  if(NOT Ceres_FOUND)
    list(REMOVE_ITEM LIGHTSTRIPE_PARTS calib pipeline report truth)
    message(STATUS "calib, pipeline, report, truth: left out (apt install libceres-dev)")
  endif()
  set(LIGHTSTRIPE_PARTS ${LIGHTSTRIPE_PARTS} PARENT_SCOPE)
endfunction()

# cmake/layers.txt: LIGHTSTRIPE_PARTS, the libraries in the table's order, and layers_of_<part>, those that a part may include.
set(layers_file ${CMAKE_CURRENT_LIST_DIR}/layers.txt)
set_property(DIRECTORY ${PROJECT_SOURCE_DIR} APPEND PROPERTY CMAKE_CONFIGURE_DEPENDS ${layers_file})
file(STRINGS ${layers_file} layer_rows REGEX "^library ")
foreach(row ${layer_rows})
  if(NOT row MATCHES "^library +[|] +([a-z]+) +[|] +([a-z ]*)[|]")
    message(FATAL_ERROR "${layers_file}: '${row}' is no row of the table")
  endif()
  list(APPEND LIGHTSTRIPE_PARTS ${CMAKE_MATCH_1})
  string(REGEX MATCHALL "[a-z]+" layers_of_${CMAKE_MATCH_1} "${CMAKE_MATCH_2}")
endforeach()

# lightstripe_library(<folder's name> EXTERNAL <libraries of others> PRECOMPILE <headers>) makes lightstripe::<name> of every .cpp
# file below the current folder; it links what cmake/layers.txt lets it include.
function(lightstripe_library name)
  cmake_parse_arguments(ARG "" "" "EXTERNAL;PRECOMPILE" ${ARGN})
  set(deps ${layers_of_${name}})
  file(GLOB_RECURSE sources CONFIGURE_DEPENDS ${CMAKE_CURRENT_SOURCE_DIR}/*.cpp)
  add_library(lightstripe_${name} STATIC ${sources})
  add_library(lightstripe::${name} ALIAS lightstripe_${name})
  set_target_properties(lightstripe_${name} PROPERTIES POSITION_INDEPENDENT_CODE ON EXPORT_NAME ${name})
  target_include_directories(lightstripe_${name} PUBLIC $<BUILD_INTERFACE:${PROJECT_SOURCE_DIR}>
                                                        $<BUILD_INTERFACE:${PROJECT_SOURCE_DIR}/src>
                                                        $<INSTALL_INTERFACE:${LIGHTSTRIPE_INSTALL_HEADERS}>)
  target_compile_features(lightstripe_${name} PUBLIC cxx_std_20)
  set_property(GLOBAL PROPERTY LIGHTSTRIPE_DEPS_${name} "${deps}")
  list(TRANSFORM deps PREPEND lightstripe::)
  target_link_libraries(lightstripe_${name} PUBLIC ${deps} ${ARG_EXTERNAL} PRIVATE $<BUILD_INTERFACE:lightstripe_flags>)
  lightstripe_compile_faster(lightstripe_${name} ${ARG_PRECOMPILE})
  if(LIGHTSTRIPE_SANITIZE MATCHES "address|thread" AND name MATCHES "core|simulate")
    # Tests spend most of their time in rendering; at -O1 Eigen's temporaries are in memory, and each access is checked.
    target_compile_options(lightstripe_${name} PRIVATE -O2)
  endif()
  lightstripe_install_library(${name})
endfunction()

# lightstripe_compile_faster(<target> <headers>): as one unit, or with these headers precompiled, as the options say.
function(lightstripe_compile_faster target)
  if(LIGHTSTRIPE_UNITY)
    set_target_properties(${target} PROPERTIES UNITY_BUILD ON UNITY_BUILD_BATCH_SIZE 0)
  elseif(LIGHTSTRIPE_PRECOMPILE AND ARGN)
    target_precompile_headers(${target} PRIVATE ${ARGN})
  endif()
endfunction()

# lightstripe_tests(<folder> DEPS <libraries>): every <x>_test.cpp of tests/<folder> becomes one executable
# and one ctest of the name <folder>/<x>_test; all share the precompiled headers of tests_precompiled. Files <x>.scene_test.cpp, .data_test.cpp carry that label instead of unit.
function(lightstripe_tests folder)
  cmake_parse_arguments(ARG "" "" "DEPS" ${ARGN})
  file(GLOB tests CONFIGURE_DEPENDS ${CMAKE_CURRENT_SOURCE_DIR}/${folder}/*_test.cpp)
  foreach(source ${tests})
    get_filename_component(stem ${source} NAME)
    string(REGEX REPLACE "\\.cpp$" "" stem ${stem})
    string(REPLACE "." "_" target "${folder}_${stem}")
    add_executable(${target} ${source})
    set_target_properties(${target} PROPERTIES RUNTIME_OUTPUT_DIRECTORY ${CMAKE_BINARY_DIR}/tests)
    target_link_libraries(${target} PRIVATE ${ARG_DEPS} fmt::fmt GTest::gmock GTest::gtest_main lightstripe_flags)
    if(LIGHTSTRIPE_PRECOMPILE)
      target_precompile_headers(${target} REUSE_FROM tests_precompiled)
    endif()
    target_include_directories(${target} PRIVATE ${CMAKE_BINARY_DIR}/generated/tests)
    add_test(NAME ${folder}/${stem} COMMAND ${target} WORKING_DIRECTORY ${PROJECT_SOURCE_DIR})
    set(label unit)
    if(stem MATCHES "\\.([a-z]+)_test$")
      set(label ${CMAKE_MATCH_1})
    endif()
    set_tests_properties(${folder}/${stem} PROPERTIES LABELS ${label})
  endforeach()
endfunction()
