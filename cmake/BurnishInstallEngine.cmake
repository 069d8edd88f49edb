# cmake --install: the engine for programs of others, which find_package(burnish COMPONENTS engine) finds. Component: development.
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
  FILES_MATCHING PATTERN "*.h" PATTERN petsc EXCLUDE PATTERN occt EXCLUDE)
