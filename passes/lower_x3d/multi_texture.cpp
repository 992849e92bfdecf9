#include "passes/lower_x3d/multi_texture.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <optional>
#include <set>

#include "base/stop.h"
#include "light/render/texture.h"
#include "passes/lower_x3d/texture_blend.h"
#include "passes/lower_x3d/two_sides.h"
#include "scenegraph/any_node.h"
#include "scenegraph/looks/material_node.h"
#include "scenegraph/looks/texture_sampler.h"
#include "scenegraph/looks/texture_transform_node.h"
#include "scenegraph/nodes.h"
#include "scenegraph/walk.h"

namespace wrlkit::x3d {
namespace {

namespace k = nodes;
namespace multi = nodes::multi_texture;

constexpr int most_side = 4096;
constexpr double most_samples = 1 << 26;  // of all pictures of one MultiTexture together
constexpr std::size_t most_pictures = 16;

/// A picture and where it lies.
struct Sheet {
  NodeId texture;
  std::shared_ptr<const Image> image;
  TextureSampler sampler{};
  TexcoordMap places{};
  TextureBlend blend;
};

Rgba pixel(const Image& image, int x, int y) {
  const auto c = static_cast<std::size_t>(image.channels);
  const std::uint8_t* p = image.pixels.data() + (static_cast<std::size_t>(y) * image.width + x) * c;
  const auto at = [&](std::size_t i) { return p[i] / 255.0; };
  if (c < 3) return {at(0), at(0), at(0), c == 2 ? at(1) : 1};
  return {at(0), at(1), at(2), c == 4 ? at(3) : 1};
}

/// Places may be farther away than a whole number can say.
std::int64_t whole(double v) {
  constexpr double farthest = 1e15;
  return static_cast<std::int64_t>(std::clamp(v, -farthest, farthest));
}

/// Between the middles of the four pixels around the place.
Rgba sample(const Sheet& sheet, double s, double t) {
  const Image& image = *sheet.image;
  const double x = s * image.width - 0.5, y = (1 - t) * image.height - 0.5;
  const double left = std::floor(x), top = std::floor(y), u = x - left, v = y - top;
  const std::int64_t column = whole(left), row = whole(top);
  Rgba out{};
  for (int corner = 0; corner < 4; ++corner) {
    const int dx = corner & 1, dy = corner >> 1;
    const double weight = (dx ? u : 1 - u) * (dy ? v : 1 - v);
    if (weight <= 0) continue;
    const Rgba p = pixel(image, wrapped(column + dx, image.width, sheet.sampler.s),
                         wrapped(row + dy, image.height, sheet.sampler.t));
    for (std::size_t i = 0; i < 4; ++i) out[i] += weight * p[i];
  }
  return out;
}

std::optional<TexcoordMap> inverse(const TexcoordMap& m) {
  const double d = m.determinant();
  if (!(std::abs(d) > 1e-12)) return std::nullopt;
  const TexcoordMap turned{m.yy / d, -m.xy / d, -m.yx / d, m.xx / d, 0, 0};
  const Vec2 shift = turned(-m.x, -m.y);
  return TexcoordMap{turned.xx, turned.xy, turned.yx, turned.yy, shift[0], shift[1]};
}

bool is_whole(double v) { return std::abs(v - std::round(v)) < 1e-6 && std::abs(v) <= 64; }

/// Whether one period of the base holds whole periods of that one.
bool fits(const TexcoordMap& onto, const Sheet& sheet) {
  const auto borders = {sheet.sampler.s, sheet.sampler.t};
  if (std::ranges::find(borders, Wrap::clamp) == borders.end()) {
    const bool mirrored = std::ranges::find(borders, Wrap::mirror) != borders.end();
    return is_whole(onto.xx) && is_whole(onto.xy) && is_whole(onto.yx) && is_whole(onto.yy) &&
           (!mirrored || (is_whole(onto.x) && is_whole(onto.y)));
  }
  const TexcoordMap same;
  return std::abs(onto.xx - same.xx) + std::abs(onto.xy) + std::abs(onto.yx) + std::abs(onto.yy - same.yy) +
             std::abs(onto.x) + std::abs(onto.y) <
         1e-6;
}

/// What the pictures of an Appearance make together.
struct Combined {
  NodeId texture{};
  NodeId transform{};  // TextureTransform of it; none: it lies as it is
  bool lit = true;
};

class Combiner {
 public:
  Combiner(Scene& scene, PassContext& ctx) : scene_(scene), ctx_(ctx), driven_(routed_nodes(scene)) {}

  bool run() {
    const auto nodes = all_nodes(scene_);
    for (const NodeId n : nodes) note_coordinates(n);
    bool changed = false;
    for (const NodeId n : nodes)
      if (scene_.is(n, k::Appearance)) changed |= appearance(n);
    return changed;
  }

 private:
  bool is_driven(NodeId n) const { return n && n.value < driven_.size() && driven_[n.value]; }

