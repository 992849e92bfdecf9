// Fits: from the rings of one part to a form, measured at every point. Each gives nothing when a point is farther from
// where the form has it than the tolerance.
#pragma once
#include <optional>
#include <span>

#include "geometry/recognise/chain_forms.h"

namespace wrlkit::recognising {

struct Tolerances {
  double given = 0;  // 0: by what the part shows
  double step = 0, size = 0;

  /// For a polygon of n sides that stands for a circle of that radius.
  double round(double radius, std::size_t n) const;
  double flat() const;
};

struct Fit {
  Form form;
  double residual = 0;
  bool outward = true;
};

Ring ring_of(std::vector<Vec3> points, const Tolerances& tolerances);
Ring apex_of(const Vec3& point, std::size_t n);

// Each of these reads the rings as one form. Rings between the first and the last may lie on its straight walls.
std::optional<Fit> fit_straight(std::span<const Ring> rings, const Tolerances& tolerances);
std::optional<Fit> fit_slanted(std::span<const Ring> rings, const Tolerances& tolerances);
std::optional<Fit> fit_eccentric(std::span<const Ring> rings, const Tolerances& tolerances);
std::optional<Fit> fit_torus(std::span<const Ring> rings, bool whole, const Tolerances& tolerances);
/// From the rim to the pole, which comes last.
std::optional<Fit> fit_dish(std::span<const Ring> rings, const Tolerances& tolerances);
std::optional<Fit> fit_sphere(std::span<const Ring> rings, const Tolerances& tolerances);
/// A box, a rectangular torus or a prism.
std::optional<Fit> fit_prism(std::span<const Ring> rings, const Tolerances& tolerances);
/// A box that is square across an axis as a cylinder with four sides, which looks the same. False, and nothing done,
/// for others.
bool become_square_bar(Form& form, const Vec3& axis, double tolerance);
std::optional<Fit> fit_pyramid(std::span<const Ring> rings, const Tolerances& tolerances);
/// For several loops, the first of which is the outer one: from their lower to their upper rings.
std::optional<Fit> fit_hollow(std::span<const Ring> low, std::span<const Ring> high, const Tolerances& tolerances);
/// Four rings around one axis, the last next to the first.
std::optional<Fit> fit_closed_ring(std::span<const Ring> rings, const Tolerances& tolerances);

}  // namespace wrlkit::recognising
