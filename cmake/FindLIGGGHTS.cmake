# SPDX-License-Identifier: GPL-3.0-or-later
#[[
Finds the LIGGGHTS library: target LIGGGHTS::LIGGGHTS, variable LIGGGHTS_VERSION.
LIGGGHTS_ROOT (CMake variable or environment) names an installation elsewhere.
]]
find_path(LIGGGHTS_INCLUDE_DIR lammps.h PATH_SUFFIXES liggghts)
find_library(LIGGGHTS_LIBRARY liggghts)
mark_as_advanced(LIGGGHTS_INCLUDE_DIR LIGGGHTS_LIBRARY)

set(LIGGGHTS_VERSION)
if(LIGGGHTS_LIBRARY)
  # The library's soname file carries the version (libliggghts.so.3.8.0); its headers do not.
  get_filename_component(_file ${LIGGGHTS_LIBRARY} REALPATH)
  string(REGEX MATCH "[0-9]+\\.[0-9]+\\.[0-9]+$" LIGGGHTS_VERSION "${_file}")
endif()

include(FindPackageHandleStandardArgs)
find_package_handle_standard_args(
  LIGGGHTS
  REQUIRED_VARS LIGGGHTS_LIBRARY LIGGGHTS_INCLUDE_DIR
  VERSION_VAR LIGGGHTS_VERSION
  REASON_FAILURE_MESSAGE "\n  run ./Allwmake, which installs it, or set LIGGGHTS_ROOT")

if(LIGGGHTS_FOUND AND NOT TARGET LIGGGHTS::LIGGGHTS)
  message(STATUS "LIGGGHTS ${LIGGGHTS_VERSION}: headers ${LIGGGHTS_INCLUDE_DIR}, library ${LIGGGHTS_LIBRARY}")
  add_library(LIGGGHTS::LIGGGHTS INTERFACE IMPORTED)
  target_include_directories(LIGGGHTS::LIGGGHTS SYSTEM INTERFACE ${LIGGGHTS_INCLUDE_DIR})
  target_link_libraries(LIGGGHTS::LIGGGHTS INTERFACE ${LIGGGHTS_LIBRARY} MPI::MPI_CXX)
endif()
