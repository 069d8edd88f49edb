# Language level, warnings and code generation that every target of the project shares.
add_library(burnish_options INTERFACE)
target_compile_features(burnish_options INTERFACE cxx_std_20)
target_include_directories(burnish_options INTERFACE
  "$<BUILD_INTERFACE:${PROJECT_SOURCE_DIR};${PROJECT_BINARY_DIR}/generated>" "$<INSTALL_INTERFACE:include/burnish>")
# Programs that link an installed engine have warnings of their own.
target_compile_options(burnish_options INTERFACE "$<BUILD_INTERFACE:-Wall;-Wextra;-Wpedantic;-Wshadow;-Wconversion>")
# GCC 12 sees these where nothing is wrong: in its own AVX-512 headers under Eigen's reductions, and in std::string.
if(CMAKE_CXX_COMPILER_ID STREQUAL "GNU" AND CMAKE_CXX_COMPILER_VERSION VERSION_LESS 13)
  target_compile_options(burnish_options INTERFACE
    "$<BUILD_INTERFACE:-Wno-uninitialized;-Wno-maybe-uninitialized;-Wno-restrict;-Wno-stringop-overflow;-Wno-stringop-overread>"
    $<BUILD_INTERFACE:-Wno-array-bounds>)
endif()
if(BURNISH_WERROR)
  target_compile_options(burnish_options INTERFACE $<BUILD_INTERFACE:-Werror>)
endif()
# Part of the ABI of Eigen's aligned types: the same flag for every target, never for one file alone.
if(BURNISH_NATIVE)
  target_compile_options(burnish_options INTERFACE -march=native)
endif()
# ISO mode would forbid fused multiply-adds, and the element kernels live on them.
target_compile_options(burnish_options INTERFACE -ffp-contract=fast -fno-math-errno)
set(CMAKE_CXX_EXTENSIONS OFF)

# For what computes nothing: the command and the tests. Full optimisation of them takes as long as that of the engine.
set(BURNISH_QUICK_BUILD $<$<CONFIG:Release>:-O1>)

# What nearly every file includes is read once for each library. Headers of the project are not among them: a change of one
# of them compiles again what includes it, and nothing else.
set(BURNISH_COMMON_HEADERS
  <Eigen/Dense> <algorithm> <array> <cmath> <cstddef> <filesystem> <fmt/format.h> <fmt/ranges.h> <functional> <limits> <map>
  <memory> <numbers> <optional> <set> <span> <string> <string_view> <system_error> <utility> <variant> <vector>)
