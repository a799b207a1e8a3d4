# billet_warnings: the flags every target of ours is compiled with.
# (-Wrestrict is off: g++ 12 sees overlaps in its own std::string where there are none; so are
# -Wuninitialized and -Wmaybe-uninitialized below. Clang knows only the first of these two.)
add_library(billet_warnings INTERFACE)
target_compile_options(
  billet_warnings
  INTERFACE -Wall -Wextra -Wpedantic -Wshadow -Wconversion -Wold-style-cast -Wnon-virtual-dtor
            -Woverloaded-virtual $<$<CXX_COMPILER_ID:GNU>:-Wno-restrict>
            $<$<NOT:$<BOOL:${BILLET_RELAXED}>>:-Werror>)
# Contraction to fused multiply-adds may differ between two expressions of one formula; the code
# relies on neither, but results must not change with the inlining the compiler chooses.
target_compile_options(billet_warnings INTERFACE -fno-math-errno $<IF:$<BOOL:${BILLET_CONTRACT}>,-ffp-contract=fast,-ffp-contract=off>)
# The library and the program share their objects, which are therefore position-independent. That no
# function of ours is replaced by another of its name lets the compiler inline it all the same.
target_compile_options(billet_warnings INTERFACE -fno-semantic-interposition)
if(BILLET_NATIVE)
  # g++ 12 warns of uninitialized variables in its own AVX-512 intrinsics.
  target_compile_options(billet_warnings INTERFACE -march=native
                         $<$<CXX_COMPILER_ID:GNU>:-Wno-uninitialized -Wno-maybe-uninitialized>)
elseif(BILLET_LEVEL)
  target_compile_options(billet_warnings INTERFACE -march=${BILLET_LEVEL})
elseif(CMAKE_CXX_FLAGS MATCHES "fsanitize")
  # ... and, with sanitizers, of the strings in its own std::variant.
  target_compile_options(billet_warnings
                         INTERFACE $<$<CXX_COMPILER_ID:GNU>:-Wno-maybe-uninitialized>)
endif()
