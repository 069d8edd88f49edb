# Guards a scene with a picture: `burnish_add_image_test` computes it, draws it and compares it with a baseline.
include_guard(GLOBAL)

find_program(BURNISH_PROGRAM burnish HINTS "${CMAKE_CURRENT_LIST_DIR}/../../../bin"
  DOC "The command burnish, for burnish_add_image_test")

# burnish_add_image_test(NAME
#   SCENE scene.yaml            # relative to the source directory
#   BASELINE picture.png        # the same; need not exist yet
#   [THRESHOLD 0.15]            # see `burnish compare --help`
#   [METRIC ssim|delta-e]
#   [SET path=value ...]        # changes of the scene
#   [RENDER --field von_mises ...]  # options of `burnish render`
#   [TIMEOUT seconds])
#
# Adds a test of this name with the label "image". The picture and a report are left below the build directory, in
# image-tests/NAME.
function(burnish_add_image_test name)
  cmake_parse_arguments(arg "" "SCENE;BASELINE;THRESHOLD;METRIC;TIMEOUT" "SET;RENDER" ${ARGN})
  foreach(key SCENE BASELINE)
    if(NOT arg_${key})
      message(FATAL_ERROR "burnish_add_image_test(${name}): ${key} is missing")
    endif()
    cmake_path(ABSOLUTE_PATH arg_${key} BASE_DIRECTORY "${CMAKE_CURRENT_SOURCE_DIR}" NORMALIZE)
  endforeach()
  if(arg_UNPARSED_ARGUMENTS)
    message(FATAL_ERROR "burnish_add_image_test(${name}): found ${arg_UNPARSED_ARGUMENTS}; expected SCENE, BASELINE, "
                        "THRESHOLD, METRIC, SET, RENDER or TIMEOUT")
  endif()
  if(NOT EXISTS "${arg_SCENE}")
    message(FATAL_ERROR "burnish_add_image_test(${name}): there is no scene ${arg_SCENE}")
  endif()
  if(NOT BURNISH_PROGRAM)
    message(FATAL_ERROR "burnish_add_image_test(${name}): the command burnish was not found; set BURNISH_PROGRAM")
  endif()

  set(rule "")
  if(DEFINED arg_THRESHOLD)
    list(APPEND rule --threshold "${arg_THRESHOLD}")
  endif()
  if(DEFINED arg_METRIC)
    list(APPEND rule --metric "${arg_METRIC}")
  endif()
  add_test(NAME "${name}" COMMAND "${CMAKE_COMMAND}"
    "-DPROGRAM=${BURNISH_PROGRAM}"
    "-DSCENE=${arg_SCENE}"
    "-DBASELINE=${arg_BASELINE}"
    "-DSET=${arg_SET}"
    "-DRENDER=${arg_RENDER}"
    "-DRULE=${rule}"
    "-DDIRECTORY=${CMAKE_CURRENT_BINARY_DIR}/image-tests/${name}"
    -P "${CMAKE_CURRENT_FUNCTION_LIST_DIR}/BurnishRunImageTest.cmake")
  set_tests_properties("${name}" PROPERTIES LABELS image)
  if(DEFINED arg_TIMEOUT)
    set_tests_properties("${name}" PROPERTIES TIMEOUT "${arg_TIMEOUT}")
  endif()
endfunction()
