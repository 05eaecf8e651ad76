#pragma once

#include "core/base/parameter_spec.hpp"
#include "core/cloth/stretch_limit.hpp"

namespace pliant::panels {

using base::Json;

/// How a limit is enforced: "constraints" and "count" of a curve, "directions" of another entry of the scene's
/// "stretch_limits". What is no curve is enforced exactly unless by directions.
enum class ConstraintMethod { automatic, ellipses, directions };
struct ConstraintChoice {
  ConstraintMethod method = ConstraintMethod::automatic;
  int count = 12;
  friend bool operator==(const ConstraintChoice&, const ConstraintChoice&) = default;
};

/// The limit of a normalised entry. Throws base::InputError (location empty) if the curve is none.
cloth::StretchLimit limitOf(const Json& entry);
ConstraintChoice constraintChoiceOf(const Json& entry);

/// `entry`, as it is written, with another limit; what it says beside the limit (name, element, group, direction)
/// stays. Angles are written in degrees.
Json entryWith(const Json& entry, const cloth::StretchLimit& limit, const ConstraintChoice& choice);

/// A new entry, without a limit, for the first sheet among the scene's elements; which one that is has to be said only
/// where there are several.
Json newEntry(const Json& elements);

/// What enforces the limit. Throws base::InputError (location empty) for a count that is out of range.
cloth::LimitConstraints constraintsOf(const cloth::StretchLimit& limit, const ConstraintChoice& choice);

}  // namespace pliant::panels
