// wrlkit info: what is inside a world. The keys of --json are stable.
#include "tools/verbs/info.h"

#include <fmt/format.h>

#include <algorithm>
#include <map>
#include <set>

#include "base/image/image.h"
#include "base/text/json.h"
#include "parsers/patches/patches.h"
#include "scenegraph/nodes.h"
#include "scenegraph/verify.h"
#include "scenegraph/walk.h"
#include "tools/geometry_census.h"
#include "tools/verbs/patches_info.h"
#include "tools/world_meshes.h"

namespace wrlkit {
namespace {

struct TextureInfo {
  std::string url;
  bool found = false;
  int width = 0, height = 0;
};

struct Info {
  std::map<std::string, std::uint64_t> nodes;  // authored, each once
  GeometryCensus geometry;
  std::uint64_t materials = 0, lights = 0, viewpoints = 0, lods = 0, animations = 0, protos = 0, routes = 0,
                scripts = 0, inlines = 0, names = 0;
  std::vector<TextureInfo> textures;
  std::vector<std::uint64_t> levels;  // triangles with every LOD at its first level, its second, ...
};

/// What the file says, before anything is expanded.
void count_authored(const Scene& scene, Info& info) {
  for (NodeId n : all_nodes(scene)) {
    const auto& t = scene.type(n);
    ++info.nodes[std::string(t.name)];
    info.names += !scene.name(n).empty();
    info.scripts += t.name == "Script";
    info.inlines += scene.is(n, nodes::Inline);
  }
  info.protos = scene.proto_count();
  info.routes = scene.main.routes.size();
  std::set<std::uint32_t> driving;
  for (std::uint32_t i = 0; i < scene.proto_count(); ++i) info.routes += scene.proto(ProtoId{i}).body.routes.size();
  for (auto& r : scene.main.routes)
    if (scene.type(r.from).is_a("X3DInterpolatorNode")) driving.insert(r.from.value);
  info.animations = driving.size();
}

TextureInfo texture_info(Session& s, NodeId n) {
  const Scene& scene = s.world().scene;
  if (scene.is(n, nodes::PixelTexture)) {
    auto image = scene.get(n, nodes::pixel_texture::image);
    return {"", true, image.size() > 1 ? image[0] : 0, image.size() > 1 ? image[1] : 0};
  }
  auto urls = scene.is(n, nodes::ImageTexture) ? scene.get(n, nodes::image_texture::url)
                                               : scene.get(n, nodes::movie_texture::url);
  TextureInfo t{urls.empty() ? "" : std::string(urls[0]), false, 0, 0};
  if (urls.empty()) return t;
  auto blob = s.resources().bytes(urls, scene.where(n), s.diag());
  t.found = blob != nullptr;
  if (blob)
    if (auto header = read_image_header(blob->bytes, blob->name)) {
      t.width = header->width;
      t.height = header->height;
    }
  return t;
}

/// What is there when prototypes and Inlines are expanded.
void count_expanded(Session& s, Info& info) {
  const Scene& scene = s.world().scene;
  for (NodeId n : reachable(scene, scene.main)) {
    const auto& t = scene.type(n);
    info.materials += t.is_a("X3DMaterialNode");
    info.lights += t.is_a("X3DLightNode");
    info.viewpoints += t.is_a("X3DViewpointNode");
    info.lods += scene.is(n, nodes::LOD);
    if (t.is_a("X3DTextureNode")) info.textures.push_back(texture_info(s, n));
  }
}

/// Triangles with each LOD at level k, for k up to the largest number of levels.
void count_levels(Session& s, const WorldMeshes& meshes, Info& info) {
  if (!info.lods) return;
  Scene level = s.world().scene;
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
      auto children = s.world().scene.get(n, nodes::lod::children);
      if (!children.empty())
        level.set(n, nodes::lod::children, std::vector<NodeId>{children[std::min(k, children.size() - 1)]});
    }
    info.levels.push_back(count_geometry(level, meshes.polygons, meshes.triangles).triangles);
  }
}

void write_bounds(JsonOut& json, const Bounds& b) {
  json.key("bounds");
  if (b.empty()) return json.raw("null");
  json.begin_object();
  json.member("min", std::span<const double>(b.min));
  json.member("max", std::span<const double>(b.max));
  json.end_object();
}

void write_textures(JsonOut& json, const std::vector<TextureInfo>& textures) {
  json.key("textures");
  json.begin_array();
  for (auto& t : textures) {
    json.begin_object();
    json.member("url", t.url);
    json.member("found", t.found);
    json.member("width", t.width);
    json.member("height", t.height);
    json.end_object();
  }
  json.end_array();
}

