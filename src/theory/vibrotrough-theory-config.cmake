include(CMakeFindDependencyMacro)
find_dependency(TBB)
find_dependency(Boost 1.74)
include(${CMAKE_CURRENT_LIST_DIR}/vibrotrough-theory-targets.cmake)
