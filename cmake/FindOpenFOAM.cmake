# SPDX-License-Identifier: GPL-3.0-or-later
#[[
Finds OpenFOAM (openfoam.com, v1912 to v2412). Headers and libraries are looked for apart, because a distribution's packages hold the
libraries without the headers.

Looked at, in this order
  headers    ${OpenFOAM_SOURCE_DIR}, $WM_PROJECT_DIR (a sourced environment), <project>/build/openfoam (Allwmake)
  libraries  $FOAM_LIBBIN and $FOAM_LIBBIN/$FOAM_MPI (a sourced environment), then the system's folders
  etc files  $WM_PROJECT_DIR, then the system's share folder

Gives
  OpenFOAM::OpenFOAM      everything an incompressible two-phase solver needs
  OpenFOAM_PROJECT_DIR    what WM_PROJECT_DIR has to be while a program runs (holds etc/)
  OpenFOAM_VERSION        API number of the headers
]]
set(_headers
    OpenFOAM OSspecific/POSIX finiteVolume meshTools dynamicMesh dynamicFvMesh fvOptions sampling surfMesh
    parallel/decompose/decompositionMethods
    fileFormats transportModels transportModels/incompressible transportModels/twoPhaseMixture
    transportModels/twoPhaseProperties transportModels/interfaceProperties
    transportModels/immiscibleIncompressibleTwoPhaseMixture TurbulenceModels/turbulenceModels
    TurbulenceModels/incompressible)
set(_libraries
    OpenFOAM finiteVolume meshTools dynamicMesh dynamicFvMesh fvOptions sampling surfMesh fileFormats
    incompressibleTransportModels twoPhaseMixture twoPhaseProperties interfaceProperties
    immiscibleIncompressibleTwoPhaseMixture turbulenceModels incompressibleTurbulenceModels waveModels decompositionMethods)

# Integers and floating-point numbers are those of the sourced environment; Debian's packages are built with these.
set(_label_size 32)
set(_precision DP)
# A sourced environment comes as a whole: its headers are never mixed with another installation's libraries.
set(_header_search ${PROJECT_SOURCE_DIR}/build/openfoam)
set(_library_search)
if(EXISTS "$ENV{FOAM_LIBBIN}/libOpenFOAM.so")
  set(_header_search "$ENV{WM_PROJECT_DIR}")
  if(NOT "$ENV{WM_LABEL_SIZE}" STREQUAL "")
    set(_label_size $ENV{WM_LABEL_SIZE})
  endif()
  if(NOT "$ENV{WM_PRECISION_OPTION}" STREQUAL "")
    set(_precision $ENV{WM_PRECISION_OPTION})
  endif()
  set(_library_search PATHS "$ENV{FOAM_LIBBIN}" "$ENV{FOAM_LIBBIN}/$ENV{FOAM_MPI}" NO_DEFAULT_PATH)
endif()

find_path(OpenFOAM_SOURCE_DIR src/OpenFOAM/lnInclude/foamVersion.H
          PATHS ${_header_search} NO_DEFAULT_PATH
          DOC "OpenFOAM source tree whose src/ has been through wmakeLnIncludeAll")
find_path(OpenFOAM_PROJECT_DIR etc/controlDict
          PATHS "$ENV{WM_PROJECT_DIR}" /usr/share/openfoam NO_DEFAULT_PATH
          DOC "WM_PROJECT_DIR of running programs")

# The API number of the headers; the library list depends on it.
set(OpenFOAM_VERSION)
if(OpenFOAM_SOURCE_DIR)
  file(STRINGS ${OpenFOAM_SOURCE_DIR}/wmake/rules/General/general _line REGEX "OPENFOAM=[0-9]+")
  string(REGEX MATCH "[0-9]+" OpenFOAM_VERSION "${_line}")
endif()
if(OpenFOAM_VERSION AND NOT OpenFOAM_VERSION LESS 2006)  # isoAdvection became a library of its own
  list(APPEND _headers transportModels/geometricVoF)
  list(APPEND _libraries geometricVoF)
endif()

