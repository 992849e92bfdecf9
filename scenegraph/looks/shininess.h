// Highlights of Blinn's exponent n = 128 shininess and of microfacets of roughness r are alike where r^4 = 2 / (n + 2).
#pragma once

namespace wrlkit {

/// r^4, which is alpha^2 of a microfacet distribution.
constexpr double highlight_width(double shininess) { return 2 / (128 * shininess + 2); }
constexpr double shininess_of_width(double width) { return (2 / width - 2) / 128; }

}  // namespace wrlkit
