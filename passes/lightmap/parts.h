// The surfaces that get light: their triangles, the normals by which they are shaded, and their charts.
#pragma once
#include <cstdint>
#include <optional>
#include <vector>

#include "geometry/tessellation.h"
#include "geometry/unwrap/charts.h"
#include "light/render/stage.h"
#include "light/world.h"
#include "passes/pipeline/pass.h"

namespace wrlkit::bake {

/// A geometry node, and Shapes that show it: once they are split (sizes.h), those that do so in one size.
struct Part {
  NodeId geometry;
  std::vector<std::uint32_t> uses;  // into Stage::uses; one for each Shape
  Mesh mesh;                        // triangles; the backs, where they need light of their own, behind the fronts
  std::vector<float> normals;       // unit, of each corner, in the frame of the geometry
  std::size_t n_fronts = 0;         // triangles that are not backs
  bool sealed = false,
       inside_out = false;  // closed around some room: nobody sees the inner side, which the fronts were
  bool faces_in = false;    // inside out for good: turned only as long as light is computed
  bool letters = false;     // of a Text: they lie in the plane z = 0
  double density = 1;       // texels a metre, relative to those of other parts
  unwrap::Charts charts;    // in metres of the world, as the first use has it

  std::size_t n_triangles() const { return mesh.corners.size() / 3; }
  drawing::V3 position(std::size_t corner) const {
    return vec3(mesh.positions.data() + std::size_t{mesh.corners[corner]} * 3);
  }
  drawing::V3 normal(std::size_t corner) const {
    return {normals[3 * corner], normals[3 * corner + 1], normals[3 * corner + 2]};
  }
};

class UnlitShapes;

/// The parts of a scene, in its order; curved forms become `faces`. Left out: what has no Material or PhysicalMaterial,
/// unless the unlit are lit, too; lines and points; geometry that events can change. O(triangles).
///
/// A face of `solid` FALSE is seen from both sides, which have light of their own. Where the surface is closed, and
/// opaque, and neither a Viewpoint nor anything that shines is in its box, nobody sees the inner side: it is
/// sealed, and only the outer one is lit; one that is wound inside out is turned. What consists of several, some of
/// which are wound against the others, has light on both sides. Any other surface of `solid` FALSE gets a back for each
/// face, and `solid` TRUE. A closed surface of `solid` TRUE that is wound inside out may be a room, and stays as it is
/// where it shines, or holds something of these or some other Shape. Else it is a thing whose inner sides viewers show:
/// it gets the light of its outside (`faces_in`).
std::vector<Part> find_parts(const Scene& scene, const light::LightWorld& world, const UnlitShapes& unlit,
                             const Tessellation& faces, PassContext& ctx);

/// What faces inward does so again: its mesh, and two numbers for each of its corners.
void face_in(Part& part, std::vector<float>& coords);

/// Unfolds each part into charts; in parallel. Letters of a Text are one chart, and their backs another one, so that
/// what they take does not grow with their number.
void unfold_parts(std::vector<Part>& parts, const drawing::Stage& stage);

}  // namespace wrlkit::bake
