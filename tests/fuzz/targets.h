// What is done with a file that nobody vouches for: one function for each format that is read.
//
// The outcome must be a result or an `Error`. Anything else (another exception, a fault, a result
// that contradicts itself) ends the process, which is how a fuzzer learns of it. The fuzzers call
// these with bytes they make up (./dev fuzz), corpus_test.cpp with those in corpus/.

#pragma once

#include <span>
#include <string_view>

namespace billet::fuzz {

struct Target {
  std::string_view name;
  std::string_view corpus;              ///< folder of its inputs in tests/fuzz/corpus/
  void (*read)(std::string_view bytes); ///< the content of a file
};

[[nodiscard]] std::span<const Target> targets();

} // namespace billet::fuzz
