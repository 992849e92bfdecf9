#include "passes/combine_lightmap/combine_lightmap.h"

#include <algorithm>
#include <charconv>
#include <cmath>
#include <map>
#include <tuple>
#include <unordered_map>

#include "base/image/srgb_table.h"
#include "base/silent_task.h"
#include "geometry/tessellation.h"
#include "light/render/baked.h"
#include "light/render/surface.h"
#include "passes/combine_lightmap/page.h"
#include "passes/lightmap/borders.h"
#include "passes/lightmap/connected.h"
#include "passes/lightmap/copy_node.h"
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

/// Shapes that go into one picture.
struct Group {
  std::shared_ptr<const drawing::Texture> light;
  std::vector<LitShape> shapes;
  bool transparent = false;
  NodeId texture;  // once it is made
};

/// A triangle that is painted: its mesh and surface, and how much of the texture lies in a texel.
struct Painted {
  const drawing::Surface* surface;
  std::uint32_t mesh;
  std::uint32_t corner;  // the first of three
  double detail;         // pixels of the texture for each texel
};

template <std::size_t N>
std::array<double, N> mixed(const Attribute& a, std::uint32_t corner, const std::array<double, 3>& weights) {
  std::array<double, N> out{};
  for (std::uint32_t k = 0; k < 3; ++k)
    for (std::size_t i = 0; i < N; ++i) out[i] += weights[k] * a.at(a.index[corner + k])[i];
  return out;
}

/// Of texture coordinates: twice the area, without a sign.
double picture_area(const Attribute& a, std::uint32_t corner, const TexcoordMap& map) {
  const float *p = a.at(a.index[corner]), *q = a.at(a.index[corner + 1]), *r = a.at(a.index[corner + 2]);
  return std::abs((double{q[0]} - p[0]) * (double{r[1]} - p[1]) - (double{r[0]} - p[0]) * (double{q[1]} - p[1])) *
         std::abs(map.determinant());
}

/// Its numbers can be reckoned with. What is further away shows nothing of the page.
bool is_near(const PageTriangle& t) {
  constexpr double far = 1e9;
  auto near = [](double v) { return std::abs(v) < far; };
  return std::ranges::all_of(t.x, near) && std::ranges::all_of(t.y, near);
}

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
      : scene_(scene), options_(options), ctx_(ctx), surfaces_(scene, ctx.resources, ctx.diag), silent_(ctx) {}

  Outcome run() {
    find_shapes();
    for (Group& g : groups_)
      if (!combine(g)) return Outcome::failed;
    // Groups may share geometry: nothing changes before all are painted.
    for (const Group& g : groups_)
      for (const LitShape& lit : g.shapes) show(lit, g.texture);
    ctx_.stats["combine-lightmap.pages"] += groups_.size();
    return groups_.empty() ? Outcome::unchanged : Outcome::changed;
  }

 private:
  void find_shapes();
  std::optional<LitShape> lit_shape(NodeId shape);
  bool combine(Group& group);
  std::string_view first_url(NodeId texture) const;
  std::string format_of(const Group& group) const;
  bool hand_in(Group& group, const Image& image);
  void read_meshes(const Group& group);
  int factor(const Group& group);
  std::vector<std::uint16_t> charts_of(const Mesh& mesh);
  void list_triangles(const Group& group, std::uint32_t shape, int width, int height);
  double detail_of(const drawing::Surface& s, const Mesh& mesh) const;
  Texel4 color(const Painted& t, const std::array<double, 3>& weights, const std::array<double, 2>& place,
               bool alpha) const;
  void show(const LitShape& lit, NodeId texture);
  NodeId geometry_for(const LitShape& lit);
  NodeId writable(NodeId node, std::unordered_map<std::uint32_t, NodeId>& copies);

  Scene& scene_;
  const CombineLightmapOptions& options_;
  PassContext& ctx_;
  drawing::Surfaces surfaces_;
  SilentTask silent_;
  MeshScratch scratch_;
  std::vector<Group> groups_;
  std::vector<Mesh> meshes_;  // of the group at work, by Shape
  std::vector<PageTriangle> triangles_;
  std::vector<Painted> painted_;
  std::uint32_t n_charts_ = 0;             // numbers that are taken
  std::vector<std::uint32_t> unlit_uses_;  // by node: Shapes without light that hold it
  std::unordered_map<std::uint32_t, NodeId> geometries_;
  std::unordered_map<std::uint32_t, NodeId> appearances_;
  std::unordered_map<std::uint32_t, char> changed_;
};

