#include "core/harmonic/harmonic_balance_problem.hpp"

#include <algorithm>
#include <cmath>
#include <stdexcept>

#include "core/base/error.hpp"
#include "core/base/stopwatch.hpp"
#include "core/harmonic/harmonic_jacobian.hpp"
#include "core/harmonic/steady_drive.hpp"

namespace pliant::harmonic {

namespace {

/// The columns of the mass matrix that belong to free coordinates: coordinates x nFree.
SparseMatrix freeColumns(const Model& model, const SparseMatrix& matrix) {
  SparseMatrix columns(matrix.rows(), model.dofs.freeCount());
  std::vector<Eigen::Triplet<double>> entries;
  for (int f = 0; f < model.dofs.freeCount(); ++f)
    for (SparseMatrix::InnerIterator it(matrix, model.dofs.freeCoordinates[f]); it; ++it)
      entries.emplace_back(it.row(), f, it.value());
  columns.setFromTriplets(entries.begin(), entries.end());
  return columns;
}

SparseMatrix freeRows(const Model& model, const SparseMatrix& columns) {
  SparseMatrix square(model.dofs.freeCount(), columns.cols());
  std::vector<Eigen::Triplet<double>> entries;
  for (int f = 0; f < columns.cols(); ++f)
    for (SparseMatrix::InnerIterator it(columns, f); it; ++it)
      if (const int row = model.dofs.freeIndex[it.row()]; row >= 0) entries.emplace_back(row, f, it.value());
  square.setFromTriplets(entries.begin(), entries.end());
  return square;
}

/// f̂ over the free coordinates with the oscillating part scaled.
Matrix scaledLoads(const Matrix& coefficients, double fraction) {
  Matrix scaled = fraction * coefficients;
  scaled.row(0) = coefficients.row(0);
  return scaled;
}

/// ∇²E at each configuration (a row of `x`) times the same row of `direction`, over all coordinates.
Matrix stiffnessTimes(const Model& model, const Matrix& x, const Matrix& direction) {
  Model unbound = model;
  unbound.drives.clear();
  unbound.lockedCoordinates.clear();
  unbound.finish();
  const mechanics::ElasticAssembler assembler(std::make_shared<const Model>(std::move(unbound)));
  Matrix padded(mechanics::ElasticAssembler::paddedRows(static_cast<int>(x.rows())), x.cols()), gradient, hessian;
  padded.topRows(x.rows()) = x;
  padded.bottomRows(padded.rows() - x.rows()).rowwise() = x.row(0);
  assembler.evaluate(padded, gradient, &hessian);
  Matrix product = Matrix::Zero(x.rows(), x.cols());
  for (int e = 0; e < assembler.entryCount(); ++e) {
    const int row = assembler.rows()[e], column = assembler.columns()[e];
    const auto stiffness = hessian.col(e).head(x.rows()).array();
    product.col(row).array() += stiffness * direction.col(column).array();
    if (row != column) product.col(column).array() += stiffness * direction.col(row).array();
  }
  return product;
}

void requireSecondFrequency(const Model& model, const math::HarmonicBasis& basis) {
  if (model.hasSecondFrequency() && !basis.hasTwoFrequencies())
    throw base::InputError("",
                           "A drive or load has a term of the second frequency, but a motion with one frequency is "
                           "sought.");
}

}  // namespace

/// What never changes; shared by copies.
struct HarmonicBalanceProblem::Structure {
  std::shared_ptr<const Model> model;
  math::HarmonicBasis basis;
  int drivePeriods;
  mechanics::ElasticAssembler assembler;
  SparseMatrix massToFree;  ///< coordinates x nFree
  SparseMatrix freeMass;
  std::vector<int> coordinateHarmonics;
  std::vector<Eigen::Index> unknowns;  ///< where they are in z; empty if all coefficients are
  HarmonicJacobian jacobian;
  Matrix synthesis;  ///< Γ, its first row repeated up to whole packets

  Vector steadyConfiguration;
  std::vector<int> drivenCoordinates;
  std::vector<double> steadySignals;  ///< of each drive
  Matrix swing;                       ///< swingAt(1)
  Matrix swingCoefficients;           ///< (2H+1) x driven
  Vector steadyForce;
  Matrix loadCoefficients;  ///< f̂ of the free coordinates with all of the drive, (2H+1) x nFree
  double inertiaScale = 0;  ///< a ‖m‖ of forceScale [kg m]

