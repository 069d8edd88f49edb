# SuiteSparse has no CMake package on Debian 12; its BLAS is whatever libblas.so.3 points to, so that choice is
# checked here: reference BLAS makes the factorisations several times slower.
find_path(SUITESPARSE_INCLUDE_DIR umfpack.h PATH_SUFFIXES suitesparse REQUIRED)
find_library(UMFPACK_LIBRARY umfpack REQUIRED)
find_library(CHOLMOD_LIBRARY cholmod REQUIRED)
find_package(OpenBLAS REQUIRED)

add_library(burnish_suitesparse INTERFACE)
target_include_directories(burnish_suitesparse SYSTEM INTERFACE "${SUITESPARSE_INCLUDE_DIR}" ${OpenBLAS_INCLUDE_DIRS})
target_link_libraries(burnish_suitesparse INTERFACE "${UMFPACK_LIBRARY}" "${CHOLMOD_LIBRARY}" ${OpenBLAS_LIBRARIES})
