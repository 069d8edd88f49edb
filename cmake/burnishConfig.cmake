# find_package(burnish): the command as BURNISH_PROGRAM, and burnish_add_image_test.
include("${CMAKE_CURRENT_LIST_DIR}/BurnishImageTest.cmake")
if(NOT BURNISH_PROGRAM)
  set(burnish_FOUND FALSE)
  set(burnish_NOT_FOUND_MESSAGE "the command burnish was not found; set BURNISH_PROGRAM")
endif()
