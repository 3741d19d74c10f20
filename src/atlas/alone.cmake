# The atlas for a layer that is given as numbers (value.hpp), with what it needs of other modules, as sources: for what is
# compiled apart from the program, which are the page for browsers and the module for Python.
set(atlas_root ${CMAKE_CURRENT_LIST_DIR}/../..)
cmake_path(NORMAL_PATH atlas_root)

# atlas_alone_sources(LIST FOLDER): the sources, one of which is written into FOLDER.
function(atlas_alone_sources list folder)
    set(tables ${atlas_root}/validation/atlas)
    set(script ${atlas_root}/src/atlas/embed_tables.cmake)
    add_custom_command(OUTPUT ${folder}/atlas_tables.cpp
        COMMAND ${CMAKE_COMMAND} -DFOLDER=${tables} -DOUTPUT=${folder}/atlas_tables.cpp -P ${script}
        DEPENDS ${tables}/layers.csv ${tables}/draws.csv ${tables}/draws_law.csv ${tables}/draws_added_mass.csv ${tables}/draws_damping.csv ${script} VERBATIM)
    set(sources ${folder}/atlas_tables.cpp)
    foreach(source core/csv core/text inference/gaussian_process atlas/surface atlas/tables atlas/value)
        list(APPEND sources ${atlas_root}/src/${source}.cpp)
    endforeach()
    set(${list} ${sources} PARENT_SCOPE)
endfunction()
