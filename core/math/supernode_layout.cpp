#include <algorithm>
#include <iterator>

#include "core/math/supernode_tree.hpp"

namespace pliant::math {

namespace {

/// Columns of a tile: wide enough for matrix products at full speed, narrow enough for its part of a front to stay in
/// the cache and for several threads to find work.
constexpr int tileColumns = 128;

/// Appends `run`, or lengthens the last of the runs from `begin` on if it continues that.
void append(std::vector<SupernodeTree::Run>& runs, int begin, const SupernodeTree::Run& run) {
  if (static_cast<int>(runs.size()) > begin) {
    SupernodeTree::Run& last = runs.back();
    if (last.source + last.length == run.source && last.target + last.length == run.target) {
      last.length += run.length;
      return;
    }
  }
  runs.push_back(run);
}

}  // namespace

void SupernodeTree::layOut(const BlockPattern& pattern, const Eigen::SparseMatrix<double>& matrix) {
  const int count = pattern.vertexCount();
  const int nodeCount = static_cast<int>(supernodes.size());
  std::vector<int> firstScalar(count + 1, 0);  // by place in the order of elimination
  std::vector<int> placeOf(count);             // by vertex
  std::vector<int> supernodeOf(count);         // by place
  for (int place = 0; place < count; ++place) {
    const int vertex = vertices_[place];
    placeOf[vertex] = place;
    firstScalar[place + 1] = firstScalar[place] + pattern.width(vertex);
  }
  for (int v = 0; v < count; ++v)
    append(pivotRuns, 0, {pattern.firstColumn[v], firstScalar[placeOf[v]], pattern.width(v)});
  for (int s = 0; s < nodeCount; ++s) {
    std::fill(supernodeOf.begin() + vertexBegin_[s], supernodeOf.begin() + vertexBegin_[s + 1], s);
  }
  const auto width = [&](int place) { return firstScalar[place + 1] - firstScalar[place]; };

  // Which supernode contributes to which: one update for every supernode that owns rows of the source.
  struct Contribution {
    int source;
    int firstPlace;  // in rows_[source]
    int firstRow;    // the same in scalars
  };
  std::vector<std::vector<Contribution>> contributions(nodeCount);
  for (int source = 0; source < nodeCount; ++source) {
    int row = 0;
    int owner = -1;
    for (int i = 0; i < static_cast<int>(rows_[source].size()); ++i) {
      const int place = rows_[source][i];
      if (supernodeOf[place] != owner) contributions[supernodeOf[place]].push_back({source, i, row});
      owner = supernodeOf[place];
      row += width(place);
    }
  }

  // Blocks of A, by the supernode that owns them; for the time being in places instead of scalars of the front.
  std::vector<std::vector<EntryBlock>> blocks(nodeCount);
  for (int vertex = 0; vertex < count; ++vertex) {
    const int j = pattern.firstColumn[vertex];
    const int begin = matrix.outerIndexPtr()[j];
    const int end = matrix.outerIndexPtr()[j + 1];
    const int* rowIndices = matrix.innerIndexPtr();
    for (int k = begin; k < end;) {
      const int rowVertex = pattern.vertexOfColumn[rowIndices[k]];
      int length = 1;
      while (k + length < end && rowIndices[k + length] == rowIndices[k] + length &&
             rowIndices[k + length] < pattern.firstColumn[rowVertex + 1]) {
        ++length;
      }
      const int rowPlace = placeOf[rowVertex];
      const int columnPlace = placeOf[vertex];
      const int firstRow = firstScalar[rowPlace] + rowIndices[k] - pattern.firstColumn[rowVertex];
      blocks[supernodeOf[std::min(rowPlace, columnPlace)]].push_back(
          {firstRow, firstScalar[columnPlace], length, pattern.width(vertex), k, end - begin});
      k += length;
    }
  }

  std::vector<int> local(firstScalar.back(), -1);  // place of a scalar in the current front
  Eigen::Index largestFront = 0;
  Eigen::Index widestTile = 0;
  for (int s = 0; s < nodeCount; ++s) {
    Supernode& node = supernodes[s];
    std::vector<int> places(vertexBegin_[s + 1] - vertexBegin_[s]);
    for (int i = 0; i < static_cast<int>(places.size()); ++i) places[i] = vertexBegin_[s] + i;
    places.insert(places.end(), rows_[s].begin(), rows_[s].end());

    node.rowRunBegin = static_cast<int>(rowRuns.size());
    node.tileBegin = static_cast<int>(tileBounds.size());
    tileBounds.push_back(0);
    int row = 0;
    const auto closeTile = [&] {
      widestTile = std::max<Eigen::Index>(widestTile, row - tileBounds.back());
      tileBounds.push_back(row);
    };
    for (const int place : places) {
      if (row >= node.pivots) append(rowRuns, node.rowRunBegin, {row - node.pivots, firstScalar[place], width(place)});
      for (int i = 0; i < width(place); ++i) {
        local[firstScalar[place] + i] = row++;
        if (row - tileBounds.back() >= 2 * tileColumns) closeTile();  // a wide vertex is split
      }
      const bool endOfPart = row == node.pivots || row == node.size();
      if (row > tileBounds.back() && (endOfPart || row - tileBounds.back() >= tileColumns)) closeTile();
    }
    node.rowRunEnd = static_cast<int>(rowRuns.size());
    node.tileEnd = static_cast<int>(tileBounds.size());

    node.updateBegin = static_cast<int>(updates.size());
    for (const Contribution& contribution : contributions[s]) {
      const auto& sourceRows = rows_[contribution.source];
      Update update{contribution.source, contribution.firstRow, 0, static_cast<int>(updateRuns.size()), 0};
      int sourceRow = contribution.firstRow;
      for (std::size_t i = contribution.firstPlace; i < sourceRows.size(); ++i) {
        const int place = sourceRows[i];
        if (supernodeOf[place] == s) update.pivotRows += width(place);
        append(updateRuns, update.runBegin, {sourceRow, local[firstScalar[place]], width(place)});
        sourceRow += width(place);
      }
      update.runEnd = static_cast<int>(updateRuns.size());
      updates.push_back(update);
    }
    node.updateEnd = static_cast<int>(updates.size());

    for (EntryBlock& block : blocks[s]) {
      block.row = local[block.row];
      block.column = local[block.column];
    }
    std::sort(blocks[s].begin(), blocks[s].end(), [](const EntryBlock& a, const EntryBlock& b) {
      return a.column != b.column ? a.column < b.column : a.row < b.row;
    });
    node.entryBegin = static_cast<int>(entryBlocks.size());
    entryBlocks.insert(entryBlocks.end(), blocks[s].begin(), blocks[s].end());
    node.entryEnd = static_cast<int>(entryBlocks.size());

    node.lower = factorSize;
    node.upper = node.lower + Eigen::Index{node.size()} * node.pivots;
    factorSize = node.upper + Eigen::Index{node.pivots} * node.rows;
    largestFront = std::max<Eigen::Index>(largestFront, node.size());
  }
  workspaceSize = largestFront * widestTile;
  rows_.clear();
}

}  // namespace pliant::math
