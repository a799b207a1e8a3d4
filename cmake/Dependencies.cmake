# Where the packages come from: Debian's own, found once here.
set(THREADS_PREFER_PTHREAD_FLAG ON)
find_package(Threads REQUIRED)
find_package(Eigen3 3.4 REQUIRED NO_MODULE)
find_package(TBB REQUIRED)
find_package(OpenMP REQUIRED)
find_package(fmt REQUIRED)
find_package(CGAL REQUIRED)
find_package(fcl 0.7 REQUIRED)
find_package(nlohmann_json REQUIRED)
# Files by all; scenes by billet-render alone, which is left out where these are not found.
set(vtk_files CommonCore CommonDataModel IOXML IOXMLParser)
set(vtk_scenes)
if(BILLET_RENDER)
  set(vtk_scenes CommonColor FiltersCore FiltersGeometry IOImage InteractionStyle RenderingAnnotation RenderingCore
                 RenderingFreeType RenderingOpenGL2)
endif()
find_package(VTK 9.1 REQUIRED COMPONENTS ${vtk_files} OPTIONAL_COMPONENTS ${vtk_scenes})
list(TRANSFORM vtk_files PREPEND VTK::)
list(TRANSFORM vtk_scenes PREPEND VTK::)

find_library(CHOLMOD_LIBRARY cholmod REQUIRED)
find_library(UMFPACK_LIBRARY umfpack REQUIRED)
find_library(DMUMPS_LIBRARY dmumps_seq REQUIRED)
find_library(SMUMPS_LIBRARY smumps_seq REQUIRED)
find_library(METIS_LIBRARY metis REQUIRED)
find_library(OPENBLAS_LIBRARY openblas REQUIRED)
find_path(SUITESPARSE_INCLUDE cholmod.h PATH_SUFFIXES suitesparse REQUIRED)
find_path(MUMPS_INCLUDE mumps_seq/mpi.h REQUIRED)

add_library(billet_sparse INTERFACE)
target_include_directories(billet_sparse SYSTEM INTERFACE ${SUITESPARSE_INCLUDE} ${MUMPS_INCLUDE}/mumps_seq)
target_link_libraries(billet_sparse INTERFACE ${CHOLMOD_LIBRARY} ${UMFPACK_LIBRARY} ${DMUMPS_LIBRARY} ${SMUMPS_LIBRARY}
                                              ${METIS_LIBRARY} ${OPENBLAS_LIBRARY})
