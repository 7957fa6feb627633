# What every library, tool and test of the suite shares: flags, third parties, install rules.

find_package(PkgConfig REQUIRED)
find_package(OpenMP COMPONENTS C)
pkg_check_modules(OPENBLAS REQUIRED IMPORTED_TARGET openblas)
pkg_check_modules(LAPACKE REQUIRED IMPORTED_TARGET lapacke)
find_library(MATH_LIBRARY m REQUIRED)

add_library(isohull_flags INTERFACE)
target_compile_definitions(isohull_flags INTERFACE _POSIX_C_SOURCE=200809L)
target_compile_options(
  isohull_flags INTERFACE -Wall -Wextra -Wpedantic -Wconversion -Wshadow -fno-math-errno
                          -fno-trapping-math $<$<BOOL:${ISOHULL_WERROR}>:-Werror>)
if(ISOHULL_SANITIZE)
  target_compile_options(isohull_flags INTERFACE -fsanitize=${ISOHULL_SANITIZE}
                                                 -fno-omit-frame-pointer)
  target_link_options(isohull_flags INTERFACE -fsanitize=${ISOHULL_SANITIZE})
  # Function multiversioning resolves before the sanitizer runtime is up.
  target_compile_definitions(isohull_flags INTERFACE ISOHULL_NO_MULTIVERSION)
endif()

