# cmake --install: the program, the documentation, and what find_package(burnish) finds in other projects. Components are the packages
# of cmake/BurnishPackage.cmake.
include(GNUInstallDirs)
include(CMakePackageConfigHelpers)

install(TARGETS burnish RUNTIME DESTINATION "${CMAKE_INSTALL_BINDIR}" COMPONENT program)
set(modules "${CMAKE_INSTALL_LIBDIR}/burnish")  # where the program looks for what it loads later
set(loaded burnish_readers burnish_svg burnish_shaper)
if(BURNISH_LATE_VTK)
  list(APPEND loaded burnish_late_vtk)
endif()
install(TARGETS ${loaded} LIBRARY DESTINATION "${modules}" COMPONENT program)
if(BURNISH_PETSC)
  install(TARGETS burnish_petsc LIBRARY DESTINATION "${modules}" COMPONENT multigrid)
endif()
if(BURNISH_HAS_OCCT)
  install(TARGETS burnish_occt LIBRARY DESTINATION "${modules}" COMPONENT cad)
endif()
if(NOT CMAKE_INSTALL_RPATH)
  file(RELATIVE_PATH libraries "${CMAKE_INSTALL_FULL_BINDIR}" "${CMAKE_INSTALL_FULL_LIBDIR}/burnish")
  set_target_properties(burnish PROPERTIES INSTALL_RPATH "$ORIGIN/${libraries}")
endif()
# The same, compiled for newer processors; the program starts it where it can (cli/fastest_program.h).
set(BURNISH_NEWER_BUILD "" CACHE PATH "Build directory (preset package-newer) of the program for processors with AVX2, to be installed, too")
if(BURNISH_NEWER_BUILD AND CMAKE_SYSTEM_PROCESSOR STREQUAL "x86_64")
  set(newer "${modules}/x86-64-v3")
  install(PROGRAMS "${BURNISH_NEWER_BUILD}/burnish" DESTINATION "${newer}" COMPONENT program)
  foreach(module IN LISTS loaded)
    install(FILES "${BURNISH_NEWER_BUILD}/$<TARGET_FILE_NAME:${module}>" DESTINATION "${newer}" COMPONENT program)
  endforeach()
  if(BURNISH_PETSC)
    install(FILES "${BURNISH_NEWER_BUILD}/burnish_petsc.so" DESTINATION "${newer}" COMPONENT multigrid)
  endif()
  if(BURNISH_HAS_OCCT)
    install(FILES "${BURNISH_NEWER_BUILD}/burnish_occt.so" DESTINATION "${newer}" COMPONENT cad)
  endif()
endif()
install(DIRECTORY "${PROJECT_BINARY_DIR}/share/man/" DESTINATION "${CMAKE_INSTALL_MANDIR}" COMPONENT program
  FILES_MATCHING PATTERN "*.[15]")
# Completions, where the shells of Debian look.
set(completions "${PROJECT_SOURCE_DIR}/cli/completion/shells")
install(FILES "${completions}/burnish.bash" DESTINATION "${CMAKE_INSTALL_DATADIR}/bash-completion/completions" RENAME burnish
  COMPONENT program)
install(FILES "${completions}/_burnish" DESTINATION "${CMAKE_INSTALL_DATADIR}/zsh/vendor-completions" COMPONENT program)
install(FILES "${completions}/burnish.fish" DESTINATION "${CMAKE_INSTALL_DATADIR}/fish/vendor_completions.d" COMPONENT program)
# For editors.
install(FILES "${PROJECT_SOURCE_DIR}/docs/scene.schema.json" "${PROJECT_SOURCE_DIR}/docs/study.schema.json"
  DESTINATION "${CMAKE_INSTALL_DATADIR}/burnish" COMPONENT program)
# Built in, but also what a theme of one's own starts from.
install(DIRECTORY "${PROJECT_SOURCE_DIR}/postproc/draw/page/themes/" DESTINATION "${CMAKE_INSTALL_DATADIR}/burnish/themes"
  COMPONENT program FILES_MATCHING PATTERN "*.yaml")
install(FILES "${PROJECT_SOURCE_DIR}/README.md" "${PROJECT_SOURCE_DIR}/LICENSE" DESTINATION "${CMAKE_INSTALL_DOCDIR}"
  COMPONENT program)

# The pages as they are, where README.md links to them, and as a site where scripts/site has built it.
install(DIRECTORY "${PROJECT_SOURCE_DIR}/docs" DESTINATION "${CMAKE_INSTALL_DOCDIR}" COMPONENT doc
  FILES_MATCHING PATTERN "*.md" PATTERN "*.ipynb" PATTERN site EXCLUDE PATTERN images EXCLUDE)
install(DIRECTORY "${PROJECT_SOURCE_DIR}/build/site/" DESTINATION "${CMAKE_INSTALL_DOCDIR}/html" COMPONENT doc OPTIONAL)
install(DIRECTORY "${PROJECT_SOURCE_DIR}/scenes/examples" DESTINATION "${CMAKE_INSTALL_DOCDIR}" COMPONENT doc
  FILES_MATCHING PATTERN "*.yaml" PATTERN "*.step")

# Before 1.0 the second number may break a promise (CHANGELOG.md).
write_basic_package_version_file("${PROJECT_BINARY_DIR}/burnishConfigVersion.cmake"
  COMPATIBILITY SameMinorVersion ARCH_INDEPENDENT)
install(FILES
  "${PROJECT_BINARY_DIR}/burnishConfigVersion.cmake"
  "${CMAKE_CURRENT_LIST_DIR}/burnishConfig.cmake"
  "${CMAKE_CURRENT_LIST_DIR}/BurnishImageTest.cmake"
  "${CMAKE_CURRENT_LIST_DIR}/BurnishRunImageTest.cmake"
  DESTINATION "${CMAKE_INSTALL_DATADIR}/cmake/burnish" COMPONENT program)
