# "cpack" makes a package of Debian and a relocatable archive, of the programs, their texts, the
# Python package, the documentation and the examples. Links between pages hold where they are installed.
install(DIRECTORY docs meshes verification DESTINATION ${CMAKE_INSTALL_DOCDIR}
        FILES_MATCHING REGEX "/(docs|meshes|benchmarks)/.*[.][a-z]+$" REGEX "[.](md|svg)$"
        REGEX "/verification/problems" EXCLUDE)
install(FILES README.md LICENSE DESTINATION ${CMAKE_INSTALL_DOCDIR})
install(FILES LICENSE DESTINATION ${CMAKE_INSTALL_DOCDIR} RENAME copyright)

set(CPACK_GENERATOR DEB TGZ)
set(CPACK_PACKAGE_CONTACT "the authors of Perilink <perilink@localhost>")
set(CPACK_STRIP_FILES ON)
foreach(component Unspecified python)  # not the library for other projects
  list(APPEND CPACK_INSTALL_CMAKE_PROJECTS ${PROJECT_BINARY_DIR} perilink ${component} /)
endforeach()
set(CPACK_DEBIAN_FILE_NAME DEB-DEFAULT)
set(CPACK_DEBIAN_PACKAGE_SHLIBDEPS ON)
set(CPACK_DEBIAN_PACKAGE_SECTION science)
# Any BLAS will do, but OpenBLAS is faster.
set(CPACK_DEBIAN_PACKAGE_RECOMMENDS "libgmsh4.8, libopenblas0, python3-numpy")
# Python compiles the package when it is first imported; dpkg removes only what it has installed.
file(WRITE ${PROJECT_BINARY_DIR}/prerm
     "#!/bin/sh\nset -e\nrm -rf /usr/lib/python3/dist-packages/perilink/__pycache__\n")
set(CPACK_DEBIAN_PACKAGE_CONTROL_EXTRA ${PROJECT_BINARY_DIR}/prerm)
set(CPACK_DEBIAN_PACKAGE_CONTROL_STRICT_PERMISSION ON)
include(CPack)
