#include "core/interlock/parameter_terms.hpp"

#include <Eigen/Dense>
#include <cmath>

#include "core/interlock/arc_places.hpp"
#include "core/interlock/contact_motion.hpp"
#include "core/interlock/contact_terms.hpp"
#include "core/mechanics/contact_element.hpp"

namespace pliant::interlock {

namespace {
using Eigen::Matrix3d;
using Eigen::Matrix3Xd;
using Eigen::MatrixXd;
using Eigen::RowVectorXd;
using Eigen::Vector2d;
using Eigen::Vector3d;
using Eigen::VectorXd;

/// One pair of parts and all numbers p of the geometry.
class PairRates {
 public:
  PairRates(const CellContact& contact, const CellState& state, std::span<const CellRate> rates)
      : contact_(contact), state_(state), rates_(rates), count_(static_cast<Eigen::Index>(rates.size())) {}

  /// The derivatives by p of the pair's energy, and of its gradient by 15 local coordinates (15 x p); false if it is
  /// not within range.
  bool compute(const PartPair& pair, const PlacedPart& a, const PlacedPart& b, const Vector3d& offset,
               const CellContact::Barrier& barrier) {
    const Vector2d shift(pair.shift[0], pair.shift[1]);
    translation_ = contact_.cell().lattice * shift;
    translationRate_.resize(2, count_);
    offsetRate_.setZero(3, count_);
    radiiRate_.resize(count_);
    for (Eigen::Index k = 0; k < count_; ++k) {
      translationRate_.col(k) = rate(k).lattice * shift;
      offsetRate_.col(k).head<2>() = -stretchOf(state_.strain) * translationRate_.col(k);
      radiiRate_[k] = shapeRate(k, pair.a).radii[pair.partA] + shapeRate(k, pair.b).radii[pair.partB];
    }
    return a.part->kind == PartKind::arc || b.part->kind == PartKind::arc
               ? computeArcs(pair, a, b, offset, barrier)
               : computeSimplices(pair, a, b, offset, barrier);
  }

  const RowVectorXd& ofEnergy() const { return ofEnergy_; }
  const MatrixXd& ofGradient() const { return ofGradient_; }
  const RowVectorXd& ofGap() const { return ofGap_; }
  const Eigen::Matrix<double, 15, 1>& gapGradient() const { return gapGradient_; }

 private:
  const CellRate& rate(Eigen::Index k) const { return rates_[static_cast<std::size_t>(k)]; }
  const PartsRate& shapeRate(Eigen::Index k, int element) const {
    return rate(k).shapes[static_cast<std::size_t>(contact_.cell().elements[static_cast<std::size_t>(element)].shape)];
  }

  /// How the place of closest approach on one part moves, and the tangent there, if the parameter along the part is
  /// kept, or the place is at its end.
  void placeRates(int element, int index, const PlacedPart& part, double parameter, const Vector3d& weights,
                  Matrix3Xd& places, Matrix3Xd& tangents) const {
    const Matrix3d& rotation = state_.rotations[static_cast<std::size_t>(element)];
    places.resize(3, count_);
    tangents.setZero(3, count_);
    for (Eigen::Index k = 0; k < count_; ++k) {
      const PartsRate& own = shapeRate(k, element);
      if (part.part->kind != PartKind::arc) {
        Vector3d place = Vector3d::Zero();
        for (int i = 0; i < 3; ++i) place += weights[i] * own.corners.col(part.part->corners[i]);
        places.col(k) = rotation * place;
        continue;
      }
      const ClosedCurve::Point moved = own.curves[static_cast<std::size_t>(part.part->curve)].at(parameter);
      places.col(k) = rotation * moved.place;
      tangents.col(k) = rotation * moved.tangent;
      if (parameter > part.part->begin && parameter < part.part->end) continue;
      const Part& arc = contact_.partsOf(element).parts()[static_cast<std::size_t>(index)];
      const double share = (parameter - arc.begin) / (arc.end - arc.begin);
      const double slide = (1 - share) * own.begins[index] + share * own.ends[index];
      places.col(k) += slide * part.curve->at(parameter).tangent;
    }
  }

