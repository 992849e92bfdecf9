// Colours at the corners of a mesh in place of a picture of its light: what small parts need no texels for.
#pragma once
#include <array>
#include <cstddef>
#include <optional>
#include <vector>

#include "passes/combine_lightmap/chart_image.h"
#include "passes/combine_lightmap/painting.h"

namespace wrlkit::combine {

struct VertexColors {
  std::vector<std::array<double, 3>> of_place;  // by place of the light, display values
  Difference error;                             // from what the texels of the light show
};

/// Of all the colours that can be given to the corners, those whose mixtures over the triangles come nearest to what
/// the surface shows at the texels of its light (least squares); where no texel lies, what is shown there. Nothing
/// where triangles overlap so much that it would take too long. O(texels of the boxes of the triangles).
std::optional<VertexColors> fit_vertex_colors(const drawing::Surface& surface, const Mesh& mesh);

/// They show no less than texels, for their bytes: error times bytes is less than `tolerance`, which texels have, times
/// the bytes of those, and the error is no more than twice the tolerance, in 255ths. `n_shapes` share the geometry now,
/// and will not with colours of their own.
bool is_worth_it(const VertexColors& colors, const drawing::Surface& surface, const Mesh& mesh, std::size_t n_shapes,
                 double tolerance);

}  // namespace wrlkit::combine
