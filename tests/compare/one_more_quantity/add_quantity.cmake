# Writes a copy of a source of src/store with one quantity more than the program has: one row.
# usage: cmake -D SOURCE=src/store/layer_quantities.cpp -D TARGET=file -P add_quantity.cmake
file(READ ${SOURCE} text)
set(before "        {\"power_per_area\",")
set(row "        {\"test_mass\", \"kg\", \"A mass of this test\", motion<&Motion::added_mass>(), mean,
         {{.format = \"{:.4f}\", .position = 163, .terminal = TerminalView{.heading = \"test mass\", .subheading = \"kg\"},
           .report = ReportView{.heading = \"mass of the test\"}}}},
")
string(REPLACE "${before}" "${row}${before}" changed "${text}")
if(changed STREQUAL text)
    message(FATAL_ERROR "${SOURCE} does not contain '${before}'")
endif()
file(WRITE ${TARGET} "${changed}")
