# Packages of Debian by `cpack`: kaya (the program, its laws, manual, completion), kaya-pictures (the painter, if it was built), python3-kaya
# (if pybind11 is there), libkaya1 (the engine for other programs), kaya-dev (headers and the CMake package for joint
# and zone models) and kaya-doc (if the pages were made). scripts/package builds them for any processor since 2009.
set(CMAKE_SKIP_INSTALL_ALL_DEPENDENCY ON) # what is installed is the target `program`
set(CPACK_GENERATOR DEB)
set(CPACK_PACKAGE_VENDOR "The kaya authors")
set(CPACK_PACKAGE_CONTACT "The kaya authors <kaya@localhost>")
set(CPACK_PACKAGING_INSTALL_PREFIX /usr)
set(CPACK_STRIP_FILES ON)
set(CPACK_DEB_COMPONENT_INSTALL ON)
set(CPACK_COMPONENTS_ALL program library development)
if(KAYA_PAINTER_BUILT)
  list(APPEND CPACK_COMPONENTS_ALL pictures)
endif()
add_custom_target(packaged DEPENDS program kaya_library) # all that the packages hold
if(TARGET kaya_python)
  list(APPEND CPACK_COMPONENTS_ALL python)
  add_dependencies(packaged kaya_python)
endif()
set(KAYA_DOCUMENTS "" CACHE PATH "folder that scripts/site has written, for the package kaya-doc; empty: without it")
if(KAYA_DOCUMENTS)
  list(APPEND CPACK_COMPONENTS_ALL documents)
  install(DIRECTORY ${KAYA_DOCUMENTS}/html DESTINATION share/doc/kaya COMPONENT documents)
  install(DIRECTORY ${KAYA_DOCUMENTS}/source/examples DESTINATION share/doc/kaya COMPONENT documents)
