# One call a room: compiles src/<room>/*.cpp as an object library that sees its own libraries only.
#
#   crackle_room(mesh SOURCES generate.cpp ... LIBRARIES CGAL::CGAL OPTIONS -frounding-math)
#
# LIBRARIES stay PRIVATE to the room (no other room's sources can include their headers);
# the shared library crackle links them once. OBJECT libraries, because a static library
# silently drops a file whose only content is a self-registering law.
find_package(OpenMP REQUIRED COMPONENTS CXX)

set_property(GLOBAL PROPERTY CRACKLE_ROOMS "")
set_property(GLOBAL PROPERTY CRACKLE_ROOM_LIBRARIES "")

# The compiler settings that every target of the project shares.
function(crackle_compile_settings target)
  # No contraction to fused multiply-add: the same bits on every CPU, whatever vector width it has.
  # No errno and no trapping: lets the loops vectorise. Never -ffast-math.
  target_compile_options(${target} PRIVATE
    -ffp-contract=off -fno-math-errno -fno-trapping-math
    -Wall -Wextra -Wpedantic -Wshadow -Wconversion -Wno-sign-conversion)
  # GCC 12 sees an overlap that is not there in "text" + string (GCC bug 105651).
  if(CMAKE_CXX_COMPILER_ID STREQUAL "GNU" AND CMAKE_CXX_COMPILER_VERSION VERSION_LESS 13)
    target_compile_options(${target} PRIVATE -Wno-restrict)
  endif()
  if(CMAKE_BUILD_TYPE STREQUAL "Release")
    target_compile_options(${target} PRIVATE -O3)
  endif()
  if(CRACKLE_WERROR)
    target_compile_options(${target} PRIVATE -Werror)
  endif()
  if(CRACKLE_SANITIZE)
    target_compile_options(${target} PRIVATE -fsanitize=${CRACKLE_SANITIZE} -fno-omit-frame-pointer)
    target_link_options(${target} PRIVATE -fsanitize=${CRACKLE_SANITIZE})
    # Eigen would use an allocator of its own under the address sanitizer, and libgmsh, built without, shares its
    # functions: what one allocates the other frees.
    target_compile_definitions(${target} PRIVATE CRACKLE_SANITIZED EIGEN_MALLOC_ALREADY_ALIGNED=1)
  endif()
  if(CRACKLE_FUZZ)
    target_compile_options(${target} PRIVATE -fsanitize=fuzzer-no-link)
  endif()
endfunction()

function(crackle_room room)
  cmake_parse_arguments(arg "" "" "SOURCES;LIBRARIES;OPTIONS" ${ARGN})
  set(target crackle_${room})
  add_library(${target} OBJECT ${arg_SOURCES})
  target_include_directories(${target} PUBLIC
    "${PROJECT_SOURCE_DIR}/include" "${PROJECT_BINARY_DIR}/include")
  target_link_libraries(${target} PRIVATE OpenMP::OpenMP_CXX ${arg_LIBRARIES})
  crackle_compile_settings(${target})
  if(arg_OPTIONS)
    target_compile_options(${target} PRIVATE ${arg_OPTIONS})
  endif()
  set_property(GLOBAL APPEND PROPERTY CRACKLE_ROOMS ${target})
  set_property(GLOBAL APPEND PROPERTY CRACKLE_ROOM_LIBRARIES ${arg_LIBRARIES})
endfunction()
