option(BURNISH_TOGETHER "Compile the files of a folder together where nothing is computed: builds take half the time" ON)

# burnish_sources(TARGET [TOGETHER] [EXCEPT file...]): all sources of this folder and of the folders in it. Who adds one names it
# nowhere. TOGETHER: those of one folder are one translation unit.
function(burnish_sources target)
  cmake_parse_arguments(arg "TOGETHER" "" "EXCEPT" ${ARGN})
  file(GLOB_RECURSE sources CONFIGURE_DEPENDS *.cpp)
  foreach(source IN LISTS arg_EXCEPT)
    list(REMOVE_ITEM sources "${CMAKE_CURRENT_SOURCE_DIR}/${source}")
  endforeach()
  target_sources(${target} PRIVATE ${sources})
  if(arg_TOGETHER)
    set_target_properties(${target} PROPERTIES UNITY_BUILD ${BURNISH_TOGETHER} UNITY_BUILD_MODE GROUP)
    foreach(source IN LISTS sources)
      cmake_path(GET source PARENT_PATH folder)
      set_source_files_properties(${source} PROPERTIES UNITY_GROUP "${folder}")
    endforeach()
  endif()
endfunction()
