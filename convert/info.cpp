#include "convert/info.h"

#include <algorithm>
#include <set>

#include "base/image/image.h"
#include "convert/nothing_shown.h"
#include "convert/startup_scripts.h"
#include "convert/world_meshes.h"
#include "scenegraph/nodes.h"
#include "scenegraph/scopes.h"
#include "scenegraph/verify.h"
#include "scenegraph/walk.h"

namespace wrlkit {
namespace {

/// What the file holds, before anything is expanded.
void count_authored(const Scene& scene, Info& info) {
  for (NodeId n : all_nodes(scene)) {
    const auto& t = scene.type(n);
    ++info.nodes[std::string(t.name)];
    info.names += !scene.name(n).empty();
    info.scripts += t.name == "Script";
    info.inlines += scene.is(n, nodes::Inline);
  }
  info.protos = scene.proto_count();
  std::set<std::uint32_t> driving;
  for_each_scope(scene, [&](const Scope& s) { info.routes += s.routes.size(); });
  for (auto& r : scene.main.routes)
    if (scene.is(r.from, nodes::X3DInterpolatorNode)) driving.insert(r.from.value);
  info.animations = driving.size();
}

TextureInfo texture_info(Document& document, NodeId n) {
  const Scene& scene = document.scene();
  if (scene.is(n, nodes::PixelTexture)) {
    auto image = scene.get(n, nodes::pixel_texture::image);
    return {"", true, image.size() > 1 ? image[0] : 0, image.size() > 1 ? image[1] : 0};
  }
  auto urls = scene.is(n, nodes::ImageTexture) ? scene.get(n, nodes::image_texture::url)
                                               : scene.get(n, nodes::movie_texture::url);
  TextureInfo t{urls.empty() ? "" : std::string(urls[0]), false, 0, 0};
  if (urls.empty()) return t;
  auto blob = document.resources()->bytes(urls, scene.where(n), document.diag());
  t.found = blob != nullptr;
  if (blob)
    if (auto header = read_image_header(blob->bytes, blob->name)) {
      t.width = header->width;
      t.height = header->height;
    }
  return t;
}

/// What is there when prototypes and Inlines are expanded.
void count_expanded(Document& document, Info& info) {
  const Scene& scene = document.scene();
  for (NodeId n : reachable(scene, scene.main)) {
    const auto& t = scene.type(n);
    info.materials += t.is_a(nodes::X3DMaterialNode);
    info.lights += t.is_a(nodes::X3DLightNode);
    info.viewpoints += t.is_a(nodes::X3DViewpointNode);
    info.lods += scene.is(n, nodes::LOD);
    if (t.is_a(nodes::X3DTextureNode)) info.textures.push_back(texture_info(document, n));
  }
}

/// Triangles with each LOD at level k, for k up to the largest number of levels.
void count_levels(const Scene& scene, const WorldMeshes& meshes, Info& info) {
  if (!info.lods) return;
  Scene level = scene;
  std::vector<NodeId> lods;
  std::size_t most = 0;
  for (NodeId n : reachable(level, level.main))
    if (level.is(n, nodes::LOD)) {
      lods.push_back(n);
      most = std::max(most, level.get(n, nodes::lod::children).size());
    }
  constexpr std::size_t most_levels = 16;
  for (std::size_t k = 0; k < std::min(most, most_levels); ++k) {
    for (NodeId n : lods) {
      auto children = scene.get(n, nodes::lod::children);
      if (!children.empty())
        level.set(n, nodes::lod::children, std::vector<NodeId>{children[std::min(k, children.size() - 1)]});
    }
    info.levels.push_back(count_geometry(level, meshes.polygons, meshes.triangles).triangles);
  }
}

}  // namespace

std::optional<Info> info(Document&& document, const InfoOptions& options) {
  if (!document) return std::nullopt;
  const World& world = document.world();
  check_values(world.scene, document.diag());
  report_undrawn(world.scene, document.resources(), document.diag());
  if (!document.runs_startup()) report_startup_scripts(world.scene, document.diag());
  Info out{.format = world.format,
           .gzip = world.gzip,
           .is_inventor = world.scene.header.starts_with("#Inventor"),
           .bytes = world.bytes};
  count_authored(world.scene, out);
  const WorldMeshes meshes(document);
  if (!meshes.good()) return std::nullopt;
  count_expanded(document, out);
  out.geometry = count_geometry(world.scene, meshes.polygons, meshes.triangles);
  count_levels(world.scene, meshes, out);
  if (options.recognise) out.forms = count_forms(document, meshes.triangles);
  return out;
}

std::optional<Info> info(const Document& document, const InfoOptions& options) {
  return document ? info(document.copy(), options) : std::nullopt;
}

}  // namespace wrlkit
