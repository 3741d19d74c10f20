# cmake -DSOURCE=... -DFOLDER=... -DCTEST=... -P run.cmake
set(modules core theory inference scenario prepare atlas deck engine measure store evaluate campaign compare archive learn)
set(targets campaign_replay campaign_files_replay engine_output_replay notes_replay result_replay)
foreach(module IN LISTS modules)
    list(APPEND targets ${module}_tests)
endforeach()
list(JOIN modules "|" labels)
cmake_host_system_information(RESULT processors QUERY NUMBER_OF_LOGICAL_CORES)
execute_process(COMMAND_ERROR_IS_FATAL ANY
    COMMAND ${CMAKE_COMMAND} -S ${SOURCE} -B ${FOLDER} -G Ninja -DCMAKE_BUILD_TYPE=Debug -DCMAKE_CXX_FLAGS_DEBUG=-O1
            -DVIBROTROUGH_SANITIZE=ON -DVIBROTROUGH_VIEW=OFF -DBUILD_TESTING=ON)
execute_process(COMMAND_ERROR_IS_FATAL ANY COMMAND ${CMAKE_COMMAND} --build ${FOLDER} --target ${targets})
set(ENV{LSAN_OPTIONS} "suppressions=${CMAKE_CURRENT_LIST_DIR}/leaks.txt:print_suppressions=0")
# Some tests with the label of a module are those of the whole program, which is not built here. Tests that repeat one thing until they can
# count how often it holds would take an hour here, and run nothing that others do not.
set(others InTheDocs ReadByH5py Coverage "Covers?TheTruth" ToThreePercent CalibrationFindsTheFriction RanksAreUniform PosteriorsThatAreTooNarrow
    FrictionThatMadeTheSpeeds AnUnknownLayerWidens AWiderRangeIsNeverWorse WidthThatIsNamedIsEnough TheCampaignIsTheDesign)
list(JOIN others "|" others)
execute_process(COMMAND_ERROR_IS_FATAL ANY
    COMMAND ${CTEST} --test-dir ${FOLDER} --output-on-failure --parallel ${processors} -L "^(${labels}|fuzz)$" -E "${others}")
