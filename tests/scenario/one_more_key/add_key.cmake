# Writes copies of two sources of src/scenario with one key more than the program has: one member and one row.
# usage: cmake -D SOURCE=src/scenario -D TARGET=folder -P add_key.cmake

# add_line(FILE BEFORE LINE): a copy of the file with this line above the text BEFORE.
function(add_line file before line)
    file(READ ${SOURCE}/${file} text)
    string(REPLACE "${before}" "${line}\n${before}" changed "${text}")
    if(changed STREQUAL text)
        message(FATAL_ERROR "${file} does not contain '${before}'")
    endif()
    file(WRITE ${TARGET}/scenario/${file} "${changed}")
endfunction()

add_line(model/scenario.hpp "    double block_stiffness = 300" "    double test_length = 1;  ///< m")
add_line(reader/plan_keys.cpp "    Key{\"engine.contact\"" "    Key{\"solver.test_length\", quantity, \"m\", 0.001, 1, \"1 mm to 1 m\", \"\", 0.007, \"\\\"5 mm\\\"\", \"a length of this test\",
        field<&Scenario::solver, &SolverPlan::test_length>},")
