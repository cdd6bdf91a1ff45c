# What `cmake --install` puts where, by component: `library` (headers, static libraries, CMake
# configuration), `program`.

include(GNUInstallDirs)
include(CMakePackageConfigHelpers)
set(hexwall_cmake_dir ${CMAKE_INSTALL_LIBDIR}/cmake/hexwall)

# Headers include each other from the top of their tree, so that is on the consumer's path as well
# as the folder above it, from which he writes <hexwall/pipeline.h>.
add_library(hexwall_all INTERFACE)
target_link_libraries(hexwall_all INTERFACE hexwall_lib hexwall_exporters)
set_target_properties(hexwall_all PROPERTIES EXPORT_NAME hexwall)
set_target_properties(hexwall_lib PROPERTIES EXPORT_NAME pipeline OUTPUT_NAME hexwall)
set_target_properties(hexwall_exporters PROPERTIES EXPORT_NAME exporters)
install(TARGETS hexwall_all hexwall_lib hexwall_exporters
  EXPORT hexwall
  COMPONENT library
  ARCHIVE DESTINATION ${CMAKE_INSTALL_LIBDIR} COMPONENT library
  INCLUDES DESTINATION ${CMAKE_INSTALL_INCLUDEDIR} ${CMAKE_INSTALL_INCLUDEDIR}/hexwall)
install(DIRECTORY src/ DESTINATION ${CMAKE_INSTALL_INCLUDEDIR}/hexwall COMPONENT library
  FILES_MATCHING PATTERN "*.h")
install(DIRECTORY exporters DESTINATION ${CMAKE_INSTALL_INCLUDEDIR}/hexwall COMPONENT library
  FILES_MATCHING PATTERN "*.h")
install(EXPORT hexwall NAMESPACE hexwall:: FILE hexwallTargets.cmake
  DESTINATION ${hexwall_cmake_dir} COMPONENT library)
configure_package_config_file(${CMAKE_CURRENT_LIST_DIR}/hexwallConfig.cmake.in
  ${CMAKE_BINARY_DIR}/hexwallConfig.cmake INSTALL_DESTINATION ${hexwall_cmake_dir})
write_basic_package_version_file(${CMAKE_BINARY_DIR}/hexwallConfigVersion.cmake
  COMPATIBILITY SameMinorVersion)
install(FILES ${CMAKE_BINARY_DIR}/hexwallConfig.cmake ${CMAKE_BINARY_DIR}/hexwallConfigVersion.cmake
  DESTINATION ${hexwall_cmake_dir} COMPONENT library)

install(TARGETS hexwall hexwall-picture
  RUNTIME DESTINATION ${CMAKE_INSTALL_BINDIR} COMPONENT program)
