# VTK, for kaya-painter, the program that draws pictures. Without VTK everything else is built, and `plot` names the missing package.

set(KAYA_PAINTER AUTO CACHE STRING "build kaya-painter, which draws pictures with VTK: AUTO (where VTK is installed), ON or OFF")
set_property(CACHE KAYA_PAINTER PROPERTY STRINGS AUTO ON OFF)
if(NOT KAYA_PAINTER MATCHES "^(AUTO|ON|OFF)$")
  message(FATAL_ERROR "KAYA_PAINTER is '${KAYA_PAINTER}'; it is AUTO, ON or OFF")
endif()

set(KAYA_PAINTER_BUILT FALSE)
if(NOT KAYA_PAINTER STREQUAL "OFF")
  # All components in one call, and at the top: targets of VTK refer to those of other packages, which are defined in this folder
  # and below only. Tests read and write files with IOXML and IOLegacy.
  set(how QUIET)
  if(KAYA_PAINTER STREQUAL "ON")
    set(how REQUIRED)
  endif()
  find_package(VTK 9 ${how} COMPONENTS CommonCore CommonDataModel IOXML IOLegacy FiltersSources RenderingCore RenderingOpenGL2
    RenderingFreeType RenderingAnnotation RenderingContextOpenGL2 ChartsCore ViewsContext2D IOImage)
  set(KAYA_PAINTER_BUILT ${VTK_FOUND})
endif()

# Printed at the end of the configuration, where it is visible.
if(NOT KAYA_PAINTER_BUILT AND KAYA_PAINTER STREQUAL "AUTO")
  cmake_language(DEFER CALL message STATUS
    "kaya: built without kaya-painter, so 'plot' makes no pictures: VTK is missing (scripts/install --pictures)")
endif()