  bool computeArcs(const PartPair& pair, const PlacedPart& a, const PlacedPart& b, const Vector3d& offset,
                   const CellContact::Barrier& barrier) {
    ArcPlaces places;
    const ClosestArcs closest = closestArcs(a, b, offset, places);
    const double distance = closest.distance();
    gap_ = distance - a.part->radius - b.part->radius;
    if (!(gap_ < barrier.range)) return false;
    Matrix3Xd armsA, armsB, tangentsA, tangentsB;
    placeRates(pair.a, pair.partA, a, places.parameterA, places.weights, armsA, tangentsA);
    placeRates(pair.b, pair.partB, b, places.parameterB, places.weights, armsB, tangentsB);
    const Vector3d& between = closest.between;
    const Vector3d normal = between / distance;
    const Matrix3Xd ofBetween = offsetRate_ + armsA - armsB;
    const ContactJacobian jacobian = contactJacobian(closest.armA, closest.armB, translation_);
    gapGradient_ = jacobian.transpose() * normal;
    ofGap_ = normal.transpose() * ofBetween - radiiRate_.transpose();

    // ∂²f/∂q∂p, and ∂²f/∂q∂u, ∂²f/∂u∂u, ∂²f/∂u∂p of those parameters that are free.
    MatrixXd mixed = jacobian.transpose() * ofBetween;
    for (Eigen::Index k = 0; k < count_; ++k) {
      mixed.block<3, 1>(3, k) += Vector3d(armsA.col(k)).cross(between);
      mixed.block<3, 1>(9, k) -= Vector3d(armsB.col(k)).cross(between);
      mixed.block<3, 1>(12, k) += strainColumns(translationRate_.col(k)).transpose() * between;
    }
    if (const int free = closest.freeCount; free > 0) {
      MatrixXd slides(3, free), ofSlides(15, free), byNumbers(free, count_);
      for (int i = 0; i < free; ++i) {
        const bool ofA = closest.ofA[static_cast<std::size_t>(i)];
        slides.col(i) = (ofA ? 1 : -1) * closest.tangents.col(i);
        ofSlides.col(i) = jacobian.transpose() * slides.col(i);
        ofSlides.block<3, 1>(ofA ? 3 : 9, i) += Vector3d(slides.col(i)).cross(between);
        byNumbers.row(i) = slides.col(i).transpose() * ofBetween;
        byNumbers.row(i) += tangentTerms(pair, a, b, closest, places, i, ofA, tangentsA, tangentsB);
      }
      MatrixXd inner = slides.transpose() * slides;
      inner.diagonal() += closest.bend.head(free);
      const Eigen::SelfAdjointEigenSolver<MatrixXd> solver(inner);
      const auto inverse = solver.eigenvalues().cwiseMax(1e-10 * inner.trace()).cwiseInverse();
      mixed -=
          ofSlides * (solver.eigenvectors() * inverse.asDiagonal() * (solver.eigenvectors().transpose() * byNumbers));
    }
    const RowVectorXd ofDistance = normal.transpose() * ofBetween;
    mixed = mixed / distance - gapGradient_ * ofDistance / distance;
    const mechanics::BarrierFunction function(gap_, barrier.range);
    const double scale = barrier.weight / (barrier.range * barrier.range);
    ofEnergy_ = scale * function.slope * ofGap_;
    ofGradient_ = scale * (function.curvature * gapGradient_ * ofGap_ + function.slope * mixed);
    return true;
  }

  /// (X_A - X_B) · ∂²(X_A - X_B)/∂u∂p of the free parameter i, with one number p a column: the rate of a curve's
  /// tangent, or of a simplex's edge along which its place slides.
  RowVectorXd tangentTerms(const PartPair& pair, const PlacedPart& a, const PlacedPart& b, const ClosestArcs& closest,
                           const ArcPlaces& at, int i, bool ofA, const Matrix3Xd& tangentsA,
                           const Matrix3Xd& tangentsB) const {
    const PlacedPart& part = ofA ? a : b;
    const double sign = ofA ? 1 : -1;
    if (part.part->kind == PartKind::arc) return sign * closest.between.transpose() * (ofA ? tangentsA : tangentsB);
    const int element = ofA ? pair.a : pair.b;
    Matrix3Xd turned(3, count_);
    for (Eigen::Index k = 0; k < count_; ++k) {
      Vector3d edge = Vector3d::Zero();
      for (int j = 0; j < 3; ++j) edge += at.slopes(j, i) * shapeRate(k, element).corners.col(part.part->corners[j]);
      turned.col(k) = state_.rotations[static_cast<std::size_t>(element)] * edge;
    }
    return sign * closest.between.transpose() * turned;
  }

