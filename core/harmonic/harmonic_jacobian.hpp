#pragma once

#include <array>
#include <vector>

#include "core/math/harmonic_basis.hpp"
#include "core/mechanics/elastic_assembler.hpp"

namespace pliant::harmonic {

using mechanics::Matrix;
using mechanics::SparseMatrix;
using mechanics::Vector;

/// Writes ∂h/∂z (2.3.13) straight into the value array of a matrix whose pattern never changes.
///
/// Two coordinates that share a stiffness entry k(τ) are coupled by a dense (2H+1)-block, the discrete Γ⁻¹ k Γ.
/// Products of sines and cosines are sums and differences of the Fourier coefficients of k up to order 2H,
///   (sin jτ, sin kτ) = P[j-k] - P[j+k],   (cos jτ, cos kτ) = P[j-k] + P[j+k],   (sin jτ, cos kτ) = Q[j+k] + Q[j-k],
/// with P[m] and Q[m] the means of k(τ_i) cos(m τ_i) and k(τ_i) sin(m τ_i) over the samples. This is an identity for
/// any number of samples, so the blocks cost one matrix product for all coefficients and a few additions an entry.
/// Damping multiplies a block by (1 + D_β ω d) from the left; inertia and mass damping add to its diagonal pairs.
/// Of two frequencies, j and k are pairs of multiples, and orders up to 2H are the combinations of order 2H.
/// Coordinates may have fewer harmonics than the basis: the rows and columns of those left out do not exist.
///
/// Constant once built; any thread may use it.
class HarmonicJacobian {
 public:
  /// `mass`: M of the free coordinates, nFree square [kg]. `coordinateHarmonics`: of each free coordinate, at most the
  /// basis's.
  HarmonicJacobian(const math::HarmonicBasis& basis, const mechanics::ElasticAssembler& assembler,
                   const SparseMatrix& mass, const std::vector<int>& coordinateHarmonics);

  Eigen::Index size() const { return outerStarts_.size() - 1; }
  Eigen::Index entryCount() const { return outerStarts_[size()]; }

  /// `stiffness`: at least N x (assembler's entryCount) samples of the Hessian's lower triangle [N/m]; `coefficients`
  /// is working memory. `jacobian` gets the pattern if it has another one.
  void assemble(const Matrix& stiffness, double omega, double massDamping, double stiffnessDamping,
                Matrix& coefficients, SparseMatrix& jacobian) const;

 private:
  /// The blocks of one pair of coordinates (row >= column): where they start and how far their columns are apart.
  struct Block {
    int entry;    ///< of the Hessian's lower triangle, or -1
    double mass;  ///< [kg]
    long lower;
    long lowerStride;
    long upper;
    long upperStride;
    int rowWidth;     ///< 2H+1 of the row's coordinate
    int columnWidth;  ///< likewise
    bool diagonal;
  };

  /// Where j-k and j+k are among the coefficients: ±m for the combination m or its negative, 0 for the constant.
  struct Mixed {
    int difference;
    int sum;
  };

  void combineHarmonics(const std::vector<std::array<int, 2>>& combinations);
  void writeBlocks(const Block& block, const Matrix& coefficients, double omega, double massDamping, double* scratch,
                   double* values) const;

  int harmonics_;
  int extent_;                 ///< largest m: 2H of one frequency
  std::vector<double> rates_;  ///< of k = 0 .. harmonics_: what d/dτ multiplies by
  std::vector<Mixed> mixed_;   ///< of j and k, j running faster; empty of one frequency
  Matrix transform_;           ///< (2 extent + 1) x N: samples to P[0], Q[1], P[1], ..., Q[2H], P[2H]
  std::vector<Block> blocks_;
  std::vector<int> columnBlocks_;   ///< first block of each column of coordinates, and the end
  std::vector<int> columnEntries_;  ///< first Hessian entry of each column of coordinates, and the end
  Eigen::VectorXi outerStarts_;
  Eigen::VectorXi innerIndices_;
};

}  // namespace pliant::harmonic
