# What belongs to the suite as a whole: the CMake package isohull, licence and documentation.
set(PACKAGE_DIR ${CMAKE_INSTALL_LIBDIR}/cmake/isohull)
write_basic_package_version_file(${PROJECT_BINARY_DIR}/isohullConfigVersion.cmake
                                 COMPATIBILITY SameMinorVersion)
install(FILES ${PROJECT_SOURCE_DIR}/cmake/isohullConfig.cmake
              ${PROJECT_BINARY_DIR}/isohullConfigVersion.cmake DESTINATION ${PACKAGE_DIR})

# As in the sources, so that links from one page to another hold.
install(FILES README.md CHANGELOG.md LICENSE DESTINATION ${CMAKE_INSTALL_DOCDIR})
install(DIRECTORY docs DESTINATION ${CMAKE_INSTALL_DOCDIR})
foreach(library nurbs galv igabem bayesopt)
  install(FILES lib${library}/README.md DESTINATION ${CMAKE_INSTALL_DOCDIR}/lib${library})
endforeach()