void Combining::find_shapes() {
  std::map<std::pair<const drawing::Texture*, bool>, std::size_t> group_of;
  unlit_uses_.resize(scene_.node_count());
  for (NodeId n : all_nodes(scene_)) {
    if (!scene_.is(n, nodes::Shape)) continue;
    auto lit = lit_shape(n);
    if (!lit) {
      for_each_child(scene_, n, [&](NodeId c) {
        if (c) ++unlit_uses_[c.value];
      });
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

void Combining::read_meshes(const Group& group) {
  meshes_.assign(group.shapes.size(), {});
  for (std::size_t i = 0; i < meshes_.size(); ++i) {
    bool textured = surfaces_[group.shapes[i].surface].picture.texture != nullptr;
    MeshJob job{scene_, group.shapes[i].geometry, meshes_[i], scratch_, silent_, textured};
    make_mesh(job, {.texcoords = true});  // of an IndexedFaceSet: there is nothing curved
    if (!meshes_[i].is_triangles() || !meshes_[i].lightcoord.present()) meshes_[i].clear();
  }
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

int Combining::factor(const Group& group) {
  const double most = std::max(1, options_.max_size / std::max(group.light->width(), group.light->height()));
  double wanted = 1;
  for (std::size_t i = 0; i < meshes_.size(); ++i)
    wanted = std::max(wanted, std::min(detail_of(surfaces_[group.shapes[i].surface], meshes_[i]), 1e9));
  const double chosen = std::min(options_.scale.value ? options_.scale.value : std::ceil(wanted), most);
  constexpr double unseen = 1.5;
  if (wanted > unseen * chosen)
    ctx_.diag.report(Diag::texture_coarser, scene_.where(group.shapes[0].shape), std::lround(wanted / chosen));
  return static_cast<int>(chosen);
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

void Combining::list_triangles(const Group& group, std::uint32_t shape, int width, int height) {
  const auto& s = surfaces_[group.shapes[shape].surface];
  const Mesh& mesh = meshes_[shape];
  const double pixels = s.picture.texture && mesh.texcoord.present()
                            ? double(s.picture.texture->width()) * s.picture.texture->height()
                            : 0;
  const auto charts = charts_of(mesh);
  for (std::uint32_t c = 0; c < mesh.corners.size(); c += 3) {
    PageTriangle t;
    t.chart = charts[c / 3];
    for (std::uint32_t corner = 0; corner < 3; ++corner) {
      const float* at = mesh.lightcoord.at(mesh.lightcoord.index[c + corner]);
      auto [u, v] = s.baked.places(at[0], at[1]);
      t.x[corner] = u * width;
      t.y[corner] = (1 - v) * height;
    }
    const double texels = std::abs(t.area());
    if (!(texels > 0) || !is_near(t)) continue;
    triangles_.push_back(t);
    painted_.push_back(
        {&s, shape, c, pixels > 0 ? std::sqrt(pixels * picture_area(mesh.texcoord, c, s.texcoords) / texels) : 1});
  }
}

bool Combining::combine(Group& group) {
  read_meshes(group);
  const int k = factor(group), width = k * group.light->width(), height = k * group.light->height();
  triangles_.clear();
  painted_.clear();
  for (std::uint32_t i = 0; i < meshes_.size(); ++i) list_triangles(group, i, width, height);
  constexpr double reach = 2,
                   most = 8;  // texels of the light, and of the picture: all triangles take as long as it is wide
  Page page(width, height, std::min(reach * k, most));
  bool whole = page.paint(triangles_, [&](std::size_t i, const std::array<double, 3>& weights, double x, double y) {
    return color(painted_[i], weights, {x / width, 1 - y / height}, group.transparent);
  });
  if (!whole)
    ctx_.diag.report(Diag::expansion_limit, scene_.where(group.shapes[0].shape), Page::most_layers,
                     "layers of faces in a lightmap");
  ctx_.stats["combine-lightmap.texels"] += std::uint64_t(width) * static_cast<std::uint64_t>(height);
  return hand_in(group, page.image(group.transparent ? 4 : 3));
}

/// Of an ImageTexture; empty when there is none.
std::string_view Combining::first_url(NodeId texture) const {
  if (!scene_.is(texture, nodes::ImageTexture)) return {};
  const auto urls = scene_.get(texture, nodes::image_texture::url);
  return urls.empty() ? std::string_view() : urls[0];
}

/// Of a group's picture: the extension of its name.
std::string Combining::format_of(const Group& group) const {
  std::string_view format = name_of(options_.format);
  if (options_.format == CombinedFormat::as_light) {
    format = name_of(PictureFormat::png);
    const NodeId light = scene_.get(group.shapes[0].appearance, ap::lightmap);
    PictureFormat of_light{};
    if (const auto url = first_url(light);
        read_choice(url.substr(url.rfind('.') + 1), of_light) && why_missing(of_light).empty())
      format = name_of(of_light);
  }
  const bool has_no_alpha = format == name_of(PictureFormat::jpg);
  return std::string(group.transparent && has_no_alpha ? name_of(PictureFormat::png) : format);
}

bool Combining::hand_in(Group& group, const Image& image) {
  const std::string name = "baked_" + std::to_string(&group - groups_.data()) + "." + format_of(group);
  std::string error;
  auto bytes = encode_as(name, image, error);
  if (!bytes) {
    ctx_.diag.report(Diag::cannot_write, {}, name, error);
    return false;
  }
  const std::string url = ctx_.resources->add_made({name, std::make_shared<const std::string>(std::move(*bytes))});
  group.texture = scene_.add(nodes::ImageTexture, scene_.where(group.shapes[0].shape));
  scene_.set(group.texture, nodes::image_texture::url, std::vector<std::string_view>{url});
  scene_.set(group.texture, nodes::image_texture::repeatS, false);
  scene_.set(group.texture, nodes::image_texture::repeatT, false);
  return true;
}

/// What a surface shows at a place of its light, without alpha: 255.
Texel4 Combining::color(const Painted& t, const std::array<double, 3>& weights, const std::array<double, 2>& place,
                        bool alpha) const {
  const Mesh& mesh = meshes_[t.mesh];
  const drawing::Surface& s = *t.surface;
  std::optional<drawing::Texel> vertex, texel;
  if (mesh.color.present()) {
    auto c = mixed<3>(mesh.color, t.corner, weights);
    const double opacity = mesh.color.width == 4 ? mixed<4>(mesh.color, t.corner, weights)[3] : 1;
    for (double& x : c) x = std::clamp(x, 0.0, 1.0);  // weights may lie outside
    vertex = drawing::Texel{{c[0], c[1], c[2]}, std::clamp(opacity, 0.0, 1.0)};
  }
  if (s.picture.texture && mesh.texcoord.present()) {
    auto at = mixed<2>(mesh.texcoord, t.corner, weights);
    texel = s.picture.sample(s.texcoords(at[0], at[1]), t.detail);
  }
  auto base = s.base(vertex, texel);
  const SrgbTable& table = SrgbTable::get();
  const auto light = s.baked.light.sample(place, 1).color;
  auto shown = [&](double color, double lit, double emitted) {
    return table.byte(table.linear(color) * s.baked.scale * table.linear(lit) + table.linear(emitted));
  };
  const auto opacity =
      alpha ? static_cast<std::uint8_t>(std::clamp(base.alpha, 0.0, 1.0) * 255 + 0.5) : std::uint8_t{255};
  return {{shown(base.color.x, light.x, s.emissive.x), shown(base.color.y, light.y, s.emissive.y),
           shown(base.color.z, light.z, s.emissive.z), opacity}};
}

void Combining::show(const LitShape& lit, NodeId texture) {
  NodeId appearance = writable(lit.appearance, appearances_);
  if (scene_.get(lit.shape, nodes::shape::appearance) != appearance)
    scene_.set(lit.shape, nodes::shape::appearance, appearance);
  if (options_.into == CombineTarget::lightmap) {
    scene_.set(appearance, ap::lightmap, texture);
    return scene_.unset(appearance, ap::lightmapScale.slot);
  }
  if (changed_.emplace(appearance.value, 1).second) {
    NodeId transform = scene_.get(appearance, ap::lightmapTransform);
    for (auto slot : {ap::material.slot, ap::textureTransform.slot, ap::lightmap.slot, ap::lightmapTransform.slot,
                      ap::lightmapScale.slot, ap::lightmapDirection.slot})
      scene_.unset(appearance, slot);
    scene_.set(appearance, ap::texture, texture);
    if (transform) scene_.set(appearance, ap::textureTransform, transform);
  }
  NodeId geometry = geometry_for(lit);
  if (geometry != lit.geometry) scene_.set(lit.shape, nodes::shape::geometry, geometry);
}

/// Texture coordinates are those of the light then, and colours are in the picture.
NodeId Combining::geometry_for(const LitShape& lit) {
  NodeId g = writable(lit.geometry, geometries_);
  if (!changed_.emplace(g.value, 1).second) return g;
  NodeId places = scene_.get(g, ifs::lightCoord);
  const auto listed = scene_.get(g, ifs::lightCoordIndex);
  const std::vector<std::int32_t> index(listed.begin(), listed.end());
  for (auto slot : {ifs::color.slot, ifs::colorIndex.slot, ifs::colorPerVertex.slot, ifs::texCoordIndex.slot,
                    ifs::lightCoord.slot, ifs::lightCoordIndex.slot})
    scene_.unset(g, slot);
  scene_.set(g, ifs::texCoord, places);
  if (!index.empty()) scene_.set(g, ifs::texCoordIndex, index);
  return g;
}

/// The node itself if all Shapes that hold it have light, else a copy for those that have.
NodeId Combining::writable(NodeId node, std::unordered_map<std::uint32_t, NodeId>& copies) {
  if (!unlit_uses_[node.value]) return node;
  NodeId& copy = copies.try_emplace(node.value).first->second;
  if (copy) return copy;
  return copy = bake::copy_of(scene_, node);
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
  auto r = std::from_chars(text.data(), text.data() + text.size(), value);
  return r.ec == std::errc{} && r.ptr == text.data() + text.size() && value >= 1 && value <= 64;
}

std::string why_missing(CombinedFormat format) {
  PictureFormat picture{};
  return read_choice(name_of(format), picture) ? why_missing(picture) : std::string();
}

Outcome combine_lightmap(Scene& scene, const CombineLightmapOptions& options, PassContext& ctx) {
  if (!ctx.resources || !has_lightmaps(scene)) return Outcome::unchanged;
  return Combining(scene, options, ctx).run();
}

}  // namespace wrlkit
