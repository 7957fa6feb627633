# What every library, tool and test of the suite shares: flags, third parties, install rules.

find_package(PkgConfig REQUIRED)
# Empty when switched off: then the loops run on one thread, and the pragmas mean nothing.
set(ISOHULL_OPENMP_TARGET "")
if(ISOHULL_OPENMP)
  if(NOT TARGET OpenMP::OpenMP_C)
    find_package(OpenMP COMPONENTS C)
    if(NOT OpenMP_C_FOUND)
      message(FATAL_ERROR "${CMAKE_C_COMPILER} has no OpenMP; ISOHULL_OPENMP=OFF builds without")
    endif()
    # A host project that links the archives resolves the name too.
    set_target_properties(OpenMP::OpenMP_C PROPERTIES IMPORTED_GLOBAL TRUE)
  endif()
  set(ISOHULL_OPENMP_TARGET OpenMP::OpenMP_C)
endif()

# Where the libraries stand as seen from the commands.
file(RELATIVE_PATH ISOHULL_LIBDIR_FROM_BINDIR ${CMAKE_INSTALL_FULL_BINDIR}
     ${CMAKE_INSTALL_FULL_LIBDIR})

add_library(isohull_flags INTERFACE)
target_compile_definitions(isohull_flags INTERFACE _POSIX_C_SOURCE=200809L)
target_compile_options(
  isohull_flags INTERFACE -Wall -Wextra -Wpedantic -Wconversion -Wshadow -fno-math-errno
                          -fno-trapping-math $<$<BOOL:${ISOHULL_WERROR}>:-Werror>
                          $<$<NOT:$<BOOL:${ISOHULL_OPENMP}>>:-Wno-unknown-pragmas>)
if(ISOHULL_SANITIZE)
  target_compile_options(isohull_flags INTERFACE -fsanitize=${ISOHULL_SANITIZE}
                                                 -fno-omit-frame-pointer)
  target_link_options(isohull_flags INTERFACE -fsanitize=${ISOHULL_SANITIZE})
  # Function multiversioning resolves before the sanitizer runtime is up.
  target_compile_definitions(isohull_flags INTERFACE ISOHULL_NO_MULTIVERSION)
endif()

# isohull_modules(MODULES...): the pkg-config modules, each as the target PkgConfig::<MODULE>.
function(isohull_modules)
  foreach(module IN LISTS ARGN)
    string(TOUPPER ${module} prefix)
    pkg_check_modules(${prefix} REQUIRED QUIET IMPORTED_TARGET GLOBAL ${module})
  endforeach()
endfunction()

