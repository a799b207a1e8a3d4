// A fuzzer of one target, which the build names: libFuzzer brings main().

#include "tests/fuzz/targets.h"

#include <cstddef>
#include <cstdint>

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size);

int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  for (const billet::fuzz::Target& target : billet::fuzz::targets())
    if (target.name == BILLET_FUZZ_TARGET)
      target.read({reinterpret_cast<const char*>(data), size});
  return 0;
}