  Structure(std::shared_ptr<const Model> model_, const math::HarmonicBasis& basis_, int drivePeriods_,
            std::vector<int> coordinateHarmonics_)
      : model(std::move(model_)),
        basis(basis_),
        drivePeriods(basis.hasTwoFrequencies() ? basis.periods() : drivePeriods_),
        assembler(model),
        massToFree(freeColumns(*model, model->massMatrix())),
        freeMass(freeRows(*model, massToFree)),
        coordinateHarmonics(std::move(coordinateHarmonics_)),
        unknowns(findUnknowns()),
        jacobian(basis, assembler, freeMass, coordinateHarmonics) {
    requireSecondFrequency(*model, basis);
    const int padded = mechanics::ElasticAssembler::paddedRows(basis.samples());
    synthesis.resize(padded, basis.size());
    for (int i = 0; i < padded; ++i) synthesis.row(i) = basis.synthesis().row(i < basis.samples() ? i : 0);
    sampleDrives(padded);
    sampleLoads();
  }

  std::vector<Eigen::Index> findUnknowns() {
    if (coordinateHarmonics.empty())
      coordinateHarmonics.assign(static_cast<std::size_t>(model->dofs.freeCount()), basis.harmonics());
    if (static_cast<int>(coordinateHarmonics.size()) != model->dofs.freeCount())
      throw std::invalid_argument("numbers of harmonics for other coordinates than the free ones");
    std::vector<Eigen::Index> found;
    for (std::size_t f = 0; f < coordinateHarmonics.size(); ++f) {
      if (coordinateHarmonics[f] < 0 || coordinateHarmonics[f] > basis.harmonics())
        throw std::invalid_argument("a coordinate with more harmonics than the basis");
      for (int i = 0; i <= 2 * coordinateHarmonics[f]; ++i)
        found.push_back(static_cast<Eigen::Index>(f) * basis.size() + i);
    }
    if (found.size() == coordinateHarmonics.size() * static_cast<std::size_t>(basis.size())) found.clear();
    return found;
  }

  /// Of the drive at a sample; those beyond the last one are as the first.
  math::Phases samplePhases(int sample) const {
    const math::Phases phases = basis.samplePhases(sample < basis.samples() ? sample : 0);
    return basis.hasTwoFrequencies() ? phases : math::Phases(drivePeriods * phases.first);
  }

  void sampleDrives(int padded) {
    steadyConfiguration = model->restPositions;
    for (const auto& drive : model->drives) {
      const std::vector<int>& driven = drive->coordinates();
      std::vector<math::Phases> instants;
      for (int i = 0; i < basis.samples(); ++i) instants.push_back(samplePhases(i));
      const int nearest = steadySample(*drive, model->restPositions(driven), instants);
      steadySignals.push_back(drive->signal()(samplePhases(nearest)));
      drivenCoordinates.insert(drivenCoordinates.end(), driven.begin(), driven.end());
      steadyConfiguration(driven) = drive->place(model->restPositions(driven), steadySignals.back());
    }
    swing = computeSwing(1, padded);
    swingCoefficients = basis.analysis() * swing.topRows(basis.samples());
    double largest = 0;
    for (Eigen::Index c = 0; c < swing.cols(); ++c)
      largest = std::max(largest, (swing.col(c).array() - swingCoefficients(0, c)).abs().maxCoeff());
    Vector masses(massToFree.cols());
    for (Eigen::Index f = 0; f < massToFree.cols(); ++f)
      masses[f] = massToFree.coeff(model->dofs.freeCoordinates[f], f);
    inertiaScale = largest * masses.norm();
  }

  /// A drive's coordinates at θ with `fraction` of its signal's swing, so that what turns as a whole stays whole.
  Vector drivenPlace(std::size_t drive, math::Phases phases, double fraction) const {
    const mechanics::PrescribedMotion& motion = *model->drives[drive];
    const double steady = steadySignals[drive];
    return motion.place(
        model->restPositions(motion.coordinates()), steady + fraction * (motion.signal()(phases) - steady));
  }

