// What cutting a form needs to know, shared by the makers and the measures.
#pragma once
#include <array>
#include <vector>

#include "geometry/forms/form.h"

namespace wrlkit {

/// With the form's own numbers where none are given, each at least what makes a surface.
FormCut completed(const Form& form, const FormCut& cut);

/// By what the radius of a regular polygon of n sides grows until it is as large as its circle.
double equal_area_factor(int segments);
/// The same for chords that span an angle each.
double equal_area_factor(double angle);

bool is_whole(double angle);

/// The radius of the sphere that a spherical dish is cut from.
double sphere_radius(const DishForm& f);

/// For each wall of a prism the normals at its two ends, which are equal where the edge there is sharp.
std::vector<std::array<Vec3, 2>> prism_normals(const PrismForm& f);

}  // namespace wrlkit
