# find_package(isohull COMPONENTS nurbs galv igabem bayesopt): the libraries named, or all four.
include(CMakeFindDependencyMacro)
set(_isohull_libraries nurbs galv igabem bayesopt)
if(NOT isohull_FIND_COMPONENTS)
  set(isohull_FIND_COMPONENTS ${_isohull_libraries})
endif()
foreach(_isohull_library IN LISTS isohull_FIND_COMPONENTS)
  if(_isohull_library IN_LIST _isohull_libraries)
    # Beside this file, whatever else the search path holds.
    find_package(${_isohull_library} CONFIG QUIET NO_DEFAULT_PATH PATHS
                 ${CMAKE_CURRENT_LIST_DIR}/../${_isohull_library})
    set(isohull_${_isohull_library}_FOUND ${${_isohull_library}_FOUND})
  elseif(isohull_FIND_REQUIRED_${_isohull_library})
    set(isohull_FOUND FALSE)
    list(JOIN _isohull_libraries ", " _isohull_known)
    set(isohull_NOT_FOUND_MESSAGE
        "isohull has no component ${_isohull_library}; there are ${_isohull_known}")
    return()
  endif()
  if(isohull_FIND_REQUIRED_${_isohull_library} AND NOT isohull_${_isohull_library}_FOUND)
    set(isohull_FOUND FALSE)
    set(isohull_NOT_FOUND_MESSAGE
        "component ${_isohull_library}: ${${_isohull_library}_NOT_FOUND_MESSAGE}")
    return()
  endif()
endforeach()