  /// Driven coordinates minus their steady place at the samples: padded N x driven [m].
  Matrix computeSwing(double fraction, Eigen::Index padded) const {
    Matrix result(padded, static_cast<Eigen::Index>(drivenCoordinates.size()));
    Eigen::Index column = 0;
    for (std::size_t drive = 0; drive < model->drives.size(); ++drive) {
      const std::vector<int>& driven = model->drives[drive]->coordinates();
      const auto count = static_cast<Eigen::Index>(driven.size());
      const Vector steady = steadyConfiguration(driven);
      for (Eigen::Index i = 0; i < padded; ++i)
        result.row(i).segment(column, count) =
            (drivenPlace(drive, samplePhases(static_cast<int>(i)), fraction) - steady).transpose();
      column += count;
    }
    return result;
  }
  Matrix swingAt(double fraction) const { return fraction == 1 ? swing : computeSwing(fraction, swing.rows()); }
  Matrix swingCoefficientsAt(double fraction) const {
    return fraction == 1 ? swingCoefficients : basis.analysis() * swingAt(fraction).topRows(basis.samples());
  }

  void sampleLoads() {
    Matrix forces(basis.samples(), model->coordinateCount());
    for (int i = 0; i < basis.samples(); ++i) forces.row(i) = model->externalForce(samplePhases(i)).transpose();
    steadyForce = forces.colwise().mean();
    loadCoefficients = basis.analysis() * forces(Eigen::all, model->dofs.freeCoordinates);
  }
};

/// What an evaluation fills; one of each per problem object.
struct HarmonicBalanceProblem::Workspace {
  Matrix positions;  ///< padded N x coordinates
  Matrix gradient;   ///< likewise
  Matrix hessian;    ///< padded N x entries
  Matrix hessianCoefficients;
  mechanics::ElasticAssembler::StressSource stresses;
  SolutionCost cost;
};

HarmonicBalanceProblem::HarmonicBalanceProblem(std::shared_ptr<const Model> model, math::HarmonicBasis basis,
                                               int drivePeriods, std::vector<int> coordinateHarmonics)
    : structure_(std::make_shared<Structure>(std::move(model), basis, drivePeriods, std::move(coordinateHarmonics))),
      workspace_(std::make_unique<Workspace>()) {}

HarmonicBalanceProblem::HarmonicBalanceProblem(const HarmonicBalanceProblem& other)
    : structure_(other.structure_), workspace_(std::make_unique<Workspace>()), driveFraction_(other.driveFraction_) {}

HarmonicBalanceProblem::HarmonicBalanceProblem(HarmonicBalanceProblem&&) noexcept = default;
HarmonicBalanceProblem::~HarmonicBalanceProblem() = default;

HarmonicBalanceProblem& HarmonicBalanceProblem::operator=(HarmonicBalanceProblem other) noexcept {
  std::swap(structure_, other.structure_);
  std::swap(workspace_, other.workspace_);
  std::swap(driveFraction_, other.driveFraction_);
  return *this;
}

const Model& HarmonicBalanceProblem::model() const { return *structure_->model; }
std::shared_ptr<const Model> HarmonicBalanceProblem::sharedModel() const { return structure_->model; }
const math::HarmonicBasis& HarmonicBalanceProblem::basis() const { return structure_->basis; }
const mechanics::ElasticAssembler& HarmonicBalanceProblem::assembler() const { return structure_->assembler; }
Eigen::Index HarmonicBalanceProblem::size() const {
  return static_cast<Eigen::Index>(basis().size()) * model().dofs.freeCount();
}
const std::vector<int>& HarmonicBalanceProblem::coordinateHarmonics() const { return structure_->coordinateHarmonics; }
Eigen::Index HarmonicBalanceProblem::unknownCount() const { return structure_->jacobian.size(); }
int HarmonicBalanceProblem::drivePeriods() const { return structure_->drivePeriods; }

math::Phases HarmonicBalanceProblem::phasesAt(double tau) const {
  const double first = drivePeriods() * tau;
  return {first, basis().ratio() * first};
}
math::Phases HarmonicBalanceProblem::samplePhases(int sample) const { return structure_->samplePhases(sample); }

HarmonicBalanceProblem HarmonicBalanceProblem::withDrivePeriods(int drivePeriods) const {
  if (basis().hasTwoFrequencies()) throw std::invalid_argument("motions with two frequencies have no period");
  const auto scaled = [&](int count) { return count * drivePeriods / structure_->drivePeriods; };
  std::vector<int> harmonics;
  for (const int count : structure_->coordinateHarmonics) harmonics.push_back(scaled(count));
  return {
      structure_->model, {scaled(basis().harmonics()), scaled(basis().samples())}, drivePeriods, std::move(harmonics)};
}

Matrix HarmonicBalanceProblem::restricted(const Matrix& x) const {
  return structure_->unknowns.empty() ? x : Matrix(x(structure_->unknowns, Eigen::all));
}

Matrix HarmonicBalanceProblem::expanded(const Matrix& x) const {
  if (structure_->unknowns.empty()) return x;
  Matrix all = Matrix::Zero(size(), x.cols());
  all(structure_->unknowns, Eigen::all) = x;
  return all;
}

Vector HarmonicBalanceProblem::withoutLeftOut(Vector z) const {
  if (!structure_->unknowns.empty())
    for (std::size_t f = 0; f < structure_->coordinateHarmonics.size(); ++f) {
      const Eigen::Index end = (static_cast<Eigen::Index>(f) + 1) * basis().size();
      const Eigen::Index count = 2 * (basis().harmonics() - structure_->coordinateHarmonics[f]);
      z.segment(end - count, count).setZero();
    }
  return z;
}

Vector HarmonicBalanceProblem::stretched(const Vector& z, int drivePeriods) const {
  const int factor = drivePeriods / structure_->drivePeriods;
  const Eigen::Map<const Matrix> coefficients(z.data(), basis().size(), model().dofs.freeCount());
  Matrix changed = Matrix::Zero(2 * factor * basis().harmonics() + 1, coefficients.cols());
  changed.row(0) = coefficients.row(0);
  for (int k = 1; k <= basis().harmonics(); ++k)
    changed.middleRows(2 * factor * k - 1, 2) = coefficients.middleRows(2 * k - 1, 2);
  return changed.reshaped();
}

const SparseMatrix& HarmonicBalanceProblem::freeMass() const { return structure_->freeMass; }
SolutionCost& HarmonicBalanceProblem::cost() const { return workspace_->cost; }

Vector HarmonicBalanceProblem::restCoefficients() const { return constantCoefficients(model().restPositions); }

double HarmonicBalanceProblem::forceScale(double omega) const {
  const double inertia = omega * omega * structure_->inertiaScale;
  const double scale = std::hypot(structure_->loadCoefficients.norm(), inertia);
  return scale > 0 ? scale : 1.0;
}

void HarmonicBalanceProblem::setDriveFraction(double fraction) { driveFraction_ = fraction; }

const Vector& HarmonicBalanceProblem::steadyConfiguration() const { return structure_->steadyConfiguration; }
const Vector& HarmonicBalanceProblem::steadyForce() const { return structure_->steadyForce; }

Vector HarmonicBalanceProblem::constantCoefficients(const Vector& configuration) const {
  Matrix coefficients = Matrix::Zero(basis().size(), model().dofs.freeCount());
  coefficients.row(0) = configuration(model().dofs.freeCoordinates).transpose();
  return coefficients.reshaped();
}

Vector HarmonicBalanceProblem::oscillation(const Vector& z) const {
  Vector swing = z;
  for (Eigen::Index i = 0; i < swing.size(); i += basis().size()) swing[i] = 0;
  return swing;
}

void HarmonicBalanceProblem::samplePositions(const Vector& z, double fraction, Matrix& positions) const {
  const Structure& s = *structure_;
  const Eigen::Map<const Matrix> coefficients(z.data(), s.basis.size(), s.model->dofs.freeCount());
  positions.resize(s.synthesis.rows(), s.model->coordinateCount());
  positions.rowwise() = s.steadyConfiguration.transpose();
  if (fraction == 1)
    positions(Eigen::all, s.drivenCoordinates) += s.swing;
  else
    positions(Eigen::all, s.drivenCoordinates) += s.computeSwing(fraction, s.swing.rows());
  positions(Eigen::all, s.model->dofs.freeCoordinates) = s.synthesis * coefficients;
}

void HarmonicBalanceProblem::evaluate(const Vector& z, bool withHessian, const StressSource* stresses) const {
  const Structure& s = *structure_;
  Workspace& w = *workspace_;
  const base::Stopwatch watch;
  samplePositions(z, driveFraction_, w.positions);
  if (stresses) {
    samplePositions(stresses->from, stresses->fromFraction, w.stresses.from);
    samplePositions(stresses->to, stresses->toFraction, w.stresses.to);
  }
  s.assembler.evaluate(w.positions, w.gradient, withHessian ? &w.hessian : nullptr, stresses ? &w.stresses : nullptr);
  ++w.cost.evaluations;
  w.cost.evaluationSeconds += watch.seconds();
}

/// Coefficients of M x over the free coordinates, driven ones included in x: (2H+1) x nFree. `massToFree` is
/// coordinates x nFree.
Matrix HarmonicBalanceProblem::inertialCoefficients(const Vector& z, const SparseMatrix& massToFree) const {
  const Structure& s = *structure_;
  Matrix all = Matrix::Zero(s.basis.size(), s.model->coordinateCount());
  all(Eigen::all, s.model->dofs.freeCoordinates) =
      Eigen::Map<const Matrix>(z.data(), s.basis.size(), s.model->dofs.freeCount());
  all(Eigen::all, s.drivenCoordinates) = s.swingCoefficientsAt(driveFraction_);
  return all * massToFree;
}

Vector HarmonicBalanceProblem::residual(const Vector& z, double omega) const {
  Vector h;
  linearize(z, omega, h, nullptr, nullptr);
  return h;
}

void HarmonicBalanceProblem::linearize(const Vector& z, double driveFrequency, Vector& h, SparseMatrix* jacobian,
                                       Vector* frequencyDerivative, const StressSource* stresses) const {
  const Structure& s = *structure_;
  const double omega = driveFrequency / s.drivePeriods;
  Workspace& w = *workspace_;
  const double massDamping = s.model->massDamping;
  const double stiffnessDamping = s.model->stiffnessDamping;
  evaluate(z, jacobian != nullptr, jacobian ? stresses : nullptr);

  const Matrix elastic =
      s.basis.analysis() * w.gradient.topRows(s.basis.samples())(Eigen::all, s.model->dofs.freeCoordinates);
  const Matrix inertial = inertialCoefficients(z, s.massToFree);
  const Matrix elasticRate = s.basis.derivative(elastic);
  const Matrix velocity = s.basis.derivative(inertial);
  const Matrix acceleration = s.basis.secondDerivative(inertial);
  h = withoutLeftOut((omega * omega * acceleration + massDamping * omega * velocity + elastic +
                      stiffnessDamping * omega * elasticRate - scaledLoads(s.loadCoefficients, driveFraction_))
                         .reshaped());
  if (frequencyDerivative)
    *frequencyDerivative =
        withoutLeftOut((2 * omega * acceleration + massDamping * velocity + stiffnessDamping * elasticRate).reshaped() /
                       s.drivePeriods);
  if (jacobian) s.jacobian.assemble(w.hessian, omega, massDamping, stiffnessDamping, w.hessianCoefficients, *jacobian);
}

Vector HarmonicBalanceProblem::parameterDerivative(const Vector& z, double driveFrequency,
                                                   const mechanics::DesignParameter& parameter) const {
  return parameterDerivative(z, driveFrequency, *parameter.derivative(model()));
}

Vector HarmonicBalanceProblem::parameterDerivative(const Vector& z, double driveFrequency,
                                                   const mechanics::ModelDerivative& change) const {
  const Structure& s = *structure_;
  const double omega = driveFrequency / s.drivePeriods;
  const Model& m = *s.model;
  const int samples = s.basis.samples();
  samplePositions(z, driveFraction_, workspace_->positions);
  const Matrix positions = workspace_->positions.topRows(samples);
  Matrix loads(samples, m.coordinateCount()), moved(samples, m.coordinateCount());
  for (int i = 0; i < samples; ++i) {
    loads.row(i) = change.externalForce(s.samplePhases(i)).transpose();
    moved.row(i) = change.prescribed(s.samplePhases(i)).transpose();
  }
  Matrix gradients = change.gradient(positions);
  Matrix inertial = inertialCoefficients(z, freeColumns(m, change.mass()));
  if (!moved.isZero(0)) {
    gradients += stiffnessTimes(m, positions, moved);
    inertial += s.basis.analysis() * moved * s.massToFree;
  }
  const Matrix elastic = s.basis.analysis() * gradients(Eigen::all, m.dofs.freeCoordinates);
  Matrix derivative = omega * omega * s.basis.secondDerivative(inertial) +
                      m.massDamping * omega * s.basis.derivative(inertial) + elastic +
                      m.stiffnessDamping * omega * s.basis.derivative(elastic) -
                      scaledLoads(s.basis.analysis() * loads(Eigen::all, m.dofs.freeCoordinates), driveFraction_);
  if (const double rate = change.massDamping(); rate != 0)
    derivative += rate * omega * s.basis.derivative(inertialCoefficients(z, s.massToFree));
  if (const double rate = change.stiffnessDamping(); rate != 0) {
    evaluate(z, false);
    const Matrix forces = workspace_->gradient.topRows(samples)(Eigen::all, m.dofs.freeCoordinates);
    derivative += rate * omega * s.basis.derivative(s.basis.analysis() * forces);
  }
  if (const double rate = change.driveFrequency(); rate != 0) {
    Vector h, byFrequency;
    linearize(z, driveFrequency, h, nullptr, &byFrequency);
    derivative.reshaped() += rate * byFrequency;
  }
  return withoutLeftOut(derivative.reshaped());
}

Matrix HarmonicBalanceProblem::trajectories(const Vector& z) const {
  const Structure& s = *structure_;
  const int samples = s.basis.samples();
  Matrix positions = s.steadyConfiguration.transpose().replicate(samples, 1);
  positions(Eigen::all, s.drivenCoordinates) += s.swingAt(driveFraction_).topRows(samples);
  positions(Eigen::all, s.model->dofs.freeCoordinates) =
      s.basis.synthesis() * Eigen::Map<const Matrix>(z.data(), s.basis.size(), s.model->dofs.freeCount());
  return positions;
}

Matrix HarmonicBalanceProblem::nodeTrajectory(const Vector& z, int node) const {
  const Structure& s = *structure_;
  const int d = s.model->dimension;
  Matrix positions(s.basis.samples(), d);
  for (int axis = 0; axis < d; ++axis) {
    const int coordinate = node * d + axis;
    if (const int f = s.model->dofs.freeIndex[coordinate]; f >= 0) {
      positions.col(axis) =
          s.basis.synthesis() * z.segment(static_cast<Eigen::Index>(f) * s.basis.size(), s.basis.size());
    } else {
      positions.col(axis).setConstant(s.steadyConfiguration[coordinate]);
      const auto found = std::find(s.drivenCoordinates.begin(), s.drivenCoordinates.end(), coordinate);
      if (found != s.drivenCoordinates.end())
        positions.col(axis) +=
            s.swingAt(driveFraction_).col(found - s.drivenCoordinates.begin()).head(s.basis.samples());
    }
  }
  return positions;
}

Vector HarmonicBalanceProblem::configurationAt(const Vector& z, double tau) const {
  const Structure& s = *structure_;
  const Eigen::Map<const Matrix> coefficients(z.data(), s.basis.size(), s.model->dofs.freeCount());
  const Vector free = coefficients.transpose() * s.basis.valuesAt(tau);
  Vector positions = s.model->configuration(free, phasesAt(tau));
  for (std::size_t drive = 0; driveFraction_ != 1 && drive < s.model->drives.size(); ++drive)
    positions(s.model->drives[drive]->coordinates()) = s.drivenPlace(drive, phasesAt(tau), driveFraction_);
  return positions;
}

Vector HarmonicBalanceProblem::changeHarmonics(const Vector& z, int fromHarmonics, int toHarmonics) {
  const int from = 2 * fromHarmonics + 1;
  const int to = 2 * toHarmonics + 1;
  const Eigen::Map<const Matrix> coefficients(z.data(), from, z.size() / from);
  Matrix changed = Matrix::Zero(to, coefficients.cols());
  const int kept = std::min(from, to);
  changed.topRows(kept) = coefficients.topRows(kept);
  return changed.reshaped();
}

}  // namespace pliant::harmonic