  bool computeSimplices(const PartPair& pair, const PlacedPart& a, const PlacedPart& b, const Vector3d& offset,
                        const CellContact::Barrier& barrier) {
    const SimplexParts parts = simplexParts(a, b, offset);
    const auto closest = geometry::closestPoints(parts.kind, parts.corners);
    gap_ = std::sqrt(closest.squaredDistance) - a.part->radius - b.part->radius;
    if (!(gap_ < barrier.range)) return false;
    mechanics::ContactElement element{
        parts.corners, closest, gap_, barrier.weight / (barrier.range * barrier.range), barrier.range, 0};
    const bool edges = parts.kind == geometry::SimplexPair::edgeEdge;
    if (edges) element.mollifierScale = geometry::edgeMollifierScale(parts.corners);
    const geometry::CornerVector gradient = element.gradient();
    const geometry::CornerMatrix hessian = element.hessian(0);
    const mechanics::BarrierFunction function(gap_, barrier.range);
    geometry::CornerVector fadeGradient = geometry::CornerVector::Zero();
    const double fade =
        edges ? geometry::edgeMollifier(parts.corners, element.mollifierScale, &fadeGradient, nullptr) : 1;
    const Vector3d normal = geometry::directionBetween(parts.corners, closest);

    const int first = geometry::firstCornerCount(parts.kind), count = geometry::cornerCount(parts.kind);
    ofEnergy_.setZero(count_);
    ofGap_.setZero(count_);
    ofGradient_.setZero(15, count_);
    gapGradient_.setZero();
    // Rates of the corners as simplexParts sees them, and of the arms about which they turn.
    std::array<Matrix3Xd, 4> armRates;
    std::array<ContactJacobian, 4> jacobians;
    std::array<bool, 4> ofA{};
    MatrixXd cornerRates = MatrixXd::Zero(12, count_);
    for (int i = 0; i < count; ++i) {
      ofA[static_cast<std::size_t>(i)] = (i < first) != parts.swapped;
      const bool own = ofA[static_cast<std::size_t>(i)];
      const PlacedPart& part = own ? a : b;
      const int index = i < first ? i : i - first, elementIndex = own ? pair.a : pair.b;
      Matrix3Xd& rates = armRates[static_cast<std::size_t>(i)];
      rates.resize(3, count_);
      for (Eigen::Index k = 0; k < count_; ++k)
        rates.col(k) = state_.rotations[static_cast<std::size_t>(elementIndex)] *
                       shapeRate(k, elementIndex).corners.col(part.part->corners[static_cast<std::size_t>(index)]);
      cornerRates.middleRows<3>(3 * i) = own ? (rates + offsetRate_).eval() : rates;
      ContactJacobian& jacobian = jacobians[static_cast<std::size_t>(i)];
      jacobian.setZero();
      const Vector3d arm = own ? Vector3d(parts.corners.col(i) - offset) : Vector3d(parts.corners.col(i));
      jacobian.block<3, 3>(0, own ? 3 : 9) = -crossMatrix(arm);
      if (own) {
        jacobian.block<3, 3>(0, 0).setIdentity();
        jacobian.block<3, 3>(0, 6) = -Matrix3d::Identity();
        jacobian.block<3, 3>(0, 12) = strainColumns(translation_);
      }
      gapGradient_ += closest.weights[i] * jacobian.transpose() * normal;
      ofGap_ += closest.weights[i] * normal.transpose() * cornerRates.middleRows<3>(3 * i);
    }
    ofGap_ -= radiiRate_.transpose();

    // The gradient by the corners changes with these, with the radii, which move the gap alone, and with the lengths of
    // the edges, which scale the mollifier (2 - z) z with z = c/ε: ∂m/∂ε = (2z - 2) z/ε and ∂∇m/∂ε = ∇c (4z - 2)/ε².
    MatrixXd gradientRates = hessian * cornerRates;
    geometry::CornerVector distanceGradient = geometry::CornerVector::Zero();
    for (int i = 0; i < count; ++i) distanceGradient.segment<3>(3 * i) = closest.weights[i] * normal;
    gradientRates -= element.stiffness *
                     (function.slope * fadeGradient + fade * function.curvature * distanceGradient) *
                     radiiRate_.transpose();
    ofEnergy_ = gradient.transpose() * cornerRates - element.stiffness * fade * function.slope * radiiRate_.transpose();
    if (edges && fade < 1)
      addMollifierRates(parts.corners, element, function, fadeGradient, distanceGradient, cornerRates, gradientRates);
    for (int i = 0; i < count; ++i) {
      const auto index = static_cast<std::size_t>(i);
      const Vector3d g = gradient.segment<3>(3 * i);
      ofGradient_ += jacobians[index].transpose() * gradientRates.middleRows<3>(3 * i);
      for (Eigen::Index k = 0; k < count_; ++k) {
        ofGradient_.block<3, 1>(ofA[index] ? 3 : 9, k) += Vector3d(armRates[index].col(k)).cross(g);
        if (ofA[index]) ofGradient_.block<3, 1>(12, k) += strainColumns(translationRate_.col(k)).transpose() * g;
      }
    }
    return true;
  }

