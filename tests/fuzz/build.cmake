# cmake -DSOURCE=... -DFOLDER=... -P build.cmake: the fuzz targets, with clang, in a folder of their own.
execute_process(
    COMMAND ${CMAKE_COMMAND} -S ${SOURCE} -B ${FOLDER} -G Ninja -DCMAKE_BUILD_TYPE=Debug -DCMAKE_C_COMPILER=clang
            -DCMAKE_CXX_COMPILER=clang++ -DVIBROTROUGH_FUZZ=ON
    COMMAND_ERROR_IS_FATAL ANY)
execute_process(
    COMMAND ${CMAKE_COMMAND} --build ${FOLDER} --target campaign_fuzz campaign_files_fuzz engine_output_fuzz notes_fuzz result_fuzz
    COMMAND_ERROR_IS_FATAL ANY)
