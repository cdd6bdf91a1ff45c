# `cpack -G DEB`: one package with everything. What the programs and the Python module link to is
# found by dpkg-shlibdeps.
set(CPACK_GENERATOR DEB)
set(CPACK_PACKAGE_NAME hexwall)
set(CPACK_PACKAGE_CONTACT "The hexwall authors <hexwall@localhost>")
set(CPACK_PACKAGING_INSTALL_PREFIX /usr)
set(CPACK_STRIP_FILES ON)
set(CPACK_DEBIAN_FILE_NAME DEB-DEFAULT)
set(CPACK_DEBIAN_PACKAGE_SECTION science)
set(CPACK_DEBIAN_PACKAGE_SHLIBDEPS ON)
set(CPACK_PACKAGE_DESCRIPTION_SUMMARY ${PROJECT_DESCRIPTION})
set(CPACK_DEBIAN_PACKAGE_DESCRIPTION
"Turns the triangle surface of a vessel into quads with the fewest singularities, and
extrudes them into thin layers of hexahedra: the wall, near-wall layers in the lumen,
or both, for OpenFOAM, CalculiX, Abaqus, Gmsh, svMultiPhysics and ParaView.
.
Programs, a C++ library (static), a Python module and a Snakemake workflow for cohorts.")
set(CPACK_DEBIAN_PACKAGE_RECOMMENDS "xvfb, xauth, libgl1-mesa-dri, snakemake")
set(CPACK_DEBIAN_PACKAGE_SUGGESTS
  "cmake, libcgal-dev, libdeflate-dev, libeigen3-dev, libfmt-dev, libsuitesparse-dev, libtbb-dev, \
libtet1.5-dev, libvtk9-dev, nlohmann-json3-dev, paraview")
if(HEXWALL_PYTHON)
  # The module is made for one version of Python.
  math(EXPR next "${Python_VERSION_MINOR} + 1")
  set(CPACK_DEBIAN_PACKAGE_DEPENDS "python3 (>= 3.${Python_VERSION_MINOR}), \
python3 (<< 3.${next}), python3-numpy")
  set(CPACK_DEBIAN_PACKAGE_CONTROL_EXTRA ${CMAKE_CURRENT_LIST_DIR}/postinst
                                         ${CMAKE_CURRENT_LIST_DIR}/prerm)
  set(CPACK_DEBIAN_PACKAGE_CONTROL_STRICT_PERMISSION ON)
endif()
include(CPack)
