# cmake --install: the engine for programs of others, which find_package(burnish COMPONENTS engine) finds, and the package of Python.
# Components: development, python.
include(GNUInstallDirs)

set_target_properties(burnish_engine PROPERTIES EXPORT_NAME engine)
set_target_properties(burnish_options PROPERTIES EXPORT_NAME options)
set_target_properties(burnish_suitesparse PROPERTIES EXPORT_NAME suitesparse)
install(TARGETS burnish_engine burnish_options burnish_suitesparse EXPORT burnishEngineTargets
  ARCHIVE DESTINATION "${CMAKE_INSTALL_LIBDIR}" COMPONENT development)
install(EXPORT burnishEngineTargets NAMESPACE burnish:: DESTINATION "${CMAKE_INSTALL_DATADIR}/cmake/burnish" COMPONENT development)
install(FILES "${CMAKE_CURRENT_LIST_DIR}/burnishEngine.cmake" DESTINATION "${CMAKE_INSTALL_DATADIR}/cmake/burnish"
  COMPONENT development)
install(DIRECTORY "${PROJECT_SOURCE_DIR}/engine" DESTINATION "${CMAKE_INSTALL_INCLUDEDIR}/burnish" COMPONENT development
  FILES_MATCHING PATTERN "*.h" PATTERN petsc EXCLUDE)

# Where Python of Debian looks below /usr and /usr/local.
set(BURNISH_PYTHON_DIR "lib/python3/dist-packages" CACHE STRING "Directory of Python's packages, below the prefix")
install(DIRECTORY "${PROJECT_SOURCE_DIR}/python/burnish" DESTINATION "${BURNISH_PYTHON_DIR}" COMPONENT python
  FILES_MATCHING PATTERN "*.py" PATTERN py.typed PATTERN __pycache__ EXCLUDE)
configure_file("${PROJECT_SOURCE_DIR}/python/metadata.in" "${PROJECT_BINARY_DIR}/python/METADATA" @ONLY)
install(FILES "${PROJECT_BINARY_DIR}/python/METADATA" "${PROJECT_SOURCE_DIR}/python/entry_points.txt"
  DESTINATION "${BURNISH_PYTHON_DIR}/burnish-${PROJECT_VERSION}.dist-info" COMPONENT python)
if(TARGET burnish_python)
  install(TARGETS burnish_python LIBRARY DESTINATION "${BURNISH_PYTHON_DIR}/burnish" COMPONENT python)
  # Multigrid is a library of its own, which the module loads when a scene asks for it.
  file(RELATIVE_PATH libraries "${CMAKE_INSTALL_PREFIX}/${BURNISH_PYTHON_DIR}/burnish" "${CMAKE_INSTALL_FULL_LIBDIR}/burnish")
  set_target_properties(burnish_python PROPERTIES INSTALL_RPATH "$ORIGIN/${libraries}")
endif()