endif()
set(CPACK_DEBIAN_FILE_NAME DEB-DEFAULT)
set(CPACK_DEBIAN_PACKAGE_SECTION science)
set(CPACK_DEBIAN_PACKAGE_SHLIBDEPS ON) # the libraries that the files need, found by dpkg-shlibdeps
set(CPACK_DEBIAN_PROGRAM_PACKAGE_NAME kaya)
set(CPACK_DEBIAN_PROGRAM_PACKAGE_SUGGESTS "kaya-pictures, kaya-dev, kaya-doc")
set(CPACK_DEBIAN_PICTURES_PACKAGE_NAME kaya-pictures)
set(CPACK_DEBIAN_PICTURES_PACKAGE_DEPENDS "kaya (= ${PROJECT_VERSION}), xvfb, fonts-dejavu-core")
set(CPACK_DEBIAN_DEVELOPMENT_PACKAGE_NAME kaya-dev)
set(CPACK_DEBIAN_DEVELOPMENT_PACKAGE_DEPENDS "kaya (= ${PROJECT_VERSION}), libkaya1 (= ${PROJECT_VERSION}), g++")
set(CPACK_DEBIAN_LIBRARY_PACKAGE_NAME libkaya1)
set(CPACK_DEBIAN_LIBRARY_PACKAGE_SECTION libs)
# Programs that link against libkaya depend on this package; its installation updates the cache of the linker.
file(CONFIGURE OUTPUT package/shlibs CONTENT "libkaya 1 libkaya1 (>= ${PROJECT_VERSION})\n")
file(CONFIGURE OUTPUT package/triggers CONTENT "activate-noawait ldconfig\n")
set(CPACK_DEBIAN_LIBRARY_PACKAGE_CONTROL_EXTRA ${PROJECT_BINARY_DIR}/package/shlibs ${PROJECT_BINARY_DIR}/package/triggers)
set(CPACK_DEBIAN_PYTHON_PACKAGE_NAME python3-kaya)
set(CPACK_DEBIAN_PYTHON_PACKAGE_SECTION python)
set(CPACK_DEBIAN_PYTHON_PACKAGE_DEPENDS "kaya (= ${PROJECT_VERSION}), python3 (>= 3.11), python3 (<< 3.12), python3-numpy")
set(CPACK_DEBIAN_PYTHON_PACKAGE_SUGGESTS "python3-ipykernel, python3-matplotlib, python3-pandas")
set(CPACK_DEBIAN_DOCUMENTS_PACKAGE_NAME kaya-doc)
set(CPACK_DEBIAN_DOCUMENTS_PACKAGE_SECTION doc)
set(CPACK_DEBIAN_DOCUMENTS_PACKAGE_ARCHITECTURE all)
set(CPACK_DEBIAN_DOCUMENTS_PACKAGE_SHLIBDEPS OFF)
set(CPACK_COMPONENT_DOCUMENTS_DESCRIPTION "pages and examples of kaya
The commands, joint and zone models, theory and verification of the distinct
element program kaya as pages for a browser, and decks to start from.")
set(CPACK_COMPONENT_PYTHON_DESCRIPTION "models of kaya in Python
Commands, FISH and results of the distinct element program kaya in Python,
columns as arrays of numpy; a kernel for Jupyter whose cells are decks.")
set(CPACK_COMPONENT_PROGRAM_DESCRIPTION "distinct element program for jointed rock and masonry
kaya runs command files in the style of 3DEC: polyhedral blocks, rigid or
divided into zones, cut by joints, move in time by the distinct element
method. Functions in FISH and Lua, joint and zone laws as libraries, reports
for a browser.")
set(CPACK_COMPONENT_PICTURES_DESCRIPTION "pictures of kaya's models without a screen
The program that draws for the command plot of kaya.")
set(CPACK_COMPONENT_LIBRARY_DESCRIPTION "models of kaya inside other programs
The engine of the distinct element program kaya behind C functions.")
set(CPACK_COMPONENT_DEVELOPMENT_DESCRIPTION "headers for joint and zone laws of kaya
With them 'kaya jmodel build' and CMake's find_package(kaya) compile laws in
C and C++.")

# Decks open in editors and run from a file manager, in a terminal.
install(FILES cmake/desktop/kaya.desktop DESTINATION share/applications COMPONENT program)
install(FILES cmake/desktop/kaya.xml DESTINATION share/mime/packages COMPONENT program)
install(FILES cmake/desktop/kaya.svg DESTINATION share/icons/hicolor/scalable/apps COMPONENT program)

# What Debian wants in /usr/share/doc and of manuals: compressed, and the same bytes each time (no time in them).
find_program(KAYA_GZIP gzip)
if(KAYA_GZIP)
  set(KAYA_MANUAL ${PROJECT_BINARY_DIR}/package/kaya.1.gz)
  set(changes ${PROJECT_BINARY_DIR}/package/changelog.gz)
  file(MAKE_DIRECTORY ${PROJECT_BINARY_DIR}/package)
  add_custom_command(OUTPUT ${changes} DEPENDS ${PROJECT_SOURCE_DIR}/CHANGELOG.md VERBATIM
    COMMAND ${KAYA_GZIP} -9nc ${PROJECT_SOURCE_DIR}/CHANGELOG.md > ${changes})
  add_custom_command(OUTPUT ${KAYA_MANUAL} DEPENDS kaya VERBATIM COMMAND ${KAYA_GZIP} -9nc ${PROJECT_BINARY_DIR}/kaya.1 > ${KAYA_MANUAL})
  add_custom_target(package_changes DEPENDS ${changes})
  add_custom_target(package_texts DEPENDS ${KAYA_MANUAL})
  add_dependencies(package_texts package_changes)
  add_dependencies(program package_texts)
  install(FILES ${KAYA_MANUAL} DESTINATION share/man/man1 COMPONENT program)
endif()
foreach(component ${CPACK_COMPONENTS_ALL})
  string(TOUPPER ${component} upper)
  set(name ${CPACK_DEBIAN_${upper}_PACKAGE_NAME})
  set(folder share/doc/${name})
  install(FILES ${PROJECT_SOURCE_DIR}/cmake/copyright DESTINATION ${folder} COMPONENT ${component})
  # What lintian finds and is meant: no mail address; laws of arithmetic alone need nothing of the C library.
  file(CONFIGURE OUTPUT package/${name} CONTENT "${name}: bogus-mail-host *\n${name}: library-not-linked-against-libc *\n")
  install(FILES ${PROJECT_BINARY_DIR}/package/${name} DESTINATION share/lintian/overrides COMPONENT ${component})
  if(KAYA_GZIP)
    install(FILES ${changes} DESTINATION ${folder} COMPONENT ${component})
  endif()
endforeach()
include(CPack)
