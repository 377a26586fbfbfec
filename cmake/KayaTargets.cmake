# Flags of all targets of kaya, in one place, so that no folder sets its own.

set(KAYA_ARCH "native" CACHE STRING "value of -march: native, x86-64-v3 or x86-64-v2; each gives the same bits")
option(KAYA_WERROR "warnings are errors in kaya's own code" OFF)
option(KAYA_TOGETHER "compile several files as one unit: a whole build takes less time, a changed file more" OFF)
set(KAYA_SANITIZE "" CACHE STRING "value of -fsanitize, e.g. address,undefined")

add_library(kaya_flags INTERFACE)
target_compile_features(kaya_flags INTERFACE cxx_std_20)
# No contraction to fused multiply-add: the result of a row must not depend on its position in a
# vector, nor on the machine. gcc 12 contracts in spite of -ffp-contract=off where it vectorises straight code, and Eigen calls
# such instructions itself where the machine has them (determinism.fused). errno and traps are not used; without them loops vectorise.
target_compile_options(kaya_flags INTERFACE
  -Wall -Wextra -Wpedantic
  # Not for files compiled together: a local name may equal that of a function in another file.
  $<$<NOT:$<BOOL:$<TARGET_PROPERTY:UNITY_BUILD>>>:-Wshadow>
  -Wnon-virtual-dtor
  -ffp-contract=off -fno-tree-slp-vectorize -fno-math-errno -fno-trapping-math)
target_compile_definitions(kaya_flags INTERFACE EIGEN_DONT_VECTORIZE)
if(KAYA_ARCH)
  target_compile_options(kaya_flags INTERFACE -march=${KAYA_ARCH})
endif()
if(KAYA_WERROR)
  target_compile_options(kaya_flags INTERFACE -Werror)
  # gcc 12 reports the undefined registers of AVX-512 intrinsics as errors in Eigen's headers. The warning
  # depends on the target processor, and kaya must build for each.
  if(CMAKE_CXX_COMPILER_ID STREQUAL "GNU")
    target_compile_options(kaya_flags INTERFACE -Wno-error=uninitialized -Wno-error=maybe-uninitialized)
  endif()
endif()
if(KAYA_SANITIZE)
  target_compile_options(kaya_flags INTERFACE -fsanitize=${KAYA_SANITIZE} -fno-omit-frame-pointer -fno-sanitize-recover=undefined)
  target_link_options(kaya_flags INTERFACE -fsanitize=${KAYA_SANITIZE})
  # gcc defines these words; clang's allocator, too, needs the memory that the program else limits.
  if(CMAKE_CXX_COMPILER_ID STREQUAL "Clang" AND KAYA_SANITIZE MATCHES "address")
    target_compile_definitions(kaya_flags INTERFACE __SANITIZE_ADDRESS__)
  elseif(CMAKE_CXX_COMPILER_ID STREQUAL "Clang" AND KAYA_SANITIZE MATCHES "thread")
    target_compile_definitions(kaya_flags INTERFACE __SANITIZE_THREAD__)
  endif()
  # clang compares the types of functions of other libraries by their addresses, which differ where a program does not export its own.
  # toml++ estimates the width of a number below 1 by a cast of its logarithm, and breaks a line or not by it.
  if(CMAKE_CXX_COMPILER_ID STREQUAL "Clang" AND KAYA_SANITIZE MATCHES "undefined")
    target_compile_options(kaya_flags INTERFACE
      -fno-sanitize=function -fsanitize-ignorelist=${PROJECT_SOURCE_DIR}/cmake/sanitizers.ignore)
  endif()
  # Boost's sockets use fences, which the thread sanitizer does not support; the objects that they order are checked.
  if(CMAKE_CXX_COMPILER_ID STREQUAL "GNU" AND KAYA_SANITIZE STREQUAL "thread")
    target_compile_options(kaya_flags INTERFACE -Wno-error=tsan)
  endif()
endif()

# What gcc 12 warns of in headers of the library and of Eigen, and wrongly; clang does not know all of these options.
set(KAYA_NO_FALSE_WARNINGS -Wno-array-bounds -Wno-restrict -Wno-stringop-overflow -Wno-stringop-overread -Wno-maybe-uninitialized
  -Wno-uninitialized)
set(KAYA_NO_FALSE_WARNINGS "$<$<CXX_COMPILER_ID:GNU>:${KAYA_NO_FALSE_WARNINGS}>")

# Reading these takes a third of the time of a build; they are read once, for all libraries (as far as the preset wants that). They are the
# system's, so that a change of kaya's own headers compiles no more than it must.
set(KAYA_READ_ONCE <Eigen/Geometry> <algorithm> <array> <cmath> <cstdint> <filesystem> <fmt/format.h> <functional> <limits> <map>
  <memory> <numeric> <optional> <set> <sstream> <string> <variant> <vector>)
# gcc compiles a file that uses a precompiled header with the optimisation options of that header, whatever its own options say. So each
# level has a header: that of kaya_base, and that of kaya_once for code that runs once. A file with other options needs none of them.
function(kaya_read_once name from)
  if(name STREQUAL from)
    target_precompile_headers(${name} PRIVATE ${KAYA_READ_ONCE})
  else()
    target_precompile_headers(${name} REUSE_FROM ${from})
  endif()
  if(CMAKE_CXX_COMPILER_LAUNCHER MATCHES "ccache" AND CMAKE_CXX_COMPILER_ID STREQUAL "GNU" AND NOT CMAKE_DISABLE_PRECOMPILE_HEADERS)
    target_compile_options(${name} PRIVATE -fpch-preprocess)
  endif()
  # gcc 12 does not treat headers in a precompiled header as system headers: it warns of std::string (gcc bug 105329) and of intrinsics. The
  # other presets read headers one by one and keep these warnings.
  if(CMAKE_CXX_COMPILER_ID STREQUAL "GNU" AND NOT CMAKE_DISABLE_PRECOMPILE_HEADERS)
    target_compile_options(${name} PRIVATE "${KAYA_NO_FALSE_WARNINGS}")
  endif()
