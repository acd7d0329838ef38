# SPDX-License-Identifier: GPL-3.0-or-later
#[[
What `cmake --install` puts below a prefix, and the Debian package that cpack makes of it. The tree can be moved: demvof
finds its programs beside itself and its Python parts in ../share/demvof.

  bin                   demvof, demvof_pair, foam_side, dem_side
  share/demvof          Python parts of `demvof new`, `report` and `study`, JSON Schema of the case file
  share/demvof/cases    the cases (component "cases": left out by cmake --install build/release --component programs)
  share/doc/demvof      documentation, licence
]]
include(GNUInstallDirs)
set(_share ${CMAKE_INSTALL_DATADIR}/demvof)
set(_doc ${CMAKE_INSTALL_DATADIR}/doc/demvof)

foreach(_program demvof demvof_pair foam_side dem_side)
  if(TARGET ${_program})
    install(TARGETS ${_program} RUNTIME DESTINATION ${CMAKE_INSTALL_BINDIR} COMPONENT programs)
  endif()
endforeach()
install(FILES coupler/cli/new.py coupler/cli/report.py coupler/cli/study.py docs/case_file.schema.json DESTINATION ${_share}
        COMPONENT programs)
install(DIRECTORY coupler/cli/creating coupler/cli/reporting coupler/cli/studying DESTINATION ${_share} COMPONENT programs
        FILES_MATCHING PATTERN "*.py" PATTERN "*.js")
install(FILES README.md LICENSE DESTINATION ${_doc} COMPONENT programs)
install(DIRECTORY docs DESTINATION ${_doc} COMPONENT programs PATTERN "records" EXCLUDE)
install(DIRECTORY cases DESTINATION ${_share} COMPONENT cases USE_SOURCE_PERMISSIONS
        PATTERN "run*" EXCLUDE PATTERN "__pycache__" EXCLUDE)

set(CPACK_GENERATOR DEB)
set(CPACK_PACKAGE_NAME demvof)
set(CPACK_PACKAGE_CONTACT "the demvof authors <demvof@localhost>")
set(CPACK_PACKAGE_DESCRIPTION_SUMMARY "three-phase flows: OpenFOAM and LIGGGHTS coupled")
set(CPACK_PACKAGING_INSTALL_PREFIX /usr)
set(CPACK_STRIP_FILES ON)
set(CPACK_DEBIAN_FILE_NAME DEB-DEFAULT)
set(CPACK_DEBIAN_PACKAGE_SECTION science)
# The libraries by dpkg-shlibdeps, from what the programs were built with; by name what they start and read.
set(CPACK_DEBIAN_PACKAGE_SHLIBDEPS ON)
set(CPACK_DEBIAN_PACKAGE_DEPENDS "openmpi-bin, openfoam, liggghts, python3, python3-matplotlib, python3-yaml")
set(CPACK_DEBIAN_PACKAGE_RECOMMENDS "python3-vtk9, libjs-three")
include(CPack)
