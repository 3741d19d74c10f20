# Holds a page of reference to what the program prints.
# usage: cmake -D PROGRAM=vibrotrough -D COMMAND=quantities -D PAGE=src/store/quantities.md -P check_page.cmake
separate_arguments(words UNIX_COMMAND "${COMMAND}")
execute_process(COMMAND ${PROGRAM} ${words} OUTPUT_VARIABLE printed COMMAND_ERROR_IS_FATAL ANY)
file(READ ${PAGE} page)
if(NOT page STREQUAL printed)
    message(FATAL_ERROR "${PAGE} differs from what the program prints; write it again: vibrotrough ${COMMAND} > ${PAGE}")
endif()
