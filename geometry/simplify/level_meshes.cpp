#include "geometry/simplify/level_meshes.h"

#include <algorithm>
#include <optional>

#include "geometry/normals.h"
#include "geometry/simplify/given_attributes.h"
#include "geometry/simplify/pieces.h"
#include "geometry/triangulation.h"

namespace wrlkit::simplify {
namespace {

/// What a level looks like is what the surface looked like: its own normals, or those by its crease angle.
Mesh with_normals(const Mesh& mesh) {
  Mesh out = mesh;
  MeshScratch scratch;
  if (!out.normal.present()) make_normals(out, scratch, out.crease_angle);
  return out;
}

/// A part as it was, and on the rungs of its ladder.
class PartOnRungs {
 public:
  PartOnRungs(const WorldPart& part, const std::vector<Rung>& ladder, Mesh given)
      : part_(part), ladder_(ladder), given_(std::move(given)) {}

  const Mesh& on(std::uint32_t rung) {
    if (rung == 0) return given_;
    if (rung != rung_) level_ = make(ladder_[rung]);
    rung_ = rung;
    return level_;
  }

 private:
  Mesh make(const Rung& rung) {
    Mesh out = rung.mesh;
    out.ccw = given_.ccw;
    transform(out, part_.from_ladder);
    drop_faces_without_area(out);
    if (!attributes_) attributes_.emplace(given_);
    attributes_->give(out);
    return out;
  }

  const WorldPart& part_;
  const std::vector<Rung>& ladder_;
  const Mesh given_;
  std::optional<GivenAttributes> attributes_;
  Mesh level_;
  std::uint32_t rung_ = 0;  // of the level
};

}  // namespace

std::vector<Mesh> level_meshes(const WorldParts& world, const PlacedSurface& s,
                               std::span<const std::reference_wrapper<const Rungs>> points) {
  std::vector<Mesh> out(points.size());
  std::vector<char> loose(points.size());
  for (auto& mesh : out) mesh.kind = Mesh::Kind::faces;
  const Mesh shaded = with_normals(s.mesh);
  std::vector<std::uint32_t> original;
  for (std::uint32_t i = s.first_part; i < s.first_part + s.n_parts; ++i) {
    const auto is_gone = [&](const Rungs& rungs) { return rungs[i] == Allocation::gone; };
    if (std::ranges::all_of(points, is_gone)) continue;
    const auto& ladder = *world.allocated[i].rungs;
    PartOnRungs part(world.parts[i], ladder, piece_of(shaded, world.parts[i].faces, original));
    for (std::size_t k = 0; k < points.size(); ++k) {
      if (is_gone(points[k])) continue;
      const auto rung = points[k].get()[i];
      loose[k] |= ladder[rung].loose;
      append(out[k], part.on(rung));
    }
  }
  for (std::size_t k = 0; k < points.size(); ++k) {
    out[k].ccw = s.mesh.ccw;
    out[k].solid = s.mesh.solid && !loose[k];
    out[k].convex = true;
    out[k].crease_angle = s.mesh.crease_angle;
    shorten_normals(out[k]);
  }
  return out;
}

}  // namespace wrlkit::simplify
