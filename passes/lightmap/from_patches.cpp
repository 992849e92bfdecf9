#include "passes/lightmap/from_patches.h"

#include <algorithm>
#include <unordered_set>

#include "geometry/geometry.h"
#include "light/patches/patch_lightmap.h"
#include "passes/lightmap/copy_node.h"
#include "passes/lightmap/parts.h"
#include "passes/lightmap/store.h"
#include "passes/lightmap/unlit_shapes.h"
#include "scenegraph/nodes.h"

namespace wrlkit::bake {
namespace {

using drawing::V3;
using light::ShapePicture;

/// Row 0 the lowest.
Canvas canvas_of(const light::FloatPicture& p) {
  Canvas out{p.width, p.height, {}};
  out.texels.reserve(p.pixels.size());
  for (int y = p.height; y-- > 0;)
    for (int x = 0; x < p.width; ++x) {
      const V3& c = p.pixels[std::size_t(y) * p.width + x];
      out.texels.push_back({static_cast<float>(c.x), static_cast<float>(c.y), static_cast<float>(c.z)});
    }
  return out;
}

/// lightCoord of each corner of a part. The triangles of the pool are those of the part, but their corners may begin
/// elsewhere; empty when they are others.
std::vector<float> coords_of(const Part& part, const ShapePicture& shape, const light::LightWorld& world) {
  const auto& pool = world.meshes();
  const auto& mesh = pool[world.mesh_of()[shape.use]];
  if (shape.front.size() != part.n_fronts || mesh.n_elements != part.n_fronts) return {};
  std::vector<float> out;
  for (std::size_t t = 0; t < part.n_triangles(); ++t) {
    const bool back = t >= part.n_fronts || part.inside_out;
    const std::size_t of = t % part.n_fronts;
    for (std::size_t k = 0; k < 3; ++k) {
      const V3 p = part.position(3 * t + k);
      auto distance = [&](int c) { return length(pool.position(mesh, of, c) + mesh.origin - p); };
      const int corners[] = {0, 1, 2};
      const auto& place =
          (back ? shape.back
                : shape.front)[of][static_cast<std::size_t>(*std::ranges::min_element(corners, {}, distance))];
      out.insert(out.end(), place.begin(), place.end());
    }
  }
  return out;
}

}  // namespace

bool light_from_patches(Scene& scene, const light::LightWorld& world, const PatchSet& patches,
                        const FromPatchesOptions& options, PassContext& ctx) {
  light::PatchLightmapOptions how;
  how.smooth = options.smooth;
  how.without_color = true;
  auto made = light::patch_lightmap(patches, world, how);
  ctx.stats["lightmap.patches"] += made.n_patches;
  ctx.stats["lightmap.orphans"] += made.n_orphans;
  ctx.stats["lightmap.bare-triangles"] += made.n_bare;
  if (made.n_orphans) ctx.diag.report(Diag::orphan_patches, {}, made.n_orphans);

  std::vector<BakedPage> pages;
  for (auto& s : made.shapes) {
    pages.push_back({canvas_of(s.picture), {}});
    s.picture.pixels = {};
  }
  Storing storing(scene, pages, {options.extension}, ctx);
  std::unordered_set<std::uint32_t> taken;
  for (Part& part : find_parts(scene, world, UnlitShapes(scene, false), options.faces, ctx)) {
    std::vector<float> no_coords;
    face_in(part, no_coords);  // patches lie on the faces that the world has
    for (std::uint32_t use : part.uses) {
      const auto shape = std::ranges::lower_bound(made.shapes, use, {}, &ShapePicture::use);
      if (shape == made.shapes.end() || shape->use != use) continue;
      const auto coords = coords_of(part, *shape, world);
      if (coords.empty()) continue;
      const NodeId node = world.stage().uses[use].shape;
      NodeId geometry = part.geometry;
      if (!taken.insert(geometry.value).second)
        scene.set(node, nodes::shape::geometry, geometry = copy_of(scene, geometry));
      storing.place(part, coords, geometry);
      storing.light(node, {static_cast<std::uint32_t>(shape - made.shapes.begin())}, {});
      ++ctx.stats["lightmap.shapes"];
    }
  }
  return !made.shapes.empty();
}

}  // namespace wrlkit::bake
