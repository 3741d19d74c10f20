# Holds the page of all quantities to what the program prints.
# usage: cmake -D PROGRAM=vibrotrough -D PAGE=src/store/quantities.md -P check_page.cmake
execute_process(COMMAND ${PROGRAM} quantities OUTPUT_VARIABLE printed COMMAND_ERROR_IS_FATAL ANY)
file(READ ${PAGE} page)
if(NOT page STREQUAL printed)
    message(FATAL_ERROR "${PAGE} differs from what the program prints; write it again: vibrotrough quantities > src/store/quantities.md")
endif()
