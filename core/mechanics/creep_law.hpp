#pragma once

namespace pliant::mechanics {

/// The share of a contact's friction that a slide u >= 0 uses up, as a potential (Li et al. 2020, "Incremental
/// potential contact", section 5.5): times the largest force that friction has,
///   f = u²/ε - u³/(3ε²) below the creep ε, u - ε/3 above,
/// so that its force grows with the slide up to ε, from where on contacts slide.
struct CreepLaw {
  double value;           ///< f [m]
  double slopeOverSlide;  ///< f'/u [1/m]
  double curvature;       ///< f'' [1/m], never negative

  CreepLaw(double slide, double creep) {
    if (slide >= creep) {
      value = slide - creep / 3;
      slopeOverSlide = 1 / slide;
      curvature = 0;
    } else {
      const double share = slide / creep;
      value = slide * share * (1 - share / 3);
      slopeOverSlide = (2 - share) / creep;
      curvature = 2 * (1 - share) / creep;
    }
  }
};

}  // namespace pliant::mechanics
