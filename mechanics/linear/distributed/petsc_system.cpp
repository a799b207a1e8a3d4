#include "mechanics/linear/distributed/petsc_system.h"

#include <cmath>

namespace billet::mechanics {

namespace {

constexpr PetscErrorCode good = 0;

/// A solution under way.
struct Watched {
  DistributedSolve* request;
  double scale; ///< the residual at its beginning
};

/// Gives up where residuals that shrink as they have will not do in as many iterations as may be.
PetscErrorCode
test(KSP, PetscInt k, PetscReal residual, KSPConvergedReason* reason, void* context) {
  constexpr PetscInt first_look = 3;
  auto& [request, scale] = *static_cast<Watched*>(context);
  if (k == 0)
    scale = residual;
  const double left = scale > 0.0 ? residual / scale : 0.0;
  request->iterations = static_cast<int>(k);
  request->residual = left;
  *reason = KSP_CONVERGED_ITERATING;
  if (!std::isfinite(left))
    *reason = KSP_DIVERGED_NANORINF;
  else if (left <= request->tolerance)
    *reason = KSP_CONVERGED_RTOL;
  else if (k >= request->most ||
           (k >= first_look && k * std::log(request->tolerance) < request->most * std::log(left)))
    *reason = KSP_DIVERGED_ITS;
  return good;
}

DistributedSystem& of(void* context) { return *static_cast<DistributedSystem*>(context); }

} // namespace

DistributedSystem::~DistributedSystem() {
  static_cast<void>(KSPDestroy(&gmres_));
  static_cast<void>(MatDestroy(&weighed_));
  preconditioner_.clear();
  static_cast<void>(MatDestroy(&matrix_));
  for (Vec* vector : {&weights_, &work_, &rhs_, &x_})
    static_cast<void>(VecDestroy(vector));
}

PetscErrorCode DistributedSystem::make(const DistributedPattern* pattern) {
  PetscCall(rows_.receive(pattern, &matrix_));
  PetscCall(MatCreateVecs(matrix_, &x_, &rhs_));
  PetscCall(VecDuplicate(x_, &weights_));
  PetscCall(VecDuplicate(x_, &work_));
  PetscInt n = 0, all = 0;
  PetscCall(MatGetLocalSize(matrix_, &n, nullptr));
  PetscCall(MatGetSize(matrix_, &all, nullptr));
  PetscCall(MatCreateShell(PETSC_COMM_WORLD, n, n, all, all, this, &weighed_));
  PetscCall(MatShellSetOperation(weighed_, MATOP_MULT, reinterpret_cast<void (*)()>(&multiply)));
  return make_gmres();
}

PetscErrorCode DistributedSystem::make_gmres() {
  PetscCall(KSPCreate(PETSC_COMM_WORLD, &gmres_));
  PetscCall(KSPSetType(gmres_, KSPGMRES));
  PetscCall(KSPSetPCSide(gmres_, PC_RIGHT));
  constexpr PetscInt most_directions = 300;
  PetscCall(KSPGMRESSetRestart(gmres_, most_directions));
  PetscCall(KSPGMRESSetOrthogonalization(gmres_, KSPGMRESClassicalGramSchmidtOrthogonalization));
  PetscCall(KSPGMRESSetCGSRefinementType(gmres_, KSP_GMRES_CGS_REFINE_IFNEEDED));
  PetscCall(KSPSetOperators(gmres_, weighed_, weighed_));
  PC shell = nullptr;
  PetscCall(KSPGetPC(gmres_, &shell));
  PetscCall(PCSetType(shell, PCSHELL));
  PetscCall(PCShellSetContext(shell, this));
  PetscCall(PCShellSetApply(shell, &precondition));
  return good;
}

PetscErrorCode DistributedSystem::multiply(Mat shell, Vec x, Vec y) {
  void* context = nullptr;
  PetscCall(MatShellGetContext(shell, &context));
  PetscCall(MatMult(of(context).matrix_, x, y));
  PetscCall(VecPointwiseMult(y, y, of(context).weights_));
  return good;
}

PetscErrorCode DistributedSystem::precondition(PC shell, Vec x, Vec y) {
  void* context = nullptr;
  PetscCall(PCShellGetContext(shell, &context));
  const DistributedSystem& system = of(context);
  PetscCall(VecPointwiseDivide(system.work_, x, system.weights_));
  PetscCall(system.preconditioner_.apply(system.work_, y));
  return good;
}

PetscErrorCode DistributedSystem::set_up(DistributedSetUp& set_up) {
  if (set_up.method == distributed_multigrid)
    PetscCall(rows_.scatter(set_up.positions, work_));
  PetscCall(preconditioner_.set_up(set_up, matrix_, work_));
  return good;
}

PetscErrorCode DistributedSystem::solve(DistributedSolve& solve) {
  solve.converged = 0;
  PetscCall(rows_.scatter(solve.weights, weights_));
  PetscCall(rows_.scatter(solve.rhs, rhs_));
  PetscCall(VecPointwiseMult(rhs_, rhs_, weights_));
  Watched watched{&solve, 0.0};
  PetscCall(KSPSetConvergenceTest(gmres_, &test, &watched, nullptr));
  PetscCall(KSPSetTolerances(gmres_, PETSC_DEFAULT, PETSC_DEFAULT, PETSC_DEFAULT, solve.most + 1));
  PetscCall(KSPSolve(gmres_, rhs_, x_));
  KSPConvergedReason reason = KSP_CONVERGED_ITERATING;
  PetscCall(KSPGetConvergedReason(gmres_, &reason));
  solve.converged = reason > 0 ? 1 : 0;
  if (reason > 0)
    PetscCall(rows_.gather(x_, solve.x));
  return good;
}

} // namespace billet::mechanics