  void note_coordinates(NodeId shape) {
    if (!scene_.is(shape, k::Shape)) return;
    const NodeId geometry = scene_.get(shape, k::shape::geometry);
    const auto slot = geometry ? scene_.type(geometry).find("texCoord", Dialect::x3d) : std::nullopt;
    const Value* v = slot ? scene_.find(geometry, *slot) : nullptr;
    if (!v || v->is || v->type != FieldType::SFNode || !scene_.is(v->node, k::MultiTextureCoordinate)) return;
    const auto all = scene_.get(v->node, k::multi_texture_coordinate::texCoord);
    const bool same = std::ranges::all_of(all, [&](NodeId c) { return c == all[0] || equal_places(c, all[0]); });
    if (!same) apart_.insert(scene_.get(shape, k::shape::appearance));
  }

  bool equal_places(NodeId a, NodeId b) const {
    if (!scene_.is(a, k::TextureCoordinate) || !scene_.is(b, k::TextureCoordinate)) return false;
    return std::ranges::equal(scene_.get(a, k::texture_coordinate::point), scene_.get(b, k::texture_coordinate::point));
  }

  bool appearance(NodeId n) {
    namespace a = k::appearance;
    const NodeId texture = scene_.get(n, a::texture), material = scene_.get(n, a::material);
    if (!scene_.is(texture, k::MultiTexture) || apart_.contains(n) || is_driven(texture) || is_driven(n)) return false;
    const NodeId transform = scene_.get(n, a::textureTransform);
    const auto [at, is_new] = made_.try_emplace({texture, transform});
    if (is_new) at->second = combined(texture, transform);
    const Combined& made = at->second;
    if (!made.texture) return false;
    if (made.transform)
      scene_.set(n, a::textureTransform, made.transform);
    else if (transform)
      scene_.unset(n, a::textureTransform.slot);
    put_on(n, material, made);
    return true;
  }

  /// A picture under light is its material's, which multiplies it; one that takes the place of light is not lit.
  void put_on(NodeId appearance, NodeId material, const Combined& made) {
    namespace a = k::appearance;
    scene_.set(appearance, a::texture, made.texture);
    if (!made.lit) {
      if (material) scene_.unset(appearance, a::material.slot);
      return;
    }
    const auto said = read_material(scene_, material);
    if (!said || is_driven(material)) return;
    NodeId& own = own_[{material, made.texture}];
    if (!own) {
      own = scene_.add(scene_.type_id(material), scene_.where(material));
      scene_.set_name(own, scene_.name(material));
      scene_.set_fields(own, scene_.copy_of_fields(material));
      scene_.set(own, scene_.make(FieldType::SFNode, said->color_picture_slot, made.texture));
    }
    scene_.set(appearance, a::material, own);
    scene_.unset(appearance, a::texture.slot);
  }

  Combined combined(NodeId n, NodeId transform) {
    const auto sheets = sheets_of(n, transform);
    if (!sheets || sheets->empty()) return {};
    for (std::size_t base = 0; base < sheets->size(); ++base)
      if (const auto onto = onto_base(*sheets, base)) return paint(n, *sheets, base, *onto);
    return {};
  }

  /// The pictures that are laid over one another. None: some cannot be had, or may change.
  std::optional<std::vector<Sheet>> sheets_of(NodeId n, NodeId transform) {
    const auto held = scene_.get(n, multi::texture);
    if (held.size() > most_pictures) return std::nullopt;
    std::vector<Sheet> out;
    for (std::size_t i = 0; i < held.size(); ++i) {
      Sheet sheet{.texture = held[i], .image = nullptr, .blend = blend_of(n, i)};
      if (sheet.blend.is_off()) continue;
      const NodeId moved = transform_of(transform, i);
      if (is_driven(held[i]) || is_driven(moved) || !read(sheet)) return std::nullopt;
      if (moved && !scene_.is(moved, k::TextureTransform)) return std::nullopt;
      sheet.places = read_texture_transform(scene_, moved).map();
      out.push_back(std::move(sheet));
    }
    return out;
  }

  TextureBlend blend_of(NodeId n, std::size_t i) const {
    const auto word = [&](auto key) {
      const auto words = scene_.get(n, key);
      return i < words.size() ? words[i] : std::string_view();
    };
    return {word(multi::mode), word(multi::source), word(multi::function)};
  }

  NodeId transform_of(NodeId transform, std::size_t i) const {
    if (!scene_.is(transform, k::MultiTextureTransform)) return transform;
    const auto all = scene_.get(transform, k::multi_texture_transform::textureTransform);
    return i < all.size() ? all[i] : NodeId{};
  }

  bool read(Sheet& sheet) {
    if (scene_.is(sheet.texture, k::PixelTexture)) {
      namespace f = k::pixel_texture;
      sheet.image = std::make_shared<const Image>(drawing::image_of(scene_.get(sheet.texture, f::image)));
    } else if (scene_.is(sheet.texture, k::ImageTexture)) {
      namespace f = k::image_texture;
      const auto urls = scene_.get(sheet.texture, f::url);
      sheet.image = ctx_.resources->image(urls, scene_.where(sheet.texture), ctx_.diag);
    }
    sheet.sampler = read_sampler(scene_, sheet.texture);
    return sheet.image && sheet.image->width > 0 && sheet.image->height > 0;
  }

