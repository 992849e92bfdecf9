#include "passes/lightmap/store.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <stdexcept>
#include <unordered_set>

#include "base/image/image.h"
#include "base/image/srgb_table.h"
#include "geometry/geometry.h"
#include "passes/lightmap/copy_node.h"
#include "passes/lightmap/polygons.h"
#include "passes/weld/value_table.h"
#include "scenegraph/nodes.h"

namespace wrlkit::bake {
namespace {

std::uint8_t byte(double v) { return static_cast<std::uint8_t>(std::lround(255 * std::clamp(v, 0.0, 1.0))); }

/// The picture of a canvas, its highest row first; `code` makes a byte of a number.
template <class F>
Image picture(const Canvas& c, F&& code) {
  Image out{c.width, c.height, 3, {}};
  out.pixels.reserve(3 * c.texels.size());
  for (int y = c.height; y-- > 0;)
    for (int x = 0; x < c.width; ++x) {
      const Rgb& t = c.texels[std::size_t(y) * c.width + x];
      for (float v : {t.r, t.g, t.b}) out.pixels.push_back(code(v));
    }
  return out;
}

FloatImage raw(const Canvas& c) {
  FloatImage out{c.width, c.height, 3, {}};
  out.pixels.reserve(3 * c.texels.size());
  for (int y = c.height; y-- > 0;)
    for (int x = 0; x < c.width; ++x) {
      const Rgb& t = c.texels[std::size_t(y) * c.width + x];
      out.pixels.insert(out.pixels.end(), {t.r, t.g, t.b});
    }
  return out;
}

/// What becomes white: at least 1, so that dim scenes stay dim.
double white_level(const std::vector<BakedPage>& pages, double exposure) {
  std::vector<float> brightest;
  for (const auto& p : pages)
    for (const Rgb& t : p.light.texels) brightest.push_back(std::max({t.r, t.g, t.b}));
  if (brightest.empty()) return 1;
  const auto at = brightest.begin() + static_cast<std::ptrdiff_t>((brightest.size() - 1) * 0.999);
  std::ranges::nth_element(brightest, at);
  return std::max(1.0, exposure * double{*at});
}

}  // namespace

Storing::Storing(Scene& scene, const std::vector<BakedPage>& pages, const StoreOptions& options, PassContext& ctx)
    : scene_(scene), options_(options), ctx_(ctx), scale_(white_level(pages, options.exposure)) {
  for (std::size_t i = 0; i < pages.size(); ++i) add_page(i, pages[i]);
}

void Storing::place(Part& part, const std::vector<float>& coords, NodeId geometry) {
  ValueTable<float, 2> table;
  table.start(coords.size() / 2);
  Attribute& to = part.mesh.lightcoord;
  to.index.clear();
  for (std::size_t c = 0; c < coords.size(); c += 2) to.index.push_back(table.number(&coords[c]));
  to.values = std::move(table.values);
  if (part.mesh.cut.empty()) return store_mesh(scene_, geometry, part.mesh);
  Mesh whole = part.mesh;
  join_cut_faces(whole);
  store_mesh(scene_, geometry, whole);
}

/// Shapes with places of their own share an Appearance where they did and lie on one page.
NodeId Storing::own_appearance(NodeId shape, const ShapePlace& place) {
  const NodeId there = scene_.get(shape, nodes::shape::appearance);
  auto known = of_.find({there.value, place.page});
  if (place.own_coords && known != of_.end()) return known->second;
  NodeId mine = there;
  if (!taken_.insert(there.value).second) mine = copy_of(scene_, there);
  if (place.own_coords) of_[{there.value, place.page}] = mine;
  return mine;
}

void Storing::light(NodeId shape, const ShapePlace& place, const PageLayout& page) {
  namespace f = nodes::appearance;
  const NodeId appearance = own_appearance(shape, place);
  scene_.set(shape, nodes::shape::appearance, appearance);
  scene_.set(appearance, f::lightmap, lightmaps_[place.page], f::lightmapScale, scale_);
  if (!directions_[place.page].empty()) scene_.set(appearance, f::lightmapDirection, directions_[place.page]);
  if (place.own_coords)
    scene_.unset(appearance, f::lightmapTransform.slot);
  else
    scene_.set(appearance, f::lightmapTransform, transform(place, page));
}

void Storing::add_page(std::size_t i, const BakedPage& page) {
  const std::string name = "lightmap_" + std::to_string(i);
  const double scale = scale_ / options_.exposure;
  lightmaps_.push_back(texture(
      name, picture(page.light, [scale, &table = SrgbTable::get()](float v) { return table.byte(v / scale); })));
  auto& directions = directions_.emplace_back();
  const char* axes[] = {"_x", "_y", "_z"};
  for (std::size_t k = 0; k < page.direction.size(); ++k)
    directions.push_back(
        texture(name + axes[k], picture(page.direction[k], [](float v) { return byte(0.5 + 0.5 * v); })));
  if (!options_.exr) return;
  std::string error;
  auto bytes = encode_exr(raw(page.light), error);
  if (!bytes) throw std::runtime_error(error);
  ctx_.resources->add_made({name + ".exr", std::make_shared<const std::string>(std::move(*bytes)), true});
}

NodeId Storing::texture(const std::string& name, const Image& image) {
  namespace f = nodes::image_texture;
  std::string error;
  const std::string file = name + "." + options_.extension;
  auto bytes = encode_as(file, image, error);
  if (!bytes) throw std::runtime_error(error);
  const std::string url =
      ctx_.resources->add_made({file, std::make_shared<const std::string>(std::move(*bytes)), false});
  const NodeId n = scene_.add(nodes::ImageTexture);
  scene_.set(n, f::url, std::vector<std::string_view>{url}, f::repeatS, false, f::repeatT, false);
  return n;
}

/// ISO/IEC 14772-1, 6.49: moved, then turned, then scaled.
NodeId Storing::transform(const ShapePlace& p, const PageLayout& page) {
  namespace f = nodes::texture_transform;
  constexpr double quarter = std::numbers::pi / 2;
  const double x = p.x / p.unit, y = p.y / p.unit;
  const double moved[4][2] = {{x, y}, {y, -x}, {-x, -y}, {-y, x}};  // turned back
  const auto& m = moved[p.quarter_turns & 3];
  const NodeId n = scene_.add(nodes::TextureTransform);
  scene_.set(n, f::rotation, quarter * p.quarter_turns, f::scale, Vec2{p.unit / page.width, p.unit / page.height},
             f::translation, Vec2{m[0], m[1]});
  return n;
}

void store(Scene& scene, std::vector<Part>& parts, const Layout& layout, const drawing::Stage& stage,
           const std::vector<BakedPage>& pages, const StoreOptions& options, PassContext& ctx) {
  Storing storing(scene, pages, options, ctx);
  std::unordered_set<std::uint32_t> taken;
  for (std::size_t i = 0; i < parts.size(); ++i) {
    const NodeId shared = parts[i].geometry,
                 geometry = taken.insert(shared.value).second ? shared : copy_of(scene, shared);
    auto coords = layout.coords(i);
    face_in(parts[i], coords);
    storing.place(parts[i], coords, geometry);
    for (std::size_t k = 0; k < parts[i].uses.size(); ++k) {
      const NodeId shape = stage.uses[parts[i].uses[k]].shape;
      const ShapePlace place = layout.place(i, k);
      if (geometry != shared) scene.set(shape, nodes::shape::geometry, geometry);
      storing.light(shape, place, layout.pages()[place.page]);
    }
  }
}

}  // namespace wrlkit::bake
