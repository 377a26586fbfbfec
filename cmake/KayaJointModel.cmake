# kaya_add_joint_model(NAME [COMPAT] sources... [FLAGS flags...]): a joint model as a shared library NAME.so in the
# current binary folder. With COMPAT the sources define a class derived from jmodels::JointModel, written for
# 3DEC 4, 5, 7 or 9. Used by kaya itself, and by other projects after find_package(kaya).

get_filename_component(_kaya_root "${CMAKE_CURRENT_LIST_DIR}" ABSOLUTE)
while(NOT EXISTS "${_kaya_root}/include/kaya/jmodel.h" AND NOT _kaya_root STREQUAL "/")
  get_filename_component(_kaya_root "${_kaya_root}" DIRECTORY)
endwhile()
set(KAYA_INCLUDE_DIR "${_kaya_root}/include")
set(KAYA_PROGRAM "${_kaya_root}/bin/kaya")

function(kaya_add_joint_model name)
  cmake_parse_arguments(arg "COMPAT" "" "FLAGS" ${ARGN})
  set(target joint_${name})
  add_library(${target} MODULE ${arg_UNPARSED_ARGUMENTS})
  set_target_properties(${target} PROPERTIES PREFIX "" OUTPUT_NAME ${name} CXX_VISIBILITY_PRESET hidden)
  target_include_directories(${target} PRIVATE ${KAYA_INCLUDE_DIR})
  # The result of a row must not depend on its position in a vector, nor on the machine.
  target_compile_options(${target} PRIVATE -ffp-contract=off -fno-tree-slp-vectorize -fno-math-errno -fno-trapping-math)
  if(arg_COMPAT)
    # Sources guard their exports with macros defined in their project files.
    foreach(source ${arg_UNPARSED_ARGUMENTS})
      file(STRINGS ${source} conditions REGEX "^[ \t]*#[ \t]*if")
      string(REGEX MATCHALL "[A-Za-z_][A-Za-z0-9_]*_(EXPORTS|LIB)" macros "${conditions}")
      target_compile_definitions(${target} PRIVATE ${macros})
    endforeach()
    target_sources(${target} PRIVATE ${KAYA_INCLUDE_DIR}/kaya/compat/adapter.cpp)
    target_compile_features(${target} PRIVATE cxx_std_17)
    target_include_directories(${target} PRIVATE ${KAYA_INCLUDE_DIR}/kaya/compat)
    target_compile_options(${target} PRIVATE -w "SHELL:-include kaya/compat/msvc.h")
  else()
    target_compile_features(${target} PRIVATE cxx_std_20)
  endif()
  target_compile_options(${target} PRIVATE ${arg_FLAGS})
endfunction()

# kaya_add_zone_model(NAME sources... [FLAGS flags...]): a zone model (kaya/zmodel.h) as a shared library NAME.so.
function(kaya_add_zone_model name)
  cmake_parse_arguments(arg "" "" "FLAGS" ${ARGN})
  set(target zone_${name})
  add_library(${target} MODULE ${arg_UNPARSED_ARGUMENTS})
  set_target_properties(${target} PROPERTIES PREFIX "" OUTPUT_NAME ${name} CXX_VISIBILITY_PRESET hidden)
  target_include_directories(${target} PRIVATE ${KAYA_INCLUDE_DIR})
  target_compile_options(${target} PRIVATE -ffp-contract=off -fno-tree-slp-vectorize -fno-math-errno -fno-trapping-math)
  target_compile_features(${target} PRIVATE cxx_std_20)
  target_compile_options(${target} PRIVATE ${arg_FLAGS})
endfunction()
