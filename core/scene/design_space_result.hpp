#pragma once

#include <array>

#include "core/harmonic/design_space.hpp"
#include "core/scene/study.hpp"

namespace pliant::scene {

/// A number of a design that is set against another one.
struct DesignMeasure {
  enum class Kind { pathLength, displacement, totalMass };
  Kind kind = Kind::pathLength;
  std::size_t probe = 0;
  bool largestIsBest = true;

  std::string name(const mechanics::Model& model) const;  ///< "tip path length"
  std::string unit() const;
  double of(const harmonic::SampledDesign& design) const;
};

/// What motions the designs of a space have.
class DesignSpaceResult final : public Result {
 public:
  std::string kind() const override { return "design_space"; }
  Json summary() const override;
  /// summary.json, designs.csv (a row a design), paths.csv (of the probes, a row an instant and design).
  void write(const std::filesystem::path& directory) const override;

  /// Indices of the designs with a motion that no other one beats in both measures, by rising first measure.
  std::vector<int> front() const;
  int foundCount() const;

  harmonic::DesignSpace space;
  std::array<DesignMeasure, 2> measures;
  std::shared_ptr<const mechanics::Model> model;
  std::vector<int> parameters;  ///< by index in `Model::parameters`
  double omega = 0;
  int harmonics = 0;
  int samples = 0;
};

}  // namespace pliant::scene
