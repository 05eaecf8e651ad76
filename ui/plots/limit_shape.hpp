#pragma once

#include <string>
#include <vector>

#include "core/cloth/stretch_limit.hpp"

namespace pliant::plots {

enum class LimitKind { isotropic, orthotropic, free };

/// Whether a free curve is the same mirrored about the warp, and so about the weft too.
enum class LimitSymmetry { none, mirrored };

/// One place of the full circle where a handle is seen: a limit has period π, and a mirrored one repeats each handle up
/// to four times.
struct HandlePlace {
  int handle = 0;
  double angle = 0;        ///< on the full circle [rad], in [0, 2π)
  double turn = 0;         ///< angle = turn ± the handle's own angle
  bool reflected = false;  ///< the sign is -

  /// The handle's own angle [rad] if this place were seen at `displayed`.
  double handleAngle(double displayed) const { return reflected ? turn - displayed : displayed - turn; }
};

/// A stretch limit as a designer edits it: by handles, under a symmetry. Whatever is done, the limit stays feasible:
/// stretches are at least 1, since below it the rest shape itself breaks the limit, and no two points of a curve have
/// the same direction. What cannot be done is refused with a sentence; an empty one means that it was done.
///
/// The handles are the one value of an isotropic limit (at angle 0), the two principal values of an orthotropic one,
/// and the points of a free curve: of a mirrored one those in [0, π/2].
class LimitShape {
 public:
  explicit LimitShape(const cloth::StretchLimit& limit = cloth::IsotropicLimit{1.05});

  cloth::StretchLimit limit() const;
  LimitKind kind() const { return kind_; }
  LimitSymmetry symmetry() const { return symmetry_; }
  const std::vector<cloth::DirectionLimit>& handles() const { return handles_; }
  int handleCount() const { return static_cast<int>(handles_.size()); }
  /// Where the handles are seen, those of one handle next to one another.
  std::vector<HandlePlace> places() const;
  /// The place that turns an orthotropic limit has this number instead of a handle's.
  static constexpr int rotationHandle = -2;

  /// Takes another limit. A free curve stays mirrored, or becomes so if `infer`, where that loses nothing.
  void setLimit(const cloth::StretchLimit& limit, bool infer = false);
  /// Another kind of limit near this one: the principal values are those along warp and weft, the isotropic one is the
  /// smallest, a free curve takes the limit at eight directions.
  void setKind(LimitKind kind);
  /// What a mirrored curve takes is the half between warp and weft.
  void setSymmetry(LimitSymmetry symmetry);

  /// Moves a handle to the nearest feasible place: between its neighbours, not below 1. Keeps the order of handles. Of
  /// an isotropic or orthotropic limit only the stretch is taken; the rotation handle takes only the angle.
  std::string drag(int handle, const cloth::DirectionLimit& place);
  /// Puts a handle exactly there, and sorts. What is not feasible changes nothing.
  std::string put(int handle, const cloth::DirectionLimit& place);
  /// A new point of a free curve on the curve as it is.
  std::string add(double angle);
  std::string remove(int handle);
  /// Sorts the handles by angle, after a drag; returns where `handle` is then.
  int sort(int handle);
  /// The handle whose direction is nearest.
  int nearestHandle(double angle) const;

 private:
  double ownAngle(double angle) const;
  bool tooNear(double angle, int except) const;

  LimitKind kind_ = LimitKind::isotropic;
  LimitSymmetry symmetry_ = LimitSymmetry::none;
  std::vector<cloth::DirectionLimit> handles_;
};

/// Whether both limits say the same in every number.
bool sameLimit(const cloth::StretchLimit& a, const cloth::StretchLimit& b);

/// A named curve to begin with. Its numbers are plausible, not measured.
struct LimitPreset {
  const char* name;
  const char* description;
  cloth::StretchLimit limit;
};
const std::vector<LimitPreset>& limitPresets();

}  // namespace pliant::plots
