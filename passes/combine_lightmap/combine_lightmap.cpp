#include "passes/combine_lightmap/combine_lightmap.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <memory>
#include <span>

#include "base/math/digits.h"
#include "base/silent_task.h"
#include "geometry/tessellation.h"
#include "light/render/baked.h"
#include "light/render/surface.h"
#include "passes/combine_lightmap/page.h"
#include "passes/combine_lightmap/painting.h"
#include "passes/combine_lightmap/repacking.h"
#include "passes/combine_lightmap/showing.h"
#include "passes/combine_lightmap/vertex_colors.h"
#include "passes/lightmap/borders.h"
#include "passes/lightmap/connected.h"
#include "passes/lightmap/whole_pages.h"
#include "scenegraph/dangling_links.h"
#include "scenegraph/nodes.h"
#include "scenegraph/walk.h"

namespace wrlkit {
namespace {

using namespace combine;
namespace ap = nodes::appearance;
namespace ifs = nodes::indexed_face_set;

/// A Shape with light, and the surface that it shows.
struct LitShape {
  NodeId shape, appearance, geometry;
  std::uint32_t surface;
  bool transparent;
};

/// Shapes that share a page of light, and may be in one picture.
struct Group {
  std::shared_ptr<const drawing::Texture> light;
  std::vector<LitShape> shapes;
  bool transparent = false;
  int factor = 1;  // texels of the picture for each texel of the light, along each side

  std::uint64_t texels() const {
    return static_cast<std::uint64_t>(factor) * factor * light->width() * light->height();
  }
};

/// A picture as it will be written.
struct Encoded {
  std::string extension, bytes;
};

/// Shapes that are all opaque, or all transparent, on pages that are packed again.
struct Repacked {
  std::vector<const LitShape*> shapes;
  std::vector<Repacking::Item> items;
  std::unique_ptr<Repacking> packing;
  std::vector<Encoded> pages;
};

/// Colours of its own let light through.
bool has_clear_colors(const Scene& scene, NodeId geometry) {
  const NodeId n = scene.get(geometry, ifs::color);
  if (!scene.is(n, nodes::ColorRGBA)) return false;
  const auto rgba = scene.get(n, nodes::color_rgba::color);
  for (std::size_t i = 3; i < rgba.size(); i += 4)
    if (rgba[i] < 1) return true;
  return false;
}

class Combining {
 public:
  Combining(Scene& scene, const CombineLightmapOptions& options, PassContext& ctx)
      : scene_(scene),
        options_(options),
        ctx_(ctx),
        surfaces_(scene, ctx.resources, ctx.diag),
        silent_(ctx),
        showing_(scene, options.into) {}

  Outcome run() {
    find_shapes();
    color_corners();
    for (Group& g : groups_) find_factor(g);
    for (const bool transparent : {false, true}) repack(transparent);
    if (!keep_budget()) return Outcome::failed;
    for (Repacked& r : repacked_) add(r);
    for (const Group& g : groups_)
      if (!is_repacked(g) && !combine(g)) return Outcome::failed;
    showing_.show(std::move(geometries_), shown_);
    ctx_.stats["combine-lightmap.pages"] += n_pictures_;
    return shown_.empty() ? Outcome::unchanged : Outcome::changed;
  }

 private:
  void find_shapes();
  std::optional<LitShape> lit_shape(NodeId shape);
  Mesh read_mesh(NodeId geometry, bool textured);
  std::vector<Mesh> meshes_of(const Group& group);
  void color_corners();
  bool color_corners(const LitShape& shape, std::size_t n_shapes);
  void find_factor(Group& group);
  double detail_of(const drawing::Surface& s, const Mesh& mesh) const;

  void repack(bool transparent);
  bool is_repacked(const Group& group) const;
  bool is_limited() const { return options_.budget.bytes > 0 || options_.texels > 0; }
  std::uint64_t most_texels() const;
  struct Used {
    std::uint64_t bytes = 0, texels = 0;
  };
  bool encode_pages();
  Used used() const;
  double affordable(const Used& used) const;
  bool keep_budget();
  void report_budget(const Used& before, std::span<ChartNeed* const> needs);

  bool combine(const Group& group);
  std::vector<std::uint16_t> charts_of(const Mesh& mesh);
  void add(Repacked& repacked);

