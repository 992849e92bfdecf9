#include "passes/lower_x3d/product.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <set>
#include <tuple>

#include "base/image/image.h"
#include "scenegraph/looks/picture_color.h"
#include "scenegraph/nodes.h"
#include "scenegraph/walk.h"

namespace wrlkit::x3d {
namespace {

constexpr Vec3 white{1, 1, 1};

/// 0: that cannot be known, as of a film.
int channels_of(const Scene& scene, NodeId texture, PassContext& ctx) {
  if (scene.is(texture, nodes::PixelTexture)) {
    const auto image = scene.get(texture, nodes::pixel_texture::image);
    return image.size() > 2 ? image[2] : 0;
  }
  if (!scene.is(texture, nodes::ImageTexture) || !ctx.resources) return 0;
  Diagnostics silent(ctx.diag.shared_sources());  // showing the picture reports that it is missing
  const auto blob = ctx.resources->bytes(scene.get(texture, nodes::image_texture::url), scene.where(texture), silent);
  const auto header = blob ? read_image_header(blob->bytes, blob->name) : std::nullopt;
  return header ? header->channels : 0;
}

bool in_color(int channels) { return channels != 1 && channels != 2; }

/// Appearances of geometry that has colours of its own.
std::set<NodeId> colored_appearances(const Scene& scene) {
  std::set<NodeId> out;
  for (NodeId shape : all_nodes(scene)) {
    const NodeId geometry = scene.is(shape, nodes::Shape) ? scene.get(shape, nodes::shape::geometry) : NodeId{};
    const auto slot = geometry ? scene.type(geometry).find("color", Dialect::x3d) : std::nullopt;
    const Value* v = slot ? scene.find(geometry, *slot) : nullptr;
    if (v && !v->is && v->type == FieldType::SFNode && v->node) out.insert(scene.get(shape, nodes::shape::appearance));
  }
  return out;
}

class Products {
 public:
  Products(Scene& scene, PassContext& ctx) : scene_(scene), ctx_(ctx), colored_(colored_appearances(scene)) {}

  bool run() {
    std::vector<NodeId> materials;
    for (NodeId n : all_nodes(scene_))
      if (scene_.is(n, nodes::Appearance) && multiplies_picture(scene_, n)) {
        appearance(n);
        materials.push_back(scene_.get(n, nodes::appearance::material));
      }
    for (NodeId m : materials) forget_picture(m);
    return changed_;
  }

 private:
  void appearance(NodeId n) {
    const NodeId texture = scene_.get(n, nodes::appearance::texture);
    if (!texture || !in_color(channels_of(scene_, texture, ctx_))) return;
    const bool by_vertex = colored_.contains(n);
    const auto material = material_of(scene_, n);
    const Vec3 color = material ? material->color : white;
    if (!by_vertex && color == white) return;
    if (by_vertex || !scene_.is(texture, nodes::PixelTexture))
      return ctx_.diag.report(Diag::no_vrml97_product, scene_.where(texture));
    scene_.set(n, nodes::appearance::texture, painted(texture, color));
    changed_ = true;
  }

  /// The same pixels under that colour, once for each.
  NodeId painted(NodeId texture, const Vec3& color) {
    auto& n = painted_[{texture, color}];
    if (n) return n;
    n = scene_.add(nodes::PixelTexture, scene_.where(texture));
    scene_.set_name(n, scene_.name(texture));
    scene_.set_fields(n, scene_.copy_of_fields(texture));
    const auto old = scene_.get(texture, nodes::pixel_texture::image);
    std::vector<std::int32_t> image(old.begin(), old.end());
    const int alpha = image[2] == 4 ? 8 : 0;  // bits below red, green and blue
    for (std::size_t i = 3; i < image.size(); ++i) {
      auto pixel = static_cast<std::uint32_t>(image[i]);
      for (int k = 0; k < 3; ++k) {
        const int shift = alpha + 8 * (2 - k);
        const double c = std::round((pixel >> shift & 0xff) * std::clamp(color[static_cast<std::size_t>(k)], 0.0, 1.0));
        pixel = (pixel & ~(0xffu << shift)) | static_cast<std::uint32_t>(c) << shift;
      }
      image[i] = static_cast<std::int32_t>(pixel);
    }
    scene_.set(n, nodes::pixel_texture::image, image);
    return n;
  }

  /// It is its Appearance's.
  void forget_picture(NodeId material) {
    const auto said = read_material(scene_, material);
    if (!said || !said->color_picture) return;
    scene_.unset(material, said->color_picture_slot);
    changed_ = true;
  }

  Scene& scene_;
  PassContext& ctx_;
  std::set<NodeId> colored_;
  std::map<std::tuple<NodeId, Vec3>, NodeId> painted_;
  bool changed_ = false;
};

}  // namespace

bool lower_products(Scene& scene, PassContext& ctx) { return Products(scene, ctx).run(); }

bool whiten_replaced(Scene& scene, PassContext& ctx) {
  bool changed = false;
  std::map<NodeId, NodeId> white_of;
  for (NodeId n : all_nodes(scene)) {
    if (!scene.is(n, nodes::Appearance) || multiplies_picture(scene, n)) continue;
    const NodeId texture = scene.get(n, nodes::appearance::texture),
                 material = scene.get(n, nodes::appearance::material);
    if (!texture || !scene.is(material, nodes::Material) ||
        scene.get(material, nodes::material::diffuseColor) == white || !in_color(channels_of(scene, texture, ctx)))
      continue;
    NodeId& copy = white_of[material];
    if (!copy) {
      copy = scene.add(nodes::Material, scene.where(material));
      scene.set_name(copy, scene.name(material));
      scene.set_fields(copy, scene.copy_of_fields(material));
      scene.set(copy, nodes::material::diffuseColor, white);
      ctx.diag.report(Diag::no_x3d_color, scene.where(material));
    }
    scene.set(n, nodes::appearance::material, copy);
    changed = true;
  }
  return changed;
}

}  // namespace wrlkit::x3d
