# SPDX-License-Identifier: GPL-3.0-or-later
#[[
demvof_add_mpi_test(NAME name RANKS n... LABELS label... TIMEOUT seconds COMMAND program args...
                    [PARTNER_RANKS m] [PARTNER_COMMAND program args...] [LONG])

One test per entry of RANKS, called name.n when there are several. PARTNER_COMMAND starts beside it in the same
mpirun, as `mpirun -np n+m demvof_pair -np n COMMAND + -np m PARTNER_COMMAND` (m is 1 when not given).
DEMVOF_TIMEOUT_FACTOR stretches the time limits of slow builds.
LONG tests run only with `ctest -C verification` (tests/Alltest --verification).
]]
include_guard(GLOBAL)

# Environment of every test that starts ranks: works as root and in a container, ranks may outnumber cores and are
# not pinned (two tests running at the same time would be pinned to the same core). Open MPI 4 and 5 have their own
# names for it.
set(_open_mpi)
foreach(_folder IN LISTS MPI_CXX_INCLUDE_DIRS)
  if(EXISTS ${_folder}/mpi.h AND NOT _open_mpi)
    file(STRINGS ${_folder}/mpi.h _open_mpi REGEX "define OMPI_MAJOR_VERSION")
    string(REGEX MATCH "[0-9]+" _open_mpi "${_open_mpi}")
  endif()
endforeach()
set(DEMVOF_MPI_ENVIRONMENT OMPI_ALLOW_RUN_AS_ROOT=1 OMPI_ALLOW_RUN_AS_ROOT_CONFIRM=1)
if(_open_mpi AND _open_mpi LESS 5)
  list(APPEND DEMVOF_MPI_ENVIRONMENT OMPI_MCA_rmaps_base_oversubscribe=1 OMPI_MCA_hwloc_base_binding_policy=none
       OMPI_MCA_btl_vader_single_copy_mechanism=none)
elseif(_open_mpi)
  list(APPEND DEMVOF_MPI_ENVIRONMENT PRTE_MCA_rmaps_default_mapping_policy=:oversubscribe
       PRTE_MCA_hwloc_default_binding_policy=none)
endif()
if(OpenFOAM_PROJECT_DIR)
  list(APPEND DEMVOF_MPI_ENVIRONMENT WM_PROJECT_DIR=${OpenFOAM_PROJECT_DIR})
endif()

set(DEMVOF_TIMEOUT_FACTOR 1 CACHE STRING "Factor on the time limits of tests, for slow builds")

# demvof_limit_time(seconds test...)
function(demvof_limit_time seconds)
  math(EXPR stretched "${seconds} * ${DEMVOF_TIMEOUT_FACTOR}")
  set_tests_properties(${ARGN} PROPERTIES TIMEOUT ${stretched})
endfunction()

function(demvof_add_mpi_test)
  cmake_parse_arguments(PARSE_ARGV 0 ARG "LONG" "NAME;TIMEOUT;PARTNER_RANKS"
                        "RANKS;LABELS;COMMAND;PARTNER_COMMAND")
  foreach(required NAME RANKS LABELS TIMEOUT COMMAND)
    if(NOT ARG_${required})
      message(FATAL_ERROR "demvof_add_mpi_test: ${required} is missing")
    endif()
  endforeach()
  if(ARG_UNPARSED_ARGUMENTS)
    message(FATAL_ERROR "demvof_add_mpi_test(${ARG_NAME}): unknown ${ARG_UNPARSED_ARGUMENTS}")
  endif()

  set(pair)
  set(partner)
  set(partner_ranks 0)
  if(ARG_PARTNER_COMMAND)
    set(partner_ranks 1)
    if(ARG_PARTNER_RANKS)
      set(partner_ranks ${ARG_PARTNER_RANKS})
    endif()
    demvof_program(program ${ARG_PARTNER_COMMAND})
    set(partner + -np ${partner_ranks} ${program})
  endif()
  set(configurations)
  if(ARG_LONG)
    set(configurations CONFIGURATIONS verification)
  endif()
  demvof_program(program ${ARG_COMMAND})
  # mpirun gives up before ctest does: ctest would kill mpirun alone and leave its ranks running.
  math(EXPR timeout "${ARG_TIMEOUT} * ${DEMVOF_TIMEOUT_FACTOR}")
  math(EXPR ctest_timeout "${timeout} + 15")

  list(LENGTH ARG_RANKS variants)
  foreach(ranks IN LISTS ARG_RANKS)
    set(name ${ARG_NAME})
    if(variants GREATER 1)
      string(APPEND name .${ranks})
    endif()
    math(EXPR processors "${ranks} + ${partner_ranks}")
    if(partner)
      set(pair $<TARGET_FILE:demvof_pair> -np ${ranks})
    endif()
    add_test(NAME ${name}
             COMMAND ${MPIEXEC_EXECUTABLE} --timeout ${timeout} ${MPIEXEC_NUMPROC_FLAG} ${processors} ${pair} ${program}
                     ${partner} ${configurations})
    set_tests_properties(${name} PROPERTIES LABELS "${ARG_LABELS}" TIMEOUT ${ctest_timeout} PROCESSORS ${processors}
                                            ENVIRONMENT "${DEMVOF_MPI_ENVIRONMENT}")
  endforeach()
endfunction()

# mpirun has to be handed files: a target's name becomes its program's path (add_test does that for the first
# word only).
function(demvof_program result program)
  if(TARGET ${program})
    set(program $<TARGET_FILE:${program}>)
  endif()
  set(${result} ${program} ${ARGN} PARENT_SCOPE)
endfunction()