  std::string_view first_url(NodeId texture) const;
  std::string format_of(const LitShape& shape) const;
  std::optional<Encoded> encoded(const Image& image, const LitShape& first);
  NodeId texture(Encoded picture, const LitShape& first);

  Scene& scene_;
  const CombineLightmapOptions& options_;
  PassContext& ctx_;
  drawing::Surfaces surfaces_;
  SilentTask silent_;
  MeshScratch scratch_;
  Showing showing_;
  std::vector<Group> groups_;
  std::vector<Repacked> repacked_;
  std::vector<ShownGeometry> geometries_;
  std::vector<ShownShape> shown_;
  std::map<std::uint32_t, std::size_t> geometry_of_;  // those that keep the places of their light
  std::uint32_t n_charts_ = 0;                        // numbers that are taken
  std::size_t n_pictures_ = 0;
};

void Combining::find_shapes() {
  std::map<std::pair<const drawing::Texture*, bool>, std::size_t> group_of;
  for (NodeId n : all_nodes(scene_)) {
    if (!scene_.is(n, nodes::Shape)) continue;
    auto lit = lit_shape(n);
    if (!lit) {
      showing_.keep(n);
      continue;
    }
    auto light = surfaces_[lit->surface].baked.light.texture;
    auto [at, is_new] = group_of.try_emplace({light.get(), lit->transparent}, groups_.size());
    if (is_new) groups_.push_back({light, {}, lit->transparent});
    groups_[at->second].shapes.push_back(*lit);
    ctx_.stats["combine-lightmap.shapes"] += 1;
  }
}

std::optional<LitShape> Combining::lit_shape(NodeId shape) {
  LitShape lit{shape, scene_.get(shape, nodes::shape::appearance), scene_.get(shape, nodes::shape::geometry), 0, false};
  if (!scene_.is(lit.appearance, nodes::Appearance) || !scene_.get(lit.appearance, ap::lightmap)) return {};
  if (!scene_.is(lit.geometry, nodes::IndexedFaceSet) ||
      !scene_.is(scene_.get(lit.geometry, ifs::lightCoord), nodes::TextureCoordinate))
    return {};
  lit.surface = surfaces_.of(lit.appearance);
  const auto& s = surfaces_[lit.surface];
  if (!s.baked) return {};
  lit.transparent =
      options_.into != CombineTarget::lightmap &&
      (s.alpha < 1 || (s.picture.texture && s.picture.texture->has_alpha()) || has_clear_colors(scene_, lit.geometry));
  return lit;
}

Mesh Combining::read_mesh(NodeId geometry, bool textured) {
  Mesh mesh;
  MeshJob job{scene_, geometry, mesh, scratch_, silent_, textured};
  make_mesh(job, {.texcoords = true});  // of an IndexedFaceSet: there is nothing curved
  if (!mesh.is_triangles() || !mesh.lightcoord.present()) mesh.clear();
  return mesh;
}

std::vector<Mesh> Combining::meshes_of(const Group& group) {
  std::vector<Mesh> out;
  for (const LitShape& s : group.shapes)
    out.push_back(read_mesh(s.geometry, surfaces_[s.surface].picture.texture != nullptr));
  return out;
}

/// Pixels of the texture for each texel of the light, along a side, in the mean over the mesh.
double Combining::detail_of(const drawing::Surface& s, const Mesh& mesh) const {
  if (!s.picture.texture || !mesh.texcoord.present()) return 0;
  double pixels = 0, texels = 0;
  for (std::uint32_t c = 0; c < mesh.corners.size(); c += 3) {
    pixels += picture_area(mesh.texcoord, c, s.texcoords);
    texels += picture_area(mesh.lightcoord, c, s.baked.places);
  }
  pixels *= double(s.picture.texture->width()) * s.picture.texture->height();
  texels *= double(s.baked.light.texture->width()) * s.baked.light.texture->height();
  return texels > 0 ? std::sqrt(pixels / texels) : 0;
}

/// Takes Shapes out of their groups that get colours at their corners.
void Combining::color_corners() {
  if (options_.into != CombineTarget::automatic && options_.into != CombineTarget::vertex) return;
  std::map<std::uint32_t, std::size_t> n_shapes;  // by geometry
  for (const Group& g : groups_)
    for (const LitShape& s : g.shapes) ++n_shapes[s.geometry.value];
  for (Group& g : groups_)
    if (!g.transparent)
      std::erase_if(g.shapes, [&](const LitShape& s) { return color_corners(s, n_shapes[s.geometry.value]); });
  std::erase_if(groups_, [](const Group& g) { return g.shapes.empty(); });
}

bool Combining::color_corners(const LitShape& shape, std::size_t n_shapes) {
  const drawing::Surface& surface = surfaces_[shape.surface];
  if (surface.picture.texture) return false;
  const Mesh mesh = read_mesh(shape.geometry, false);
  if (mesh.corners.empty()) return false;
  auto colors = fit_vertex_colors(surface, mesh);
  if (!colors) return false;
  if (options_.into == CombineTarget::automatic && !is_worth_it(*colors, surface, mesh, n_shapes, options_.tolerance))
    return false;
  shown_.push_back({shape.shape, shape.appearance, geometries_.size(), NodeId{}});
  geometries_.push_back({shape.geometry, {}, std::move(colors->of_place)});
  ctx_.stats["combine-lightmap.vertex-shapes"] += 1;
  return true;
}

void Combining::find_factor(Group& group) {
  const double most = std::max(1, options_.max_size / std::max(group.light->width(), group.light->height()));
  double wanted = 1;
  for (const LitShape& lit : group.shapes) {
    const drawing::Surface& s = surfaces_[lit.surface];
    if (s.picture.texture) wanted = std::max(wanted, std::min(detail_of(s, read_mesh(lit.geometry, true)), 1e9));
  }
  const double chosen = std::min(options_.scale.value ? options_.scale.value : std::ceil(wanted), most);
  constexpr double unseen = 1.5;
  if (wanted > unseen * chosen)
    ctx_.diag.report(Diag::texture_coarser, scene_.where(group.shapes[0].shape), std::lround(wanted / chosen));
  group.factor = static_cast<int>(chosen);
}

/// Where that saves a good part of the texels, or there is a budget.
void Combining::repack(bool transparent) {
  constexpr double worth_it = 0.75, usual_fill = 0.9;
  Repacked r;
  double now = 0;
  for (const Group& g : groups_) {
    if (g.transparent != transparent) continue;
    now += static_cast<double>(g.texels());
    for (const LitShape& s : g.shapes) {
      r.shapes.push_back(&s);
      r.items.push_back({s.geometry, &surfaces_[s.surface]});
    }
  }
  if (r.shapes.empty()) return;
  const bool limited = is_limited() || now > static_cast<double>(most_texels());
  r.packing = std::make_unique<Repacking>(
      r.items, [&](NodeId geometry, bool textured) { return read_mesh(geometry, textured); },
      RepackOptions{options_.scale.value, options_.max_size, options_.tolerance, limited, transparent});
  if (!r.packing->measure()) return;
  halve_even(r.packing->needs(), options_.tolerance);
  if (!limited && area_of(r.packing->needs(), r.packing->padding()) / usual_fill > worth_it * now) return;
  r.packing->pack();
  if (!limited && static_cast<double>(r.packing->texels()) > worth_it * now) return;
  repacked_.push_back(std::move(r));
}

bool Combining::is_repacked(const Group& group) const {
  return std::ranges::any_of(repacked_,
                             [&](const Repacked& r) { return r.shapes[0]->transparent == group.transparent; });
}

bool Combining::encode_pages() {
  for (Repacked& r : repacked_) {
    r.pages.clear();
    for (std::uint32_t i = 0; i < r.packing->pages().size(); ++i) {
      auto page = encoded(r.packing->paint(i), *r.shapes[0]);
      if (!page) return false;
      r.pages.push_back(std::move(*page));
    }
  }
  return true;
}

/// Bytes and texels of pages that are packed again.
Combining::Used Combining::used() const {
  Used out;
  for (const Repacked& r : repacked_) {
    out.texels += r.packing->texels();
    for (const Encoded& page : r.pages) out.bytes += page.bytes.size();
  }
  return out;
}

/// Without a budget those of a page of 2048 x 2048, or those of the light, whichever are more.
std::uint64_t Combining::most_texels() const {
  constexpr std::uint64_t usual = 2048 * 2048;
  if (options_.texels > 0) return static_cast<std::uint64_t>(options_.texels);
  if (options_.budget.bytes > 0) return std::numeric_limits<std::uint64_t>::max();
  std::uint64_t light = 0;
  for (const Group& g : groups_) light += g.texels() / static_cast<std::uint64_t>(g.factor * g.factor);
  return std::max(usual, light);
}

/// How much of the texels may stay: bytes do not go down quite as texels do.
double Combining::affordable(const Used& used) const {
  constexpr double margin = 0.97;
  double out = 1;
  if (const auto most = options_.budget.bytes; most && used.bytes > most)
    out = margin * static_cast<double>(most) / static_cast<double>(used.bytes);
  if (const auto most = most_texels(); used.texels > most)
    out = std::min(out, static_cast<double>(most) / static_cast<double>(used.texels));
  return out;
}

/// Pictures grow and shrink with their texels, though not quite alike: a few steps come near enough.
bool Combining::keep_budget() {
  constexpr int most_steps = 12;
  const int least_padding = bake::padding_of(1);  // more of it goes before charts do
  constexpr double hurry = 0.85;                  // sides of pages are powers of two: a little less changes nothing
  const bool by_bytes = options_.budget.bytes > 0;
  std::vector<ChartNeed*> needs;
  for (Repacked& r : repacked_)
    for (ChartNeed& n : r.packing->needs()) needs.push_back(&n);
  if (by_bytes && !encode_pages()) return false;
  const Used before = used();
  for (int step = 0; step < most_steps && affordable(used()) < 1; ++step) {
    const double left = affordable(used()) * (step ? hurry : 1), area = area_of(needs, least_padding);
    halve_to(needs, left * area, least_padding);
    if (!(area_of(needs, least_padding) < area)) break;
    for (Repacked& r : repacked_) r.packing->pack();
    if (by_bytes && !encode_pages()) return false;
  }
  report_budget(before, needs);
  return by_bytes || encode_pages();
}

void Combining::report_budget(const Used& before, std::span<ChartNeed* const> needs) {
  const Used now = used();
  if (affordable(before) == 1) return;
  ctx_.diag.report(Diag::light_budget, {}, now.texels, before.texels, std::round(10 * error_of(needs)) / 10);
  if (affordable(now) < 1) ctx_.diag.report(Diag::light_budget_missed, {}, now.texels);
}

/// Of an ImageTexture; empty when there is none.
std::string_view Combining::first_url(NodeId texture) const {
  if (!scene_.is(texture, nodes::ImageTexture)) return {};
  const auto urls = scene_.get(texture, nodes::image_texture::url);
  return urls.empty() ? std::string_view() : urls[0];
}

/// Of the picture of such a Shape: the extension of its name.
std::string Combining::format_of(const LitShape& shape) const {
  std::string_view format = name_of(options_.format);
  if (options_.format == CombinedFormat::as_light) {
    format = name_of(PictureFormat::png);
    const NodeId light = scene_.get(shape.appearance, ap::lightmap);
    PictureFormat of_light{};
    if (const auto url = first_url(light);
        read_choice(url.substr(url.rfind('.') + 1), of_light) && why_missing(of_light).empty())
      format = name_of(of_light);
  }
  const bool has_no_alpha = format == name_of(PictureFormat::jpg);
  return std::string(shape.transparent && has_no_alpha ? name_of(PictureFormat::png) : format);
}

std::optional<Encoded> Combining::encoded(const Image& image, const LitShape& first) {
  const std::string extension = format_of(first);
  std::string error;
  auto bytes = encode_as("baked." + extension, image, error);
  if (!bytes) {
    ctx_.diag.report(Diag::cannot_write, {}, "baked." + extension, error);
    return {};
  }
  return Encoded{extension, std::move(*bytes)};
}

NodeId Combining::texture(Encoded picture, const LitShape& first) {
  const std::string name = "baked_" + std::to_string(n_pictures_++) + "." + picture.extension;
  const std::string url =
      ctx_.resources->add_made({name, std::make_shared<const std::string>(std::move(picture.bytes))});
  const NodeId n = scene_.add(nodes::ImageTexture, scene_.where(first.shape));
  scene_.set(n, nodes::image_texture::url, std::vector<std::string_view>{url}, nodes::image_texture::repeatS, false,
             nodes::image_texture::repeatT, false);
  return n;
}

/// By triangle. Those that have corners in common are one chart.
std::vector<std::uint16_t> Combining::charts_of(const Mesh& mesh) {
  const Attribute& places = mesh.lightcoord;
  const auto root = bake::connected(places.index);
  std::vector<std::uint16_t> out;
  for (std::size_t c = 0; c < mesh.corners.size(); c += 3)
    out.push_back(bake::chart_number(n_charts_ + root[places.index[c]]));
  n_charts_ += static_cast<std::uint32_t>(root.size());
  return out;
}

/// At the places of its light.
bool Combining::combine(const Group& group) {
  const int k = group.factor, width = k * group.light->width(), height = k * group.light->height();
  const auto meshes = meshes_of(group);
  std::vector<PageTriangle> triangles;
  std::vector<Painted> painted;
  for (std::size_t i = 0; i < meshes.size(); ++i) {
    const std::size_t first = triangles.size();
    list_triangles(surfaces_[group.shapes[i].surface], meshes[i], width, height, triangles, painted);
    const auto charts = charts_of(meshes[i]);
    for (std::size_t t = first; t < triangles.size(); ++t) triangles[t].chart = charts[painted[t].corner / 3];
  }
  constexpr double reach = 2,
                   most = 8;  // texels of the light, and of the picture: all triangles take as long as it is wide
  Page page(width, height, std::min(reach * k, most));
  const bool whole =
      page.paint(triangles, [&](std::size_t i, const std::array<double, 3>& weights, double x, double y) {
        return painted[i].color(weights, x, y, group.transparent);
      });
  const LitShape& first = group.shapes[0];
  if (!whole)
    ctx_.diag.report(Diag::expansion_limit, scene_.where(first.shape), Page::most_layers,
                     "layers of faces in a lightmap");
  ctx_.stats["combine-lightmap.texels"] += group.texels();
  auto picture = encoded(page.image(group.transparent ? 4 : 3), first);
  if (!picture) return false;
  const NodeId node = texture(std::move(*picture), first);
  for (const LitShape& s : group.shapes) {
    const auto [at, is_new] = geometry_of_.try_emplace(s.geometry.value, geometries_.size());
    if (is_new) geometries_.push_back({s.geometry});
    shown_.push_back({s.shape, s.appearance, at->second, node, {}, true});
  }
  return true;
}

void Combining::add(Repacked& r) {
  const Repacking& packing = *r.packing;
  std::vector<NodeId> textures;
  for (Encoded& page : r.pages) textures.push_back(texture(std::move(page), *r.shapes[0]));
  ctx_.stats["combine-lightmap.texels"] += packing.texels();
  for (std::size_t g = 0; g < packing.n_geometries(); ++g) {
    const auto shapes = packing.shapes(g);
    for (std::size_t k = 0; k < shapes.size(); ++k) {
      const LitShape& s = *r.shapes[shapes[k]];
      shown_.push_back(
          {s.shape, s.appearance, geometries_.size(), textures[packing.page(g, k)], packing.transform(g, k), false});
    }
    geometries_.push_back({packing.geometry(g), packing.places(g)});
  }
}

bool has_lightmaps(const Scene& scene) {
  for (std::uint32_t i = 0; i < scene.node_count(); ++i)
    if (scene.is(NodeId{i}, nodes::Appearance) && scene.get(NodeId{i}, ap::lightmap)) return true;
  return false;
}

}  // namespace

bool TexelFactor::read(std::string_view text) {
  if (text == "auto") {
    value = 0;
    return true;
  }
  return read_number(text, value) && value >= 1 && value <= 64;
}

std::string why_missing(CombinedFormat format) {
  PictureFormat picture{};
  return read_choice(name_of(format), picture) ? why_missing(picture) : std::string();
}

Outcome combine_lightmap(Scene& scene, const CombineLightmapOptions& options, PassContext& ctx) {
  if (!ctx.resources || !has_lightmaps(scene)) return Outcome::unchanged;
  const bool dropped = drop_dangling_links(scene).any;
  const auto outcome = Combining(scene, options, ctx).run();
  // What animated a Material that is part of the picture now.
  for (const Route& r : drop_dangling_links(scene).routes)
    ctx.diag.report(Diag::animation_baked, scene.where(r.to), scene.type(r.to).name,
                    r.event_in.starts_with("set_") ? r.event_in.substr(4) : r.event_in);
  return dropped && outcome == Outcome::unchanged ? Outcome::changed : outcome;
}

}  // namespace wrlkit
