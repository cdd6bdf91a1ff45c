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
# Static libraries: who links to them needs the parts of VTK that they need.
get_target_property(libraries hexwall_lib LINK_LIBRARIES)
get_target_property(more_libraries hexwall_exporters LINK_LIBRARIES)
set(hexwall_vtk_components ${libraries} ${more_libraries})
list(FILTER hexwall_vtk_components INCLUDE REGEX "^VTK::")
list(TRANSFORM hexwall_vtk_components REPLACE "^VTK::" "")
list(REMOVE_DUPLICATES hexwall_vtk_components)
list(JOIN hexwall_vtk_components " " hexwall_vtk_components)
configure_package_config_file(${CMAKE_CURRENT_LIST_DIR}/hexwallConfig.cmake.in
  ${CMAKE_BINARY_DIR}/hexwallConfig.cmake INSTALL_DESTINATION ${hexwall_cmake_dir})
write_basic_package_version_file(${CMAKE_BINARY_DIR}/hexwallConfigVersion.cmake
  COMPATIBILITY SameMinorVersion)
install(FILES ${CMAKE_BINARY_DIR}/hexwallConfig.cmake ${CMAKE_BINARY_DIR}/hexwallConfigVersion.cmake
  DESTINATION ${hexwall_cmake_dir} COMPONENT library)

install(TARGETS hexwall hexwall-picture
  RUNTIME DESTINATION ${CMAKE_INSTALL_BINDIR} COMPONENT program)

# Manual pages and completion are what the programs say of themselves.
set(pages ${CMAKE_BINARY_DIR}/pages)
add_custom_command(OUTPUT ${pages}/made
  COMMAND ${CMAKE_COMMAND} -E rm -rf ${pages}
  COMMAND ${CMAKE_COMMAND} -E make_directory ${pages}/man ${pages}/bash
  COMMAND hexwall reference man ${pages}/man
  COMMAND hexwall-picture --reference-man > ${pages}/man/hexwall-picture.1
  COMMAND hexwall reference bash > ${pages}/bash/hexwall
  COMMAND hexwall-picture --reference-bash > ${pages}/bash/hexwall-picture
  COMMAND sh -c "gzip -9 -n ${pages}/man/*.1"
  COMMAND ${CMAKE_COMMAND} -E touch ${pages}/made
  DEPENDS hexwall hexwall-picture
  VERBATIM)
add_custom_target(hexwall_pages ALL DEPENDS ${pages}/made)
install(DIRECTORY ${pages}/man/ DESTINATION ${CMAKE_INSTALL_MANDIR}/man1 COMPONENT program)
install(DIRECTORY ${pages}/bash/ DESTINATION ${CMAKE_INSTALL_DATADIR}/bash-completion/completions
  COMPONENT program)
install(FILES README.md CHANGELOG.md DESTINATION ${CMAKE_INSTALL_DOCDIR} COMPONENT program)
install(FILES LICENSE DESTINATION ${CMAKE_INSTALL_DOCDIR} RENAME copyright COMPONENT program)
install(DIRECTORY tools/cohort DESTINATION ${CMAKE_INSTALL_DATADIR}/hexwall COMPONENT program
  USE_SOURCE_PERMISSIONS PATTERN __pycache__ EXCLUDE)

if(HEXWALL_PYTHON)
  # Where Debian's Python looks; elsewhere PREFIX/lib/python3/dist-packages goes into PYTHONPATH.
  set(python_dir lib/python3/dist-packages/hexwall)
  install(TARGETS hexwall_python LIBRARY DESTINATION ${python_dir} COMPONENT python)
  install(DIRECTORY tools/python/hexwall/ DESTINATION ${python_dir} COMPONENT python
    FILES_MATCHING PATTERN "*.py" PATTERN "*.pyi" PATTERN py.typed PATTERN __pycache__ EXCLUDE)
  install(DIRECTORY tools/python/examples DESTINATION ${CMAKE_INSTALL_DOCDIR} COMPONENT python
    FILES_MATCHING PATTERN "*.py" PATTERN __pycache__ EXCLUDE)
endif()
