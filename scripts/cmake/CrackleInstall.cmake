# Install rules and the CMake package. In another project:
#
#   find_package(crackle REQUIRED)            # with CMAKE_PREFIX_PATH=<prefix of the install>
#   target_link_libraries(my_program PRIVATE crackle::crackle)
#
# The libraries that crackle itself uses stay hidden behind the shared library: a user needs none of
# their -dev packages.
include(CMakePackageConfigHelpers)

set(package_folder "${CMAKE_INSTALL_LIBDIR}/cmake/crackle")

# The installed program finds its library next to it, wherever the whole is moved.
file(RELATIVE_PATH bin_to_lib "${CMAKE_INSTALL_FULL_BINDIR}" "${CMAKE_INSTALL_FULL_LIBDIR}")
set_target_properties(crackle_cli PROPERTIES INSTALL_RPATH "$ORIGIN/${bin_to_lib}")

install(TARGETS crackle EXPORT crackle_targets)
install(TARGETS crackle_cli)
install(TARGETS crackle_gmsh LIBRARY DESTINATION "${CMAKE_INSTALL_LIBDIR}")
install(DIRECTORY "${PROJECT_SOURCE_DIR}/include/crackle" "${PROJECT_BINARY_DIR}/include/crackle"
        DESTINATION "${CMAKE_INSTALL_INCLUDEDIR}" FILES_MATCHING PATTERN "*.hpp")
install(DIRECTORY "${PROJECT_SOURCE_DIR}/scripts/plots" DESTINATION "${CMAKE_INSTALL_DATADIR}/crackle"
        FILES_MATCHING PATTERN "*.py")
install(FILES "${PROJECT_SOURCE_DIR}/LICENSE" DESTINATION "${CMAKE_INSTALL_DOCDIR}")

install(EXPORT crackle_targets NAMESPACE crackle:: FILE crackle-targets.cmake DESTINATION "${package_folder}")
file(WRITE "${PROJECT_BINARY_DIR}/crackle-config.cmake.in"
     "@PACKAGE_INIT@\ninclude(\"\${CMAKE_CURRENT_LIST_DIR}/crackle-targets.cmake\")\n")
configure_package_config_file("${PROJECT_BINARY_DIR}/crackle-config.cmake.in"
                              "${PROJECT_BINARY_DIR}/crackle-config.cmake"
                              INSTALL_DESTINATION "${package_folder}")
write_basic_package_version_file("${PROJECT_BINARY_DIR}/crackle-config-version.cmake"
                                 COMPATIBILITY SameMinorVersion)
install(FILES "${PROJECT_BINARY_DIR}/crackle-config.cmake" "${PROJECT_BINARY_DIR}/crackle-config-version.cmake"
        DESTINATION "${package_folder}")
