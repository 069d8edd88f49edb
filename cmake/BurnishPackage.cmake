# cpack -G DEB: a Debian package for each component of cmake/BurnishInstall.cmake; scripts/package builds and checks them.
# Who builds packages for others answers for them, and says so as for every package of Debian; else they are of the authors, who have no
# address of their own.
file(STRINGS "${PROJECT_SOURCE_DIR}/CITATION.cff" authors REGEX "^  - name: ")
list(GET authors 0 author)
string(REPLACE "  - name: " "" author "${author}")
set(maintainer "${author} <burnish@example.org>")
if(DEFINED ENV{DEBFULLNAME} AND DEFINED ENV{DEBEMAIL})
  set(maintainer "$ENV{DEBFULLNAME} <$ENV{DEBEMAIL}>")
endif()
set(BURNISH_MAINTAINER "${maintainer}" CACHE STRING "Who answers for the packages: NAME <ADDRESS>")

set(CPACK_GENERATOR DEB)
set(CPACK_PACKAGE_NAME burnish)
set(CPACK_PACKAGE_CONTACT "${BURNISH_MAINTAINER}")
set(CPACK_PACKAGE_DIRECTORY "${PROJECT_BINARY_DIR}")
set(CPACK_PACKAGING_INSTALL_PREFIX /usr)
set(CPACK_STRIP_FILES ON)
set(CPACK_COMPONENTS_GROUPING ONE_PER_GROUP)
set(CPACK_DEB_COMPONENT_INSTALL ON)
set(CPACK_DEBIAN_FILE_NAME DEB-DEFAULT)
set(CPACK_DEBIAN_PACKAGE_RELEASE 1)
set(CPACK_DEBIAN_PACKAGE_SHLIBDEPS ON)
set(CPACK_DEBIAN_PACKAGE_CONTROL_STRICT_PERMISSION ON)
set(CPACK_DEBIAN_COMPRESSION_TYPE xz)

# burnish_package(COMPONENT PACKAGE SECTION "Synopsis" "What it is." [field value]...): fields of its control file as CPack calls them.
function(burnish_package component package section synopsis text)
  string(TOUPPER "${component}" key)
  set(values PACKAGE_NAME "${package}" PACKAGE_SECTION "${section}" DESCRIPTION "${synopsis}\n${text}" ${ARGN})
  set(prefixed "")
  while(values)
    list(POP_FRONT values field value)
    set(name CPACK_DEBIAN_${key}_${field})
    if(field STREQUAL DESCRIPTION)
      set(name CPACK_COMPONENT_${key}_DESCRIPTION)
    endif()
    set(${name} "${value}" PARENT_SCOPE)
  endwhile()
endfunction()

burnish_package(program burnish science "isogeometric elastoplastic contact, with headless pictures"
  "Computes bodies made of NURBS that are pressed, dragged and ploughed by rigid\ntools and by one another, at large strains, with plastic flow, friction and\nmeshes that follow. Draws contour pictures, charts, videos and pages without a\ndisplay, and writes series for ParaView."
  PACKAGE_DEPENDS "fonts-dejavu-core, libembree3-3, libosmesa6"
  PACKAGE_RECOMMENDS "burnish-multigrid"
  PACKAGE_SUGGESTS "burnish-cad, burnish-doc, ffmpeg, python3-burnish")
burnish_package(multigrid burnish-multigrid science "isogeometric elastoplastic contact - large bodies in space"
  "The multigrid solver of burnish, for bodies that sparse factors are too large\nfor, also on several processes. It needs PETSc and MPI."
  PACKAGE_DEPENDS "burnish (= ${PROJECT_VERSION}-${CPACK_DEBIAN_PACKAGE_RELEASE})")
burnish_package(cad burnish-cad science "isogeometric elastoplastic contact - files of CAD"
  "Reads and writes STEP and IGES for burnish. It needs OpenCASCADE."
  PACKAGE_DEPENDS "burnish (= ${PROJECT_VERSION}-${CPACK_DEBIAN_PACKAGE_RELEASE})")
burnish_package(doc burnish-doc doc "isogeometric elastoplastic contact - documentation"
  "Pages, tutorial, gallery and examples of burnish, as text and as a site that is\nread without a network."
  PACKAGE_ARCHITECTURE all
  PACKAGE_DEPENDS "libjs-mathjax, libjs-sphinxdoc"
  PACKAGE_SHLIBDEPS OFF)
burnish_package(python python3-burnish python "isogeometric elastoplastic contact - package of Python"
  "Reads results of burnish as arrays, and computes scenes in the process of\nPython."
  PACKAGE_DEPENDS "python3, python3-numpy, python3-h5py, python3-yaml, burnish (= ${PROJECT_VERSION}-${CPACK_DEBIAN_PACKAGE_RELEASE})"
  PACKAGE_RECOMMENDS python3-vtk9)
burnish_package(development libburnish-dev libdevel "isogeometric elastoplastic contact - engine for programs of others"
  "Headers and library of the engine of burnish, for scenes that are made,\ncomputed and read in a program of one's own."
  PACKAGE_DEPENDS "burnish (= ${PROJECT_VERSION}-${CPACK_DEBIAN_PACKAGE_RELEASE}), libeigen3-dev, libfmt-dev, libsuitesparse-dev, libopenblas-dev, libhdf5-dev, libyaml-cpp-dev, libmuparser-dev, libjsoncpp-dev, libtbb-dev, libcgal-dev")

# What every Debian package has to have. The date is that of SOURCE_DATE_EPOCH, where it is set.
string(TIMESTAMP BURNISH_CHANGE_DATE "%a, %d %b %Y %H:%M:%S +0000" UTC)
set(BURNISH_PACKAGE_VERSION "${PROJECT_VERSION}-${CPACK_DEBIAN_PACKAGE_RELEASE}")
configure_file("${CMAKE_CURRENT_LIST_DIR}/package/changelog.in" "${PROJECT_BINARY_DIR}/package/changelog.Debian" @ONLY)
set(CPACK_PRE_BUILD_SCRIPTS "${CMAKE_CURRENT_LIST_DIR}/package/complete.cmake")
set(CPACK_BURNISH_SOURCE_DIR "${PROJECT_SOURCE_DIR}")
set(CPACK_BURNISH_CHANGES "${PROJECT_BINARY_DIR}/package/changelog.Debian")
set(CPACK_BURNISH_PACKAGES program burnish multigrid burnish-multigrid cad burnish-cad doc burnish-doc python python3-burnish
  development libburnish-dev)

# Components without files, such as python where it is not built, are left out.
get_cmake_property(CPACK_COMPONENTS_ALL COMPONENTS)
list(REMOVE_ITEM CPACK_COMPONENTS_ALL Unspecified)
include(CPack)