  void addMollifierRates(const geometry::Corners& corners, const mechanics::ContactElement& element,
                         const mechanics::BarrierFunction& function, const geometry::CornerVector& fadeGradient,
                         const geometry::CornerVector& distanceGradient, const MatrixXd& cornerRates,
                         MatrixXd& gradientRates) {
    const Vector3d edgeA = corners.col(1) - corners.col(0), edgeB = corners.col(3) - corners.col(2);
    const double scale = element.mollifierScale, z = edgeA.cross(edgeB).squaredNorm() / scale;
    const RowVectorXd scaleRate =
        2 * scale *
        (edgeA.transpose() * (cornerRates.middleRows<3>(3) - cornerRates.middleRows<3>(0)) / edgeA.squaredNorm() +
         edgeB.transpose() * (cornerRates.middleRows<3>(9) - cornerRates.middleRows<3>(6)) / edgeB.squaredNorm());
    const double fadeRate = (2 * z - 2) * z / scale;
    ofEnergy_ += element.stiffness * function.value * fadeRate * scaleRate;
    // ∇m = (2 - 2z) ∇c/ε.
    const geometry::CornerVector fadeGradientRate = fadeGradient * ((4 * z - 2) / ((2 - 2 * z) * scale));
    gradientRates += element.stiffness *
                     (function.value * fadeGradientRate + function.slope * fadeRate * distanceGradient) * scaleRate;
  }

  const CellContact& contact_;
  const CellState& state_;
  std::span<const CellRate> rates_;
  Eigen::Index count_;
  Vector2d translation_;
  Eigen::Matrix2Xd translationRate_;
  Matrix3Xd offsetRate_;
  VectorXd radiiRate_;
  RowVectorXd ofEnergy_, ofGap_;
  MatrixXd ofGradient_;
  Eigen::Matrix<double, 15, 1> gapGradient_;
  double gap_ = 0;
};
}  // namespace

ParameterTerms parameterTerms(const CellContact& contact, const CellState& state, const std::vector<PartPair>& pairs,
                              const CellContact::Barrier& barrier, std::span<const CellRate> rates) {
  const auto count = static_cast<Eigen::Index>(rates.size()),
             size = static_cast<Eigen::Index>(contact.coordinateCount());
  ParameterTerms terms{VectorXd::Zero(count), MatrixXd::Zero(size, count)};
  PairRates pairRates(contact, state, rates);
  contact.visitContacts(
      state, pairs, barrier, false, false, [&](const PartPair& pair, const ContactTerms& contactTerms) {
        if (!pairRates.compute(pair, *contactTerms.a, *contactTerms.b, contactTerms.offset, barrier)) return;
        terms.ofEnergy += pairRates.ofEnergy().transpose();
        terms.ofGradient.middleRows<6>(6 * pair.a) += pairRates.ofGradient().topRows<6>();
        terms.ofGradient.middleRows<6>(6 * pair.b) += pairRates.ofGradient().middleRows<6>(6);
        terms.ofGradient.bottomRows<3>() += pairRates.ofGradient().bottomRows<3>();
      });
  return terms;
}

VectorXd gapRateAtRest(const CellContact& contact, const PartPair& pair, std::span<const CellRate> rates) {
  const CellState rest = restState(contact.cell());
  PairRates pairRates(contact, rest, rates);
  const auto count = static_cast<Eigen::Index>(rates.size());
  VectorXd result = VectorXd::Zero(count);
  const CellContact::Barrier everywhere{1, 1e3};  // longer than any pair is apart
  contact.visitContacts(rest, {pair}, everywhere, false, false, [&](const PartPair&, const ContactTerms& terms) {
    pairRates.compute(pair, *terms.a, *terms.b, terms.offset, everywhere);
    for (Eigen::Index k = 0; k < count; ++k) {
      const CellRate& rate = rates[static_cast<std::size_t>(k)];
      Eigen::Matrix<double, 15, 1> own = Eigen::Matrix<double, 15, 1>::Zero();
      own.segment<3>(0) = rate.positions.col(pair.a);
      own.segment<3>(3) = rate.turns.col(pair.a);
      own.segment<3>(6) = rate.positions.col(pair.b);
      own.segment<3>(9) = rate.turns.col(pair.b);
      result[k] = pairRates.ofGap()[k] + pairRates.gapGradient().dot(own);
    }
  });
  return result;
}

}  // namespace pliant::interlock
