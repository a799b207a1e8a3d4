// Rates of the kernels compared with those of the machine: matrix products and memory.
//
// Prints one line per kernel: what it is, the best rate of several passes, the unit. One thread.
// Theory  none.

#include "geometry/base/stopwatch.h"
#include "mechanics/bulk/bulk.h"
#include "mechanics/linear/blas.h"
#include "mechanics/mesh/mesh_generators.h"

#include <oneapi/tbb/global_control.h>

#include <algorithm>
#include <cstddef>
#include <cstdio>
#include <cstdlib>
#include <string>
#include <utility>
#include <vector>

extern "C" void dgemm_(const char*,
                       const char*,
                       const int*,
                       const int*,
                       const int*,
                       const double*,
                       const double*,
                       const int*,
                       const double*,
                       const int*,
                       const double*,
                       double*,
                       const int*);

namespace billet::bench {
namespace {

using mechanics::Analysis;
using mechanics::ElementKind;

/// Shortest time of several passes of `work` [s].
template <class Work> double fastest(int passes, Work work) {
  double best = HUGE_VAL;
  for (int i = 0; i < passes; ++i) {
    const double begun = seconds_now();
    work();
    best = std::min(best, seconds_now() - begun);
  }
  return best;
}

void print(const std::string& what, double rate, const char* unit) {
  std::printf("%-44s %12.4g %s\n", what.c_str(), rate, unit);
  std::fflush(stdout);
}

void matrix_products() {
  constexpr int n = 1500;
  constexpr auto size = static_cast<std::size_t>(n) * n;
  std::vector<double> a(size, 1.0);
  std::vector<double> b(size, 0.5);
  std::vector<double> c(size, 0.0);
  constexpr double one = 1.0;
  constexpr double none = 0.0;
  const double time = fastest(5, [&] {
    dgemm_("N", "N", &n, &n, &n, &one, a.data(), &n, b.data(), &n, &none, c.data(), &n);
  });
  print("matrix product, n = 1500", 2e-9 * n * n * n / time, "GFLOP/s");
}

void memory() {
  constexpr std::size_t n = 20'000'000;
  std::vector<double> a(n, 1.0);
  std::vector<double> b(n, 2.0);
  std::vector<double> c(n, 0.0);
  const double time = fastest(5, [&] {
    for (std::size_t i = 0; i < n; ++i)
      c[i] = a[i] + 3.0 * b[i];
  });
  print("memory, triad", 24e-9 * static_cast<double>(n) / time, "GB/s");
}

/// Assembly with tangent of a block in plastic compression.
void assembly(ElementKind kind, Analysis analysis, int cells, bool plastic) {
  const bool solid = analysis == Analysis::solid;
  const Vec3 far(10, 10, solid ? 10 : 0);
  const mechanics::Mesh mesh =
      mechanics::box_mesh({kind, Vec3::Zero(), far, {cells, cells, solid ? cells : 1}, {1, 1, 1}});
  const mechanics::BlockPattern pattern = mechanics::block_pattern(mesh);
  mechanics::Material metal{{210e3, 0.3}, mechanics::Swift{740.0, 0.01, 0.2}};
  mechanics::Bulk bulk(mesh, analysis, metal, pattern);
  mechanics::System system{{&pattern, std::vector<double>(pattern.n_entries())},
                           std::vector<double>(static_cast<std::size_t>(pattern.n_dofs()))};
  const int dim = mesh.dimension();
  std::vector<double> x_old;
  for (const Vec3& p : mesh.points)
    x_old.insert(x_old.end(), p.data(), p.data() + dim);
  std::vector<double> x = x_old;
  const double strain = plastic ? 0.02 : 1e-4;
  for (std::size_t i = 0; i < x.size(); ++i)
    x[i] *= i % static_cast<std::size_t>(dim) == 1 ? 1.0 - strain : 1.0 + 0.4 * strain;
  const mechanics::Trial trial{0.0, 1.0, x_old, x};
  bool good = true;
  const double time = fastest(5, [&] {
    system.clear();
    good = good && static_cast<bool>(bulk.assemble(trial, system));
  });
  if (!good) {
    std::fprintf(stderr, "assembly failed\n");
    std::exit(1);
  }
  const auto points = static_cast<double>(bulk.states().size());
  const std::string name(mechanics::name(kind));
  const char* where = analysis == Analysis::axisymmetric ? "axisymmetric"
                      : solid                            ? "3D"
                                                         : "plane strain";
  print("assembly, " + name + " " + where + (plastic ? ", plastic" : ", elastic"),
        points / time * 1e-6, "million points/s");
}

} // namespace
} // namespace billet::bench

int main(int argc, char**) {
  using namespace billet;
  using mechanics::Analysis;
  using mechanics::ElementKind;
  mechanics::set_blas_threads(1);
  const oneapi::tbb::global_control one(oneapi::tbb::global_control::max_allowed_parallelism, 1);
  std::printf("BLAS kernels %s\n", mechanics::blas_core().c_str());
  bench::matrix_products();
  if (argc > 1) // --product
    return 0;
  bench::memory();
  for (const bool plastic : {true, false}) {
    bench::assembly(ElementKind::quad4, Analysis::axisymmetric, 100, plastic);
    bench::assembly(ElementKind::quad8, Analysis::axisymmetric, 100, plastic);
    bench::assembly(ElementKind::hex8, Analysis::solid, 22, plastic);
    bench::assembly(ElementKind::hex20, Analysis::solid, 14, plastic);
    bench::assembly(ElementKind::tet10, Analysis::solid, 10, plastic);
  }
  return 0;
}
