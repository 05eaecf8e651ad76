#pragma once

#include <Eigen/SparseCore>
#include <vector>

#include "core/math/block_pattern.hpp"

namespace pliant::math {

/// The symbolic factorisation of a matrix A, structurally symmetrised, in a given elimination order: which *supernodes*
/// (groups of columns eliminated together) its LU factors have, and what flows where. Built once per pattern.
///
/// A supernode eliminates p pivots and couples them to r later rows (and, by symmetry, columns). It owns the first p
/// columns and the first p rows of a square *front* of size m = p + r, whose places are the pivots and then the rows:
/// an m x p panel (diagonal block and L below it) and a p x r panel (U). What earlier supernodes contribute is
/// subtracted when its turn comes (left-looking; Ng & Peyton 1993), so nothing but the factors is ever stored.
/// The parent of a supernode in the elimination tree (Liu 1990) owns its first row; supernodes of disjoint subtrees are
/// independent. A child is merged into its parent, at the price of some zeros in the factors, where that is estimated
/// to be faster (relaxed supernodes; Duff & Reid 1983, Ashcraft & Grimes 1989).
struct SupernodeTree {
  /// `length` neighbouring scalars: from `source` on in one numbering, from `target` on in another.
  struct Run {
    int source;
    int target;
    int length;
  };
  /// What an earlier supernode contributes: the runs runBegin .. runEnd map the places firstRow .. of the rows of
  /// `source` to places in this front; the first `pivotRows` of these are pivots here.
  struct Update {
    int source;
    int firstRow;
    int pivotRows;
    int runBegin;
    int runEnd;
  };
  /// A dense block of A in the front: `entry` is the index of its first value, `stride` the distance of its columns.
  struct EntryBlock {
    int row;
    int column;
    int rows;
    int columns;
    Eigen::Index entry;
    int stride;
  };
  struct Supernode {
    int firstPivot = 0;  ///< in the order of elimination
    int pivots = 0;      ///< p
    int rows = 0;        ///< r
    int parent = -1;
    Eigen::Index lower = 0;  ///< where the m x p panel begins in the factors (column-major, m apart)
    Eigen::Index upper = 0;  ///< where the p x r panel begins (column-major, p apart)
    int updateBegin = 0;
    int updateEnd = 0;
    int entryBegin = 0;  ///< its blocks of A, by column
    int entryEnd = 0;
    int rowRunBegin = 0;  ///< runs from places among the rows to the order of elimination
    int rowRunEnd = 0;
    int tileBegin = 0;  ///< tileBounds[tileBegin .. tileEnd]: column tiles, never across the end of the pivots
    int tileEnd = 0;
    double work = 0;  ///< estimated, in floating-point operations at full speed

    int size() const { return pivots + rows; }
  };

  /// Floating-point operations that eliminating p pivots coupled to r rows takes, as many as take the same time in
  /// large matrix products.
  using WorkEstimate = double (*)(double p, double r);
  /// Of SupernodalFactorization.
  static double workOfLu(double p, double r);

  SupernodeTree(const BlockPattern& pattern, const std::vector<int>& order, WorkEstimate estimateWork = workOfLu);
  /// The rest of the analysis of LU factors, for the tree that is chosen; the three members below are no longer valid.
  void layOut(const BlockPattern& pattern, const Eigen::SparseMatrix<double>& matrix);

  /// Vertices in the order of elimination; where those of a supernode begin, and the end; and places, in that order, of
  /// the vertices of its rows, ascending.
  const std::vector<int>& vertices() const { return vertices_; }
  const std::vector<int>& vertexBegin() const { return vertexBegin_; }
  const std::vector<int>& rowPlaces(int supernode) const { return rows_[supernode]; }

  std::vector<Supernode> supernodes;  ///< children before parents
  std::vector<int> childCount;
  std::vector<Run> pivotRuns;  ///< from the matrix's order to the order of elimination
  std::vector<Update> updates;
  std::vector<Run> updateRuns;
  std::vector<EntryBlock> entryBlocks;
  std::vector<Run> rowRuns;
  std::vector<int> tileBounds;
  Eigen::Index factorSize = 0;     ///< doubles
  Eigen::Index workspaceSize = 0;  ///< doubles that the product of one update with one tile can take
  double work = 0;                 ///< sum over the supernodes
  double flops = 0;

 private:
  std::vector<int> vertices_;           ///< in the order of elimination
  std::vector<std::vector<int>> rows_;  ///< per supernode: places in vertices_ of its rows' vertices, ascending
  std::vector<int> vertexBegin_;        ///< per supernode, and the end: its pivots' vertices
};

}  // namespace pliant::math