std::string info_json(Session& s, const Info& i) {
  std::string out;
  JsonOut json(out);
  json.begin_object();
  json.member("file", s.flags().inputs[0]);
  json.member("format", to_string(s.world().format));
  json.member("bytes", s.world().bytes);
  json.member("gzip", s.world().gzip);
  json.key("nodes");
  json.begin_object();
  for (auto& [name, n] : i.nodes) json.member(name, n);
  json.end_object();
  json.member("shapes", i.geometry.shapes);
  json.member("polygons", i.geometry.polygons);
  json.member("triangles", i.geometry.triangles);
  json.member("lines", i.geometry.lines);
  json.member("points", i.geometry.points);
  write_bounds(json, i.geometry.bounds);
  json.member("materials", i.materials);
  write_textures(json, i.textures);
  json.member("lights", i.lights);
  json.member("viewpoints", i.viewpoints);
  json.member("lods", i.lods);
  json.member("levels", std::span<const std::uint64_t>(i.levels));
  json.member("animations", i.animations);
  json.member("protos", i.protos);
  json.member("routes", i.routes);
  json.member("scripts", i.scripts);
  json.member("inlines", i.inlines);
  json.member("names", i.names);
  json.key("diagnostics");
  json.begin_object();
  json.member("error", s.diag().count(Severity::error));
  json.member("warning", s.diag().count(Severity::warning));
  json.member("lost", s.diag().count(Severity::lost));
  json.end_object();
  json.end_object();
  return out;
}

std::string info_text(Session& s, const Info& i) {
  const auto& b = i.geometry.bounds;
  std::string out = fmt::format("{}: {}{}, {} bytes\n", s.flags().inputs[0], to_string(s.world().format),
                                s.world().gzip ? " (gzip)" : "", s.world().bytes);
  out += fmt::format("  shapes {}, polygons {}, triangles {}, lines {}, points {}\n", i.geometry.shapes,
                     i.geometry.polygons, i.geometry.triangles, i.geometry.lines, i.geometry.points);
  if (!b.empty())
    out += fmt::format("  from {:.6g} {:.6g} {:.6g} to {:.6g} {:.6g} {:.6g}: {:.6g} x {:.6g} x {:.6g} m\n", b.min[0],
                       b.min[1], b.min[2], b.max[0], b.max[1], b.max[2], b.max[0] - b.min[0], b.max[1] - b.min[1],
                       b.max[2] - b.min[2]);
  out += fmt::format("  materials {}, textures {}, lights {}, viewpoints {}, LODs {}\n", i.materials, i.textures.size(),
                     i.lights, i.viewpoints, i.lods);
  out += fmt::format("  names {}, prototypes {}, routes {}, scripts {}, inlines {}, animations {}\n", i.names, i.protos,
                     i.routes, i.scripts, i.inlines, i.animations);
  std::vector<std::pair<std::uint64_t, std::string>> types;
  for (auto& [name, n] : i.nodes) types.emplace_back(n, name);
  std::ranges::sort(types,
                    [](auto& a, auto& b) { return a.first != b.first ? a.first > b.first : a.second < b.second; });
  out += "  nodes:";
  for (auto& [n, name] : types) out += fmt::format(" {} {}", n, name);
  out += "\n";
  for (auto& t : i.textures)
    out += t.found ? fmt::format("  texture {} {} x {}\n", t.url.empty() ? "in the file" : t.url, t.width, t.height)
                   : fmt::format("  texture {} is missing\n", t.url);
  return out;
}

}  // namespace

std::optional<std::string> info_of(Session& s) {
  check_values(s.world().scene, s.diag());
  Info info;
  count_authored(s.world().scene, info);
  WorldMeshes meshes(s);
  if (!meshes.good()) return std::nullopt;
  count_expanded(s, info);
  info.geometry = count_geometry(s.world().scene, meshes.polygons, meshes.triangles);
  count_levels(s, meshes, info);
  return s.flags().json ? info_json(s, info) + "\n" : info_text(s, info);
}

int run_info(const Flags& flags) {
  Session s(flags);
  if (!s.good()) return usage;
  const auto file = read_file(flags.inputs[0], {}, s.diag());
  if (file && is_patch_file(file->view())) return print_patches_info(s, *file);
  if (!file || !s.document().read(flags.inputs[0], *file)) return s.end(false);
  const auto text = info_of(s);
  s.progress().clear();
  if (text) fmt::print("{}", *text);
  return s.end(text.has_value());
}

}  // namespace wrlkit