  /// Places of each picture by those of that one.
  std::optional<std::vector<TexcoordMap>> onto_base(const std::vector<Sheet>& sheets, std::size_t base) const {
    const auto back = inverse(sheets[base].places);
    if (!back) return std::nullopt;
    std::vector<TexcoordMap> onto;
    for (const Sheet& sheet : sheets) {
      onto.push_back(sheet.places * *back);
      const bool same_border = sheet.sampler.s == sheets[base].sampler.s && sheet.sampler.t == sheets[base].sampler.t;
      if (!same_border || !fits(onto.back(), sheet)) return std::nullopt;
    }
    return onto;
  }

  Combined paint(NodeId n, const std::vector<Sheet>& sheets, std::size_t base, const std::vector<TexcoordMap>& onto) {
    const Image shape = size_of(sheets, onto);
    const auto color = scene_.get(n, multi::color);
    const Rgba factor{color[0], color[1], color[2], scene_.get(n, multi::alpha)};
    Image out = shape;
    Blended all;
    for (int y = 0; y < out.height; ++y) {
      check_stop();
      for (int x = 0; x < out.width; ++x) {
        const double s = (x + 0.5) / out.width, t = 1 - (y + 0.5) / out.height;
        all = {};
        for (std::size_t i = 0; i < sheets.size(); ++i) {
          const Vec2 place = onto[i](s, t);
          all = sheets[i].blend(sample(sheets[i], place[0], place[1]), all, factor);
        }
        for (const double v : all.value) out.pixels.push_back(static_cast<std::uint8_t>(std::lround(v * 255)));
      }
    }
    if (!all.exact)
      ctx_.diag.report(Diag::drawn_otherwise, scene_.where(n), "MultiTexture",
                       "with light on all of its pictures together");
    return stored(n, std::move(out), sheets[base], all.lit);
  }

  /// Four channels, and as many pixels as the finest of the pictures has in a period of the base.
  static Image size_of(const std::vector<Sheet>& sheets, const std::vector<TexcoordMap>& onto) {
    double width = 1, height = 1;
    for (std::size_t i = 0; i < sheets.size(); ++i) {
      const double w = sheets[i].image->width, h = sheets[i].image->height;
      width = std::max({width, w * std::abs(onto[i].xx), h * std::abs(onto[i].yx)});
      height = std::max({height, w * std::abs(onto[i].xy), h * std::abs(onto[i].yy)});
    }
    width = std::min<double>(width, most_side);
    height = std::min<double>(height, most_side);
    const double too_many = width * height * static_cast<double>(sheets.size()) / most_samples;
    const double shrink = too_many > 1 ? std::sqrt(too_many) : 1;
    return {std::max(1, static_cast<int>(width / shrink)), std::max(1, static_cast<int>(height / shrink)), 4, {}};
  }

  Combined stored(NodeId n, Image image, const Sheet& base, bool lit) {
    bool opaque = true;
    for (std::size_t i = 3; i < image.pixels.size(); i += 4) opaque &= image.pixels[i] == 255;
    if (opaque) image = with_channels(std::move(image), 3);
    std::string fault;
    auto png = encode_png(image, fault);
    if (!png) return {};
    const auto name = scene_.name(n).empty() ? std::string("multitexture") : std::string(scene_.name(n));
    const auto url = ctx_.resources->add_made({name + ".png", std::make_shared<const std::string>(std::move(*png))});
    namespace f = k::image_texture;
    Combined made{scene_.add(k::ImageTexture, scene_.where(n)), {}, lit};
    scene_.set_name(made.texture, scene_.name(n));
    scene_.set(made.texture, f::url, std::vector<std::string_view>{url});
    if (const NodeId properties = texture_properties(scene_, base.texture)) {
      scene_.set(made.texture, f::textureProperties, properties);
    } else {
      if (base.sampler.s == Wrap::clamp) scene_.set(made.texture, f::repeatS, false);
      if (base.sampler.t == Wrap::clamp) scene_.set(made.texture, f::repeatT, false);
    }
    if (base.places == TexcoordMap{}) return made;
    if (const auto moved = texture_transform_of(base.places)) {
      namespace t = k::texture_transform;
      made.transform = scene_.add(k::TextureTransform, scene_.where(n));
      scene_.set(made.transform, t::scale, moved->scale, t::rotation, moved->rotation, t::translation,
                 moved->translation);
    }
    return made;
  }

  Scene& scene_;
  PassContext& ctx_;
  std::vector<char> driven_;
  std::set<NodeId> apart_;  // Appearances of geometry on which each picture has coordinates of its own
  std::map<std::pair<NodeId, NodeId>, Combined> made_;  // by texture and transform
  std::map<std::pair<NodeId, NodeId>, NodeId> own_;     // materials with a picture, by material and picture
};

}  // namespace

bool combine_multi_textures(Scene& scene, PassContext& ctx) {
  if (!ctx.resources || !any_node(scene, [&](NodeId n) { return scene.is(n, nodes::MultiTexture); })) return false;
  return Combiner(scene, ctx).run();
}

}  // namespace wrlkit::x3d
