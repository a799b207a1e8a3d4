# billet_library(NAME uses...): one static library per folder, alias billet::NAME.
#
# Every .cpp and .h below the folder belongs to it; each header is compiled alone by the target
# all_verify_interface_header_sets. Some of the files make one compilation, except where CGAL's
# templates take the time: names of their unnamed namespaces must differ within a folder.
set(files_together 12)
function(billet_library name)
  file(GLOB_RECURSE sources CONFIGURE_DEPENDS ${CMAKE_CURRENT_SOURCE_DIR}/*.cpp)
  list(FILTER sources EXCLUDE REGEX "/(fcl|petsc)_") # of libraries of their own
  file(GLOB_RECURSE headers CONFIGURE_DEPENDS ${CMAKE_CURRENT_SOURCE_DIR}/*.h)
  list(FILTER headers EXCLUDE REGEX "/petsc_")
  add_library(billet_${name} STATIC ${sources})
  add_library(billet::${name} ALIAS billet_${name})
  target_sources(billet_${name} PUBLIC FILE_SET HEADERS BASE_DIRS ${PROJECT_SOURCE_DIR} FILES ${headers})
  set_target_properties(billet_${name} PROPERTIES VERIFY_INTERFACE_HEADER_SETS ON LINKER_LANGUAGE CXX)
  target_link_libraries(billet_${name} PUBLIC ${ARGN} PRIVATE billet_warnings)
  set_target_properties(billet_${name} PROPERTIES UNITY_BUILD ${BILLET_TOGETHER} UNITY_BUILD_BATCH_SIZE ${files_together})
  billet_precompile(billet_${name})
endfunction()

# billet_precompile(TARGET headers...): headers that nearly every source of the target includes, by
# way of others, are compiled once. They are a third of the time a file takes. Every source still
# includes what it needs: `./dev lint` compiles without.
function(billet_precompile target)
  target_precompile_headers(${target} PRIVATE <Eigen/Dense> <functional> <string> <vector> ${ARGN})
endfunction()
