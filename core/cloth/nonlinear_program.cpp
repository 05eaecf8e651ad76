#include "core/cloth/nonlinear_program.hpp"

#include <IpIpoptApplication.hpp>

#include "core/base/error.hpp"
#include "core/base/stopwatch.hpp"
#include "core/cloth/projection_program.hpp"
#include "core/solvers/cone_certificate.hpp"

namespace pliant::cloth {

namespace {

class NonlinearProgramLimiter final : public StrainLimiter {
 public:
  explicit NonlinearProgramLimiter(const solvers::ConeConstraints& constraints) : constraints_(constraints) {}

  std::string_view name() const override { return "nonlinear_program"; }

  solvers::ConeSolution project(const Eigen::Matrix3Xd& candidate, const Eigen::Matrix3Xd& start,
                                base::ExecutionContext& context) override {
    for (const Eigen::Matrix3Xd* positions : {&candidate, &start})
      if (positions->cols() != constraints_.nodeCount || !positions->allFinite())
        throw base::InputError("", "A projection needs a finite position for each of its " +
                                       std::to_string(constraints_.nodeCount) + " nodes.");
    const base::Stopwatch stopwatch;
    solvers::ConeSolution solution;
    const Ipopt::SmartPtr<ProjectionProgram> program = new ProjectionProgram(constraints_, candidate, start, context);
    const Ipopt::SmartPtr<Ipopt::IpoptApplication> application = IpoptApplicationFactory();
    application->Options()->SetIntegerValue("print_level", 0);
    application->Options()->SetStringValue("sb", "yes");
    // Without a name it would read options from a file where the program happens to run.
    if (application->Initialize("") != Ipopt::Solve_Succeeded)
      throw base::InputError("", "Ipopt could not be started.");
    application->OptimizeTNLP(program);
    solution.positions = program->positions();
    solution.report.iterations = program->iterations;
    solution.report.termination = program->termination;
    solution.report.message = program->message;
    solution.report.seconds = stopwatch.seconds();
    program->multipliers(solution);
    solvers::certify(constraints_, candidate, solution);
    return solution;
  }

 private:
  const solvers::ConeConstraints constraints_;
};

}  // namespace

std::unique_ptr<StrainLimiter> makeNonlinearProgramLimiter(const solvers::ConeConstraints& constraints,
                                                           const ProjectionOptions& options) {
  static_cast<void>(options);  // Ipopt keeps its defaults, as in the thesis
  return std::make_unique<NonlinearProgramLimiter>(constraints);
}

}  // namespace pliant::cloth
