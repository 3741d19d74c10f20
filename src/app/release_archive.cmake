# Read by CPack for each generator. A .tar.gz is a release archive: it also holds the libraries (component "libraries").
if(CPACK_GENERATOR STREQUAL "TGZ" AND CPACK_INSTALL_CMAKE_PROJECTS)
    set(CPACK_COMPONENTS_ALL program python libraries)
    set(CPACK_COMPONENTS_GROUPING ALL_COMPONENTS_IN_ONE)
    set(CPACK_ARCHIVE_COMPONENT_INSTALL ON)
    set(CPACK_COMPONENT_INCLUDE_TOPLEVEL_DIRECTORY ON)
endif()

# Adds the libraries that programs need to their package, as Debian's dpkg-shlibdeps names them. (With
# CPACK_DEBIAN_PACKAGE_SHLIBDEPS CPack starts two programs for each file, hundreds of which are data.)
function(add_libraries component)
    set(folder ${CPACK_PACKAGE_DIRECTORY}/_CPack_Packages/libraries)
    file(WRITE ${folder}/debian/control "")
    execute_process(COMMAND dpkg-shlibdeps -O ${ARGN} WORKING_DIRECTORY ${folder} OUTPUT_VARIABLE found ERROR_VARIABLE why RESULT_VARIABLE failed
                    OUTPUT_STRIP_TRAILING_WHITESPACE)
    if(failed OR NOT found MATCHES "shlibs:Depends=(.+)")
        message(FATAL_ERROR "dpkg-shlibdeps does not name the libraries of ${ARGN}: ${why}")
    endif()
    set(CPACK_DEBIAN_${component}_PACKAGE_DEPENDS "${CPACK_DEBIAN_${component}_PACKAGE_DEPENDS}, ${CMAKE_MATCH_1}" PARENT_SCOPE)
endfunction()

if(CPACK_GENERATOR STREQUAL "DEB" AND CPACK_INSTALL_CMAKE_PROJECTS)
    list(GET CPACK_INSTALL_CMAKE_PROJECTS 0 build)
    # There may be no program with VTK, and no module.
    file(GLOB programs ${build}/src/app/vibrotrough ${build}/src/app/vibrotrough-with-vtk)
    add_libraries(PROGRAM ${programs})
    file(GLOB modules ${build}/postprocess/vibrotrough/_theory*.so)
    if(modules)
        add_libraries(PYTHON ${modules})
    endif()
endif()