# isohull_library(NAME SUMMARY "..." [LIBRARIES targets...] [PUBLIC_LIBRARIES targets...])
#
# A shared library lib<NAME> from the rooms of src/ with the public headers include/<NAME>/*.h, its
# soname, its pkg-config file and its CMake package <NAME>. The sources are compiled once, as
# <NAME>_objects; <NAME>_internal is the same as a static library that also shows what users of the
# library cannot see, for its own tests.
function(isohull_library name)
  cmake_parse_arguments(ARG "" "SUMMARY" "LIBRARIES;PUBLIC_LIBRARIES;REQUIRES;REQUIRES_PRIVATE"
                        ${ARGN})
  file(GLOB_RECURSE sources CONFIGURE_DEPENDS src/*.c)
  file(GLOB headers CONFIGURE_DEPENDS include/${name}/*.h)
  string(TOUPPER ${name} upper)
  add_library(${name}_objects OBJECT ${sources} ${headers})
  target_include_directories(${name}_objects PUBLIC include src)
  target_compile_definitions(${name}_objects PRIVATE ${upper}_BUILDING
                                                     ${upper}_VERSION_STRING="${PROJECT_VERSION}")
  target_link_libraries(${name}_objects PRIVATE isohull_flags PUBLIC ${ARG_LIBRARIES}
                                                                     ${ARG_PUBLIC_LIBRARIES})
  add_library(${name} SHARED)
  add_library(${name}::${name} ALIAS ${name})
  target_include_directories(
    ${name} PUBLIC $<BUILD_INTERFACE:${CMAKE_CURRENT_SOURCE_DIR}/include>
                   $<INSTALL_INTERFACE:${CMAKE_INSTALL_INCLUDEDIR}>)
  target_link_libraries(${name} PRIVATE $<BUILD_INTERFACE:${name}_objects> ${ARG_LIBRARIES}
                                        ${MATH_LIBRARY})
  if(ARG_PUBLIC_LIBRARIES)
    target_link_libraries(${name} PUBLIC ${ARG_PUBLIC_LIBRARIES})
  endif()
  add_library(${name}_internal STATIC EXCLUDE_FROM_ALL)
  target_link_libraries(${name}_internal PUBLIC ${name}_objects)
  set_target_properties(${name} PROPERTIES VERSION ${PROJECT_VERSION}
                                           SOVERSION ${PROJECT_VERSION_MAJOR})
  if(NOT ISOHULL_SANITIZE)
    target_link_options(${name} PRIVATE -Wl,--no-undefined)
  endif()
  # Only the library's own prefix leaves it: hidden visibility does not reach the dispatchers of
  # multiversioned functions.
  set(exports ${CMAKE_CURRENT_BINARY_DIR}/${name}.map)
  file(CONFIGURE OUTPUT ${exports} CONTENT "{ global: ${name}_*; local: *; };\n")
  target_link_options(${name} PRIVATE -Wl,--version-script=${exports})
  set_target_properties(${name} PROPERTIES LINK_DEPENDS ${exports})

  install(TARGETS ${name} EXPORT ${name} LIBRARY DESTINATION ${CMAKE_INSTALL_LIBDIR})
  install(FILES ${headers} DESTINATION ${CMAKE_INSTALL_INCLUDEDIR}/${name})
  install(
    EXPORT ${name}
    NAMESPACE ${name}::
    FILE ${name}Targets.cmake
    DESTINATION ${CMAKE_INSTALL_LIBDIR}/cmake/${name})
  set(PACKAGE_NAME ${name})
  set(PACKAGE_DEPENDS "")
  foreach(dep IN LISTS ARG_PUBLIC_LIBRARIES)
    string(APPEND PACKAGE_DEPENDS "find_dependency(${dep})\n")
  endforeach()
  configure_file(${PROJECT_SOURCE_DIR}/cmake/Package.cmake.in ${name}Config.cmake @ONLY)
  write_basic_package_version_file(${name}ConfigVersion.cmake COMPATIBILITY SameMinorVersion)
  install(FILES ${CMAKE_CURRENT_BINARY_DIR}/${name}Config.cmake
                ${CMAKE_CURRENT_BINARY_DIR}/${name}ConfigVersion.cmake
          DESTINATION ${CMAKE_INSTALL_LIBDIR}/cmake/${name})
  configure_file(${PROJECT_SOURCE_DIR}/pkgconfig/lib${name}.pc.in lib${name}.pc @ONLY)
  install(FILES ${CMAKE_CURRENT_BINARY_DIR}/lib${name}.pc
          DESTINATION ${CMAKE_INSTALL_LIBDIR}/pkgconfig)
endfunction()

# isohull_tool(NAME LIBRARIES targets...): the command NAME from the *.c files of its folder and of
# the folders in it.
function(isohull_tool name)
  cmake_parse_arguments(ARG "" "" "LIBRARIES" ${ARGN})
  file(GLOB_RECURSE sources CONFIGURE_DEPENDS *.c)
  add_executable(${name}_tool ${sources})
  target_include_directories(${name}_tool PRIVATE ${CMAKE_CURRENT_SOURCE_DIR})
  set_target_properties(${name}_tool PROPERTIES OUTPUT_NAME ${name} INSTALL_RPATH
                                                "$ORIGIN/../${CMAKE_INSTALL_LIBDIR}")
  target_compile_definitions(${name}_tool PRIVATE TOOL_VERSION="${PROJECT_VERSION}")
  target_link_libraries(${name}_tool PRIVATE tool_common ${ARG_LIBRARIES} isohull_flags
                                             ${MATH_LIBRARY})
  install(TARGETS ${name}_tool RUNTIME DESTINATION ${CMAKE_INSTALL_BINDIR})
  add_custom_command(
    OUTPUT ${name}.1
    COMMAND ${CMAKE_COMMAND} -DCOMMAND=$<TARGET_FILE:${name}_tool> -DNAME=${name}
            -DVERSION=${PROJECT_VERSION} -DOUTPUT=${name}.1 -P
            ${PROJECT_SOURCE_DIR}/cmake/manpage.cmake
    DEPENDS ${name}_tool ${PROJECT_SOURCE_DIR}/cmake/manpage.cmake
    VERBATIM)
  add_custom_target(${name}_manpage ALL DEPENDS ${name}.1)
  install(FILES ${CMAKE_CURRENT_BINARY_DIR}/${name}.1 DESTINATION ${CMAKE_INSTALL_MANDIR}/man1)
endfunction()

# isohull_test(NAME SOURCES files... LIBRARIES targets... [LABELS labels...] [TIMEOUT seconds]): one
# CUnit program, one ctest entry. The program's data folder is TEST_DATA_DIR.
# Labels: fast (default; also run under the sanitizers), slow.
function(isohull_test name)
  cmake_parse_arguments(ARG "" "TIMEOUT" "SOURCES;LIBRARIES;LABELS;INCLUDES" ${ARGN})
  add_executable(${name} ${ARG_SOURCES})
  target_include_directories(${name} PRIVATE ${PROJECT_SOURCE_DIR}/tests ${ARG_INCLUDES})
  target_compile_definitions(${name} PRIVATE TEST_DATA_DIR="${PROJECT_SOURCE_DIR}/tests/data"
                                             EXAMPLES_DIR="${PROJECT_SOURCE_DIR}/examples")
  target_link_libraries(${name} PRIVATE ${ARG_LIBRARIES} PkgConfig::CUNIT isohull_flags
                                        ${MATH_LIBRARY})
  set_target_properties(${name} PROPERTIES RUNTIME_OUTPUT_DIRECTORY ${PROJECT_BINARY_DIR}/tests)
  add_test(NAME ${name} COMMAND ${name})
  if(NOT ARG_LABELS)
    set(ARG_LABELS fast)
  endif()
  if(NOT ARG_TIMEOUT)
    set(ARG_TIMEOUT 120)
  endif()
  if(ISOHULL_SANITIZE)
    math(EXPR ARG_TIMEOUT "5 * ${ARG_TIMEOUT}") # instrumented code is that much slower
  endif()
  set_tests_properties(${name} PROPERTIES LABELS "${ARG_LABELS}" TIMEOUT ${ARG_TIMEOUT})
endfunction()