endfunction()

# Code that runs once for a command, and not once for a zone or a contact: -O1 compiles it in half of the time of -O3. The
# numbers are the same at each level, since nothing here allows the compiler to reorder arithmetic (tests/determinism).
set(KAYA_RUN_ONCE_PER_COMMAND $<$<CONFIG:Release,RelWithDebInfo>:-O1>)
function(kaya_runs_once name)
  target_compile_options(${name} PRIVATE ${KAYA_RUN_ONCE_PER_COMMAND})
  kaya_read_once(${name} kaya_once)
endfunction()
# The same for files of a library that is compiled at -O3.
function(kaya_files_run_once)
  set_source_files_properties(${ARGN} PROPERTIES SKIP_PRECOMPILE_HEADERS ON COMPILE_OPTIONS "${KAYA_RUN_ONCE_PER_COMMAND}")
endfunction()

# kaya_library(NAME [ONCE] [GROUPS n] [APART files...] [ROOMS folders...] [PUBLIC deps...] [PRIVATE deps...]): all .cpp files of the current
# folder and of its rooms.
# The link line defines which folders may be included. ONCE: kaya_runs_once.
function(kaya_library name)
  cmake_parse_arguments(arg "ONCE" "GROUPS" "APART;ROOMS;PUBLIC;PRIVATE" ${ARGN})
  list(TRANSFORM arg_ROOMS APPEND /*.cpp OUTPUT_VARIABLE in_rooms)
  file(GLOB sources CONFIGURE_DEPENDS *.cpp ${in_rooms})
  add_library(${name} STATIC ${sources})
  kaya_compile_together(${name} "${arg_GROUPS}" "${arg_APART}" ${sources})
  set_target_properties(${name} PROPERTIES POSITION_INDEPENDENT_CODE ON)
  target_include_directories(${name} PUBLIC ${PROJECT_SOURCE_DIR}/src ${PROJECT_SOURCE_DIR})
  target_include_directories(${name} PUBLIC ${PROJECT_SOURCE_DIR}/include)
  target_link_libraries(${name} PUBLIC ${arg_PUBLIC} PRIVATE kaya_flags ${arg_PRIVATE})
  target_compile_features(${name} PUBLIC cxx_std_20)
  get_target_property(linked ${name} LINK_LIBRARIES)
  if(arg_ONCE)
    kaya_runs_once(${name})
  elseif(linked MATCHES "kaya_(base|system|laws|model|mechanics|jointtest|interp|io)" OR name STREQUAL "kaya_base")
    kaya_read_once(${name} kaya_base)
  endif()
endfunction()

# With KAYA_TOGETHER the files of a target are compiled in `groups` units of several files each, which read their headers once. The
# name of a file alone decides its group: a new file changes no other group. `apart` lists files (patterns) that remain separate
# units: hot loops, whose inlining must not depend on other files, and files that share local names (table, rows_of).
function(kaya_compile_together name groups apart)
  if(NOT KAYA_TOGETHER OR NOT groups)
    return()
  endif()
  set_target_properties(${name} PROPERTIES UNITY_BUILD ON UNITY_BUILD_MODE GROUP)
  list(JOIN apart "|" apart)
  foreach(source ${ARGN})
    get_filename_component(file ${source} NAME_WE)
    if(apart AND file MATCHES "^(${apart})$")
      continue()
    endif()
    string(MD5 digest ${file})
    string(SUBSTRING ${digest} 0 6 digest)
    math(EXPR group "0x${digest} % ${groups}")
    set_source_files_properties(${source} PROPERTIES UNITY_GROUP ${group})
  endforeach()
endfunction()

# Files that see the same large templates are compiled as one group, so that the templates are instantiated once.
function(kaya_share_templates group)
  set_source_files_properties(${ARGN} PROPERTIES UNITY_GROUP ${group})
endfunction()

# What it takes to run a deck: the program and the joint models that ship. scripts/run builds this and no tests.
add_custom_target(program)

# The joint models that ship, in the folder next to the program that the loader searches.
include(${CMAKE_CURRENT_LIST_DIR}/KayaJointModel.cmake)
function(kaya_ship_joint_model name)
  kaya_add_joint_model(${name} ${ARGN})
  target_link_libraries(joint_${name} PRIVATE kaya_flags)
  set_target_properties(joint_${name} PROPERTIES LIBRARY_OUTPUT_DIRECTORY ${PROJECT_BINARY_DIR}/joints)
  add_dependencies(program joint_${name})
  install(TARGETS joint_${name} LIBRARY DESTINATION lib/kaya/joints COMPONENT program)
endfunction()

# The zone models that ship, likewise.
function(kaya_ship_zone_model name)
  kaya_add_zone_model(${name} ${ARGN})
  target_link_libraries(zone_${name} PRIVATE kaya_flags)
  set_target_properties(zone_${name} PROPERTIES LIBRARY_OUTPUT_DIRECTORY ${PROJECT_BINARY_DIR}/zones)
  add_dependencies(program zone_${name})
  install(TARGETS zone_${name} LIBRARY DESTINATION lib/kaya/zones COMPONENT program)
endfunction()

# The headers for joint models are next to the program, as after installation.
file(CREATE_LINK ${PROJECT_SOURCE_DIR}/include ${PROJECT_BINARY_DIR}/include SYMBOLIC)
