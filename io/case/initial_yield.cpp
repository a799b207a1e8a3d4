#include "io/case/initial_yield.h"

#include <cmath>
#include <variant>

namespace billet::io {

namespace {

double yield_of(const PerfectFlow& law) { return law.yield; }
double yield_of(const LinearFlow& law) { return law.yield; }
double yield_of(const SwiftFlow& law) { return law.K * std::pow(law.eps0, law.n); }
double yield_of(const LudwikFlow& law) { return law.yield; }
double yield_of(const VoceFlow& law) { return law.yield; }
double yield_of(const TableFlow& law) {
  return law.points.empty() ? 0.0 : law.points.front().second;
}
double yield_of(const NortonHoffFlow& law) { return law.yield; }
double yield_of(const PerzynaFlow& law) {
  return std::visit([](const auto& base) { return yield_of(base); }, law.base);
}
// That of Johnson and Cook depends on the temperature of the case: check_whole.cpp.
double yield_of(const JohnsonCookFlow& /*law*/) { return 0.0; }
double yield_of(const HanselSpittelFlow& /*law*/) { return 0.0; }

} // namespace

double initial_yield(const FlowLaw& flow) {
  return std::visit([](const auto& law) { return yield_of(law); }, flow);
}

} // namespace billet::io