# isohull_library(NAME SUMMARY "..." [USES libraries of the suite...] [MODULES pkg-config modules...]
# [SYSTEM libraries without one...] [OPENMP] [THREADS: options tell how many])
#
# The library lib<NAME>, shared or static as BUILD_SHARED_LIBS says, from the rooms of src/ with the
# public headers include/<NAME>/*.h, its soname, its pkg-config file and its CMake package <NAME>.
# The sources are compiled once, as <NAME>_objects; <NAME>_internal also shows what users of the
# library cannot see, for its own tests.
function(isohull_library name)
  cmake_parse_arguments(ARG "OPENMP;THREADS" "SUMMARY" "USES;MODULES;SYSTEM" ${ARGN})
  file(GLOB_RECURSE sources CONFIGURE_DEPENDS src/*.c)
  file(GLOB headers CONFIGURE_DEPENDS include/${name}/*.h)
  string(TOUPPER ${name} upper)
  configure_file(${PROJECT_SOURCE_DIR}/cmake/version.h.in include/${name}/version.h @ONLY)
  list(APPEND headers ${CMAKE_CURRENT_BINARY_DIR}/include/${name}/version.h)
  isohull_modules(${ARG_MODULES})
  set(third_parties ${ARG_SYSTEM} m)
  foreach(module IN LISTS ARG_MODULES)
    string(TOUPPER ${module} module)
    list(APPEND third_parties PkgConfig::${module})
  endforeach()
  if(ARG_OPENMP)
    list(APPEND third_parties ${ISOHULL_OPENMP_TARGET})
  endif()

  if(ARG_THREADS)
    list(APPEND sources ${PROJECT_SOURCE_DIR}/internal/threads.c)
  endif()
  add_library(${name}_objects OBJECT ${sources} ${headers})
  target_include_directories(${name}_objects PUBLIC include src ${PROJECT_SOURCE_DIR}/internal
                                                      ${CMAKE_CURRENT_BINARY_DIR}/include)
  target_compile_definitions(${name}_objects PRIVATE ${upper}_VERSION_STRING="${PROJECT_VERSION}")
  target_link_libraries(${name}_objects PRIVATE isohull_flags PUBLIC ${ARG_USES} ${third_parties})
  add_library(${name}_internal STATIC EXCLUDE_FROM_ALL)
  target_link_libraries(${name}_internal PUBLIC ${name}_objects)

  if(BUILD_SHARED_LIBS)
    isohull_shared_library(${name})
  else()
    isohull_static_library(${name})
  endif()
  add_library(${name}::${name} ALIAS ${name})
  target_include_directories(
    ${name} PUBLIC $<BUILD_INTERFACE:${CMAKE_CURRENT_SOURCE_DIR}/include>
                   $<BUILD_INTERFACE:${CMAKE_CURRENT_BINARY_DIR}/include>
                   $<INSTALL_INTERFACE:${CMAKE_INSTALL_INCLUDEDIR}>)
  target_link_libraries(${name} PUBLIC ${ARG_USES} PRIVATE ${third_parties})
  if(ISOHULL_INSTALL)
    isohull_install_library(${name})
  endif()
endfunction()

# Part of isohull_library, whose arguments it sees. Only the library's own prefix leaves it: hidden visibility does not reach the dispatchers of
# multiversioned functions.
function(isohull_shared_library name)
  add_library(${name} SHARED)
  target_link_libraries(${name} PRIVATE $<BUILD_INTERFACE:${name}_objects>)
  set_target_properties(${name} PROPERTIES VERSION ${PROJECT_VERSION}
                                           SOVERSION ${ISOHULL_SOVERSION})
  if(NOT ISOHULL_SANITIZE)
    target_link_options(${name} PRIVATE -Wl,--no-undefined)
  endif()
  set(exports ${CMAKE_CURRENT_BINARY_DIR}/${name}.map)
  file(CONFIGURE OUTPUT ${exports} CONTENT "${upper}_${ISOHULL_SOVERSION} { global: ${name}_*; local: *; };\n")
  target_link_options(${name} PRIVATE -Wl,--version-script=${exports})
  set_target_properties(${name} PROPERTIES LINK_DEPENDS ${exports})
  # Whoever links or opens a library that uses another one finds both in the same folder.
  if(ARG_USES)
    set_target_properties(${name} PROPERTIES INSTALL_RPATH "$ORIGIN")
  endif()
endfunction()

# The same of an archive: one object, whose other symbols are local, so that they cannot clash with
# a caller's or another library's.
function(isohull_static_library name)
  set(object ${CMAKE_CURRENT_BINARY_DIR}/${name}.o)
  add_custom_command(
    OUTPUT ${object}
    COMMAND ${CMAKE_LINKER} -r -o ${object} $<TARGET_OBJECTS:${name}_objects>
    COMMAND ${CMAKE_OBJCOPY} --wildcard --keep-global-symbol=${name}_* ${object}
    DEPENDS $<TARGET_OBJECTS:${name}_objects>
    COMMAND_EXPAND_LISTS VERBATIM)
  add_library(${name} STATIC ${object})
  set_target_properties(${name} PROPERTIES LINKER_LANGUAGE C)
endfunction()

# Part of isohull_library, whose arguments it sees.
function(isohull_install_library name)
  install(TARGETS ${name} EXPORT ${name} LIBRARY DESTINATION ${CMAKE_INSTALL_LIBDIR}
          ARCHIVE DESTINATION ${CMAKE_INSTALL_LIBDIR})
  install(FILES ${headers} DESTINATION ${CMAKE_INSTALL_INCLUDEDIR}/${name})
  install(
    EXPORT ${name}
    NAMESPACE ${name}::
    FILE ${name}Targets.cmake
    DESTINATION ${CMAKE_INSTALL_LIBDIR}/cmake/${name})

  # Who links a shared library needs nothing of what it is made with; who links an archive needs all.
  set(PACKAGE_NAME ${name})
  set(PACKAGE_DEPENDS "")
  foreach(dependency IN LISTS ARG_USES)
    string(APPEND PACKAGE_DEPENDS "find_dependency(${dependency})\n")
  endforeach()
  set(PC_REQUIRES_PRIVATE "")
  set(PC_LIBS_PRIVATE -lm)
  if(NOT BUILD_SHARED_LIBS)
    list(JOIN ARG_MODULES " " PC_REQUIRES_PRIVATE)
    string(APPEND PACKAGE_DEPENDS "find_dependency(PkgConfig)\n")
    foreach(module IN LISTS ARG_MODULES)
      string(TOUPPER ${module} prefix)
      string(APPEND PACKAGE_DEPENDS
             "pkg_check_modules(${prefix} REQUIRED QUIET IMPORTED_TARGET GLOBAL ${module})\n")
    endforeach()
    foreach(library IN LISTS ARG_SYSTEM)
      string(PREPEND PC_LIBS_PRIVATE "-l${library} ")
    endforeach()
    if(ARG_OPENMP AND ISOHULL_OPENMP)
      string(APPEND PACKAGE_DEPENDS "find_dependency(OpenMP COMPONENTS C)\n")
      string(APPEND PC_LIBS_PRIVATE " ${OpenMP_C_FLAGS}")
    endif()
  endif()
  configure_file(${PROJECT_SOURCE_DIR}/cmake/Package.cmake.in ${name}Config.cmake @ONLY)
  write_basic_package_version_file(${name}ConfigVersion.cmake VERSION ${PROJECT_VERSION}
                                   COMPATIBILITY SameMinorVersion)
  install(FILES ${CMAKE_CURRENT_BINARY_DIR}/${name}Config.cmake
                ${CMAKE_CURRENT_BINARY_DIR}/${name}ConfigVersion.cmake
          DESTINATION ${CMAKE_INSTALL_LIBDIR}/cmake/${name})

  # Below the prefix, what the file names moves with it; an absolute folder is said as it is.
  set(PC_LIBDIR "\${prefix}/${CMAKE_INSTALL_LIBDIR}")
  file(RELATIVE_PATH PC_PREFIX ${CMAKE_INSTALL_FULL_LIBDIR}/pkgconfig ${CMAKE_INSTALL_PREFIX})
  string(REGEX REPLACE "/$" "" PC_PREFIX "\${pcfiledir}/${PC_PREFIX}")
  if(IS_ABSOLUTE ${CMAKE_INSTALL_LIBDIR})
    set(PC_LIBDIR ${CMAKE_INSTALL_LIBDIR})
    set(PC_PREFIX ${CMAKE_INSTALL_PREFIX})
  endif()
  set(PC_INCLUDEDIR "\${prefix}/${CMAKE_INSTALL_INCLUDEDIR}")
  if(IS_ABSOLUTE ${CMAKE_INSTALL_INCLUDEDIR})
    set(PC_INCLUDEDIR ${CMAKE_INSTALL_INCLUDEDIR})
  endif()
  list(TRANSFORM ARG_USES PREPEND lib OUTPUT_VARIABLE PC_REQUIRES)
  list(JOIN PC_REQUIRES " " PC_REQUIRES)
  configure_file(${PROJECT_SOURCE_DIR}/pkgconfig/library.pc.in lib${name}.pc @ONLY)
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
                                                "$ORIGIN/${ISOHULL_LIBDIR_FROM_BINDIR}")
  target_compile_definitions(${name}_tool PRIVATE TOOL_VERSION="${PROJECT_VERSION}")
  target_link_libraries(${name}_tool PRIVATE tool_common ${ARG_LIBRARIES} isohull_flags m)
  # Man pages and completions of shells, from --help, which a cross build asks its emulator for.
  set(command $<TARGET_FILE:${name}_tool>)
  if(CMAKE_CROSSCOMPILING)
    set(command ${CMAKE_CROSSCOMPILING_EMULATOR} ${command})
  endif()
  set(pages ${CMAKE_CURRENT_BINARY_DIR}/pages)
  add_custom_command(
    OUTPUT ${pages}/man1/${name}.1
    COMMAND ${CMAKE_COMMAND} "-DCOMMAND=${command}" -DNAME=${name}
            -DVERSION=${PROJECT_VERSION} -DOUTPUT=${pages} -P ${PROJECT_SOURCE_DIR}/cmake/manpage.cmake
    DEPENDS ${name}_tool ${PROJECT_SOURCE_DIR}/cmake/manpage.cmake
    VERBATIM)
  add_custom_target(${name}_manpage ALL DEPENDS ${pages}/man1/${name}.1)
  if(ISOHULL_INSTALL)
    install(TARGETS ${name}_tool RUNTIME DESTINATION ${CMAKE_INSTALL_BINDIR})
    install(DIRECTORY ${pages}/man1 DESTINATION ${CMAKE_INSTALL_MANDIR})
    install(FILES ${pages}/bash/${name} DESTINATION ${CMAKE_INSTALL_DATADIR}/bash-completion/completions)
    install(FILES ${pages}/zsh/_${name} DESTINATION ${CMAKE_INSTALL_DATADIR}/zsh/vendor-completions)
    install(FILES ${pages}/fish/${name}.fish
            DESTINATION ${CMAKE_INSTALL_DATADIR}/fish/vendor_completions.d)
  endif()
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
  target_link_libraries(${name} PRIVATE ${ARG_LIBRARIES} PkgConfig::CUNIT isohull_flags m)
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
  if(CMAKE_CROSSCOMPILING_EMULATOR)
    math(EXPR ARG_TIMEOUT "20 * ${ARG_TIMEOUT}")
  endif()
  set_tests_properties(${name} PROPERTIES LABELS "${ARG_LABELS}" TIMEOUT ${ARG_TIMEOUT})
endfunction()
