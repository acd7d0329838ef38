# SPDX-License-Identifier: GPL-3.0-or-later
#[[
Writes a C++ file that defines every MPI function which takes a communicator, as a call of its PMPI
twin with MPI_COMM_WORLD replaced by the program's own communicator (demvof::own).

Taken from the declarations of the installed mpi.h, so that no function is forgotten and no
prototype is wrong, whatever the MPI. Functions that do more than that are in pmpi.cpp.
]]
function(demvof_generate_world_substitution mpi_include_folders output)
  set(folders ${mpi_include_folders})
  list(TRANSFORM folders PREPEND -I)
  file(WRITE ${output}.in.cpp "#include <mpi.h>\n")
  execute_process(
    COMMAND ${CMAKE_CXX_COMPILER} -E -P ${folders} ${output}.in.cpp
    OUTPUT_VARIABLE header COMMAND_ERROR_IS_FATAL ANY)
  string(REGEX REPLACE "[ \t\r\n]+" " " header "${header}")
  string(REPLACE "[" "<" header "${header}")  # CMake's lists trip over brackets
  string(REPLACE "]" ">" header "${header}")
  string(REGEX MATCHALL "int PMPI_[A-Za-z0-9_]+ ?\\([^();]*MPI_Comm [a-z][^();]*\\)" prototypes "${header}")

  set(text "// Generated from the installed mpi.h: see generate_world_substitution.cmake\n")
  string(APPEND text "#include <mpi.h>\n#include \"coupler/link/pmpi.hpp\"\n")
  string(APPEND text "#pragma GCC diagnostic ignored \"-Wdeprecated-declarations\"\n")
  string(APPEND text "using demvof::own;\nextern \"C\" {\n")
  foreach(prototype IN LISTS prototypes)
    string(REGEX MATCH "^int PMPI_([A-Za-z0-9_]+) ?\\((.*)\\)$" matched "${prototype}")
    set(name ${CMAKE_MATCH_1})
    set(parameters "${CMAKE_MATCH_2}")
    if(name STREQUAL "Abort")
      continue()
    endif()
    string(REPLACE "," ";" parameter_list "${parameters}")
    set(arguments)
    foreach(parameter IN LISTS parameter_list)
      string(REGEX MATCH "([A-Za-z_0-9]+)(<[0-9]*>)* *$" matched "${parameter}")
      set(argument ${CMAKE_MATCH_1})
      if(parameter MATCHES "MPI_Comm [a-z]")
        set(argument "own(${argument})")
      endif()
      list(APPEND arguments ${argument})
    endforeach()
    list(JOIN arguments ", " arguments)
    string(REPLACE "<" "[" parameters "${parameters}")
    string(REPLACE ">" "]" parameters "${parameters}")
    string(APPEND text "int MPI_${name}(${parameters}) { return PMPI_${name}(${arguments}); }\n")
  endforeach()
  string(APPEND text "}\n")
  file(CONFIGURE OUTPUT ${output} CONTENT "${text}" @ONLY)
endfunction()
