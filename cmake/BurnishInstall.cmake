# cmake --install: the program, the documentation, and what find_package(burnish) finds in other projects.
include(GNUInstallDirs)
include(CMakePackageConfigHelpers)

install(TARGETS burnish RUNTIME DESTINATION "${CMAKE_INSTALL_BINDIR}")
set(modules "")
if(BURNISH_PETSC)
  list(APPEND modules burnish_petsc)
endif()
if(BURNISH_HAS_OCCT)
  list(APPEND modules burnish_occt)
endif()
if(modules)
  install(TARGETS ${modules} LIBRARY DESTINATION "${CMAKE_INSTALL_LIBDIR}/burnish")
  file(RELATIVE_PATH libraries "${CMAKE_INSTALL_FULL_BINDIR}" "${CMAKE_INSTALL_FULL_LIBDIR}/burnish")
  set_target_properties(burnish PROPERTIES INSTALL_RPATH "$ORIGIN/${libraries}")
endif()
install(DIRECTORY "${PROJECT_SOURCE_DIR}/docs/" DESTINATION "${CMAKE_INSTALL_DOCDIR}" FILES_MATCHING PATTERN "*.md")
install(DIRECTORY "${PROJECT_BINARY_DIR}/share/man/" DESTINATION "${CMAKE_INSTALL_MANDIR}" FILES_MATCHING PATTERN "*.[15]")
# Completions, where the shells of Debian look.
set(completions "${PROJECT_SOURCE_DIR}/cli/completion/shells")
install(FILES "${completions}/burnish.bash" DESTINATION "${CMAKE_INSTALL_DATADIR}/bash-completion/completions" RENAME burnish)
install(FILES "${completions}/_burnish" DESTINATION "${CMAKE_INSTALL_DATADIR}/zsh/vendor-completions")
install(FILES "${completions}/burnish.fish" DESTINATION "${CMAKE_INSTALL_DATADIR}/fish/vendor_completions.d")
# For editors.
install(FILES "${PROJECT_SOURCE_DIR}/docs/scene.schema.json" "${PROJECT_SOURCE_DIR}/docs/study.schema.json"
  DESTINATION "${CMAKE_INSTALL_DATADIR}/burnish")
# Built in, but also what a theme of one's own starts from.
install(DIRECTORY "${PROJECT_SOURCE_DIR}/postproc/draw/page/themes/" DESTINATION "${CMAKE_INSTALL_DATADIR}/burnish/themes"
  FILES_MATCHING PATTERN "*.yaml")
install(FILES "${PROJECT_SOURCE_DIR}/README.md" "${PROJECT_SOURCE_DIR}/LICENSE" DESTINATION "${CMAKE_INSTALL_DOCDIR}")

write_basic_package_version_file("${PROJECT_BINARY_DIR}/burnishConfigVersion.cmake"
  COMPATIBILITY SameMajorVersion ARCH_INDEPENDENT)
install(FILES
  "${PROJECT_BINARY_DIR}/burnishConfigVersion.cmake"
  "${CMAKE_CURRENT_LIST_DIR}/burnishConfig.cmake"
  "${CMAKE_CURRENT_LIST_DIR}/BurnishImageTest.cmake"
  "${CMAKE_CURRENT_LIST_DIR}/BurnishRunImageTest.cmake"
  DESTINATION "${CMAKE_INSTALL_DATADIR}/cmake/burnish")
