# burnish_sources(TARGET [EXCEPT file...]): all sources of this folder and of the folders in it. Who adds one names it nowhere.
function(burnish_sources target)
  cmake_parse_arguments(arg "" "" "EXCEPT" ${ARGN})
  file(GLOB_RECURSE sources CONFIGURE_DEPENDS *.cpp)
  foreach(source IN LISTS arg_EXCEPT)
    list(REMOVE_ITEM sources "${CMAKE_CURRENT_SOURCE_DIR}/${source}")
  endforeach()
  target_sources(${target} PRIVATE ${sources})
endfunction()