set(_library_files)
set(_missing_libraries)
foreach(_name IN LISTS _libraries ITEMS Pstream)
  find_library(OpenFOAM_${_name}_LIBRARY ${_name} ${_library_search})
  mark_as_advanced(OpenFOAM_${_name}_LIBRARY)
  if(OpenFOAM_${_name}_LIBRARY)
    list(APPEND _library_files ${OpenFOAM_${_name}_LIBRARY})
  else()
    list(APPEND _missing_libraries lib${_name}.so)
  endif()
endforeach()

# What is there has to be of one version on both sides, in double precision, and its Pstream the one that speaks MPI.
set(_trouble)
if(NOT OpenFOAM_SOURCE_DIR)
  string(APPEND _trouble "\n  no headers: run ./Allwmake, which obtains them, or source an OpenFOAM environment")
endif()
if(NOT _precision STREQUAL "DP")
  string(APPEND _trouble "\n  WM_PRECISION_OPTION is ${_precision}: demvof's bounds need double precision, DP")
endif()
if(_missing_libraries)
  list(JOIN _missing_libraries ", " _text)
  string(APPEND _trouble "\n  no libraries ${_text}: run ./Allwmake, which installs them")
elseif(OpenFOAM_PROJECT_DIR)
  file(STRINGS ${OpenFOAM_PROJECT_DIR}/etc/controlDict _line REGEX "Version:" LIMIT_COUNT 1)
  string(REGEX MATCH "[0-9]+" _etc_version "${_line}")
  if(NOT _etc_version STREQUAL OpenFOAM_VERSION)
    string(APPEND _trouble "\n  headers are v${OpenFOAM_VERSION}, the installation ${OpenFOAM_PROJECT_DIR} is v${_etc_version}")
  endif()
  file(STRINGS ${OpenFOAM_Pstream_LIBRARY} _line REGEX "MPI_Allreduce" LIMIT_COUNT 1)
  if(NOT _line)
    string(APPEND _trouble "\n  ${OpenFOAM_Pstream_LIBRARY} is the dummy without MPI")
  endif()
endif()

include(FindPackageHandleStandardArgs)
find_package_handle_standard_args(
  OpenFOAM
  REQUIRED_VARS OpenFOAM_SOURCE_DIR OpenFOAM_OpenFOAM_LIBRARY OpenFOAM_PROJECT_DIR
  VERSION_VAR OpenFOAM_VERSION
  HANDLE_VERSION_RANGE
  REASON_FAILURE_MESSAGE "${_trouble}")
if(_trouble AND OpenFOAM_FIND_REQUIRED)
  message(FATAL_ERROR "OpenFOAM cannot be used:${_trouble}")
endif()

if(OpenFOAM_FOUND AND NOT TARGET OpenFOAM::OpenFOAM)
  get_filename_component(_library_dir ${OpenFOAM_OpenFOAM_LIBRARY} DIRECTORY)
  message(STATUS "OpenFOAM v${OpenFOAM_VERSION}: headers ${OpenFOAM_SOURCE_DIR}/src, libraries ${_library_dir}, "
                 "WM_PROJECT_DIR ${OpenFOAM_PROJECT_DIR}")
  list(TRANSFORM _headers PREPEND ${OpenFOAM_SOURCE_DIR}/src/)
  list(TRANSFORM _headers APPEND /lnInclude)
  list(FILTER _headers EXCLUDE REGEX "/transportModels/lnInclude$")
  add_library(OpenFOAM::OpenFOAM INTERFACE IMPORTED)
  target_include_directories(OpenFOAM::OpenFOAM SYSTEM INTERFACE ${_headers} ${OpenFOAM_SOURCE_DIR}/src/transportModels)
  target_compile_definitions(OpenFOAM::OpenFOAM INTERFACE OPENFOAM=${OpenFOAM_VERSION} WM_${_precision}
                                                          WM_LABEL_SIZE=${_label_size}
                                                          NoRepository)
  target_compile_options(OpenFOAM::OpenFOAM INTERFACE -ftemplate-depth-100)
  # Models register themselves when their library is loaded: keep libraries that no symbol asks for.
  target_link_options(OpenFOAM::OpenFOAM INTERFACE LINKER:--no-as-needed)
  target_link_libraries(OpenFOAM::OpenFOAM INTERFACE ${_library_files})
endif()
