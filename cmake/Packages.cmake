# Debian packages, by `./dev package`: one for each component of the installation.
#
# program      billet              programs, library, documentation, cases
# development  libbillet-dev       headers and CMake's files for programs of others
# multigrid    billet-multigrid    multigrid and billet-mpi, which need PETSc
# python       python3-billet      the Python package
set(CPACK_GENERATOR DEB)
set(CPACK_PACKAGE_NAME billet)
set(CPACK_PACKAGE_DESCRIPTION_SUMMARY "") # CPack would place it before that of each package
set(CPACK_PACKAGE_VENDOR "The billet authors")
set(CPACK_PACKAGE_CONTACT "The billet authors")
set(CPACK_PACKAGE_DIRECTORY ${PROJECT_BINARY_DIR}/packages)
set(CPACK_PACKAGING_INSTALL_PREFIX /usr)
set(CPACK_COMPONENTS_ALL program development)
foreach(optional multigrid python)
  string(TOUPPER ${optional} option)
  if(BILLET_${option})
    list(APPEND CPACK_COMPONENTS_ALL ${optional})
  endif()
endforeach()
set(CPACK_STRIP_FILES ON)

set(CPACK_DEB_COMPONENT_INSTALL ON)
set(CPACK_DEBIAN_FILE_NAME DEB-DEFAULT)
set(CPACK_DEBIAN_PACKAGE_SECTION science)
set(CPACK_DEBIAN_PACKAGE_SHLIBDEPS ON)
set(CPACK_DEBIAN_PACKAGE_SHLIBDEPS_PRIVATE_DIRS ${CMAKE_RUNTIME_OUTPUT_DIRECTORY} ${PROJECT_BINARY_DIR}/billet)
set(CPACK_DEBIAN_PACKAGE_GENERATE_SHLIBS ON)

# billet_package(COMPONENT NAME DEPENDS RECOMMENDS SUGGESTS SUMMARY TEXT): the fields of one package,
# in addition to the libraries that its programs are linked with. The text's paragraphs are indented by CPack.
macro(billet_package component name depends recommends suggests summary text)
  string(TOUPPER ${component} COMPONENT)
  set(CPACK_DEBIAN_${COMPONENT}_PACKAGE_NAME ${name})
  set(CPACK_DEBIAN_${COMPONENT}_PACKAGE_DEPENDS "${depends}")
  set(CPACK_DEBIAN_${COMPONENT}_PACKAGE_RECOMMENDS "${recommends}")
  set(CPACK_DEBIAN_${COMPONENT}_PACKAGE_SUGGESTS "${suggests}")
  set(CPACK_DEBIAN_${COMPONENT}_DESCRIPTION "${summary}\n${text}")
  install(FILES ${PROJECT_SOURCE_DIR}/share/debian/copyright DESTINATION ${CMAKE_INSTALL_DATADIR}/doc/${name}
          COMPONENT ${component} EXCLUDE_FROM_ALL)
endmacro()

set(same "billet (= ${PROJECT_VERSION})")
billet_package(
  program billet "xvfb, libgl1-mesa-dri" "" "billet-multigrid, python3-billet, ffmpeg, paraview"
  "implicit simulation of metal forming"
  "Finite elements at large plastic strain with rigid tools, contact and friction, in plane strain, \
axisymmetry and 3D, for forging, upsetting, extrusion, drawing, rolling and coining. Tools are STL or \
STEP files or analytic surfaces; parts are remeshed as they distort; results open in ParaView, and in \
any browser as a report.")
billet_package(
  development libbillet-dev "${same}" "" "cmake"
  "implicit simulation of metal forming (for C++ programs)"
  "Headers of libbillet.so and what find_package(billet) of CMake reads.")
billet_package(
  multigrid billet-multigrid "${same}" "openmpi-bin" ""
  "implicit simulation of metal forming (large parts)"
  "Multigrid for parts of many unknowns, and billet-mpi, which runs in several processes, by PETSc.")
billet_package(
  python python3-billet "${same}, python3, python3-numpy" "python3-matplotlib" "python3-pandas, python3-vtk9, python3-meshio"
  "implicit simulation of metal forming (Python)"
  "Cases as dictionaries, runs increment by increment, fields as NumPy arrays, results, studies and charts.")

set(CPACK_DEBIAN_PYTHON_PACKAGE_CONTROL_EXTRA ${PROJECT_SOURCE_DIR}/share/debian/postinst
    ${PROJECT_SOURCE_DIR}/share/debian/prerm)

# The same, faster, for processors of level x86-64-v3 (app/processor.h): programs go on as theirs, the
# loader of shared libraries takes the library from glibc-hwcaps.
if(BILLET_FASTER)
  install(PROGRAMS ${BILLET_FASTER}/bin/billet DESTINATION lib/billet/x86-64-v3)
  install(FILES ${BILLET_FASTER}/billet/libbillet.so.${PROJECT_VERSION} RENAME libbillet.so.${PROJECT_VERSION_MAJOR}
          DESTINATION ${CMAKE_INSTALL_LIBDIR}/glibc-hwcaps/x86-64-v3)
  if(BILLET_MPI)
    install(PROGRAMS ${BILLET_FASTER}/bin/billet-mpi DESTINATION lib/billet/x86-64-v3 COMPONENT multigrid)
  endif()
endif()

include(CPack)
