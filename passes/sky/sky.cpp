#include "passes/sky/sky.h"

#include "passes/sky/dome.h"
#include "passes/sky/panorama.h"
#include "scenegraph/nodes.h"
#include "scenegraph/walk.h"

namespace wrlkit {
namespace {

namespace b = nodes::background;
namespace t = nodes::texture_background;

constexpr double half_edge = 0.55;  // of the cube: its corners lie within the sphere of radius 1

/// One side of the cube of pictures: what is to the right and up in it, seen from the centre.
struct Side {
  FieldKey<FieldType::MFString> url;
  FieldKey<FieldType::SFNode> texture;
  Vec3 ahead, right, up;
};
constexpr Side sides[] = {
    {b::frontUrl, t::frontTexture, {0, 0, -1}, {1, 0, 0}, {0, 1, 0}},
    {b::backUrl, t::backTexture, {0, 0, 1}, {-1, 0, 0}, {0, 1, 0}},
    {b::leftUrl, t::leftTexture, {-1, 0, 0}, {0, 0, -1}, {0, 1, 0}},
    {b::rightUrl, t::rightTexture, {1, 0, 0}, {0, 0, 1}, {0, 1, 0}},
    {b::topUrl, t::topTexture, {0, 1, 0}, {1, 0, 0}, {0, 0, 1}},
    {b::bottomUrl, t::bottomTexture, {0, -1, 0}, {1, 0, 0}, {0, 0, -1}},
};

class Sky {
 public:
  Sky(Scene& scene, NodeId background) : scene_(scene), background_(background) {}

  bool is_made() const {
    return !(has_textures() ? scene_.get(background_, t::sky) : scene_.get(background_, b::sky)).empty();
  }

  void make() {
    const bool textures = has_textures();
    std::vector<NodeId> shapes{dome(textures)};
    for (const Side& side : sides)
      if (const NodeId picture = textures ? scene_.get(background_, side.texture) : image(side.url))
        shapes.push_back(square(side, picture));
    scene_.set(background_, scene_.make(FieldType::MFNode, textures ? t::sky.slot : b::sky.slot, shapes));
  }

 private:
  bool has_textures() const { return scene_.is(background_, nodes::TextureBackground); }
  NodeId add(TypeId type) { return scene_.add(type, scene_.where(background_)); }

  Gradient gradient(FieldKey<FieldType::MFColor> color, FieldKey<FieldType::MFFloat> angle) const {
    return {scene_.get(background_, color), scene_.get(background_, angle)};
  }

  /// A Shape without a Material is not lit.
  NodeId shape(NodeId geometry, NodeId appearance = {}) {
    const NodeId n = add(nodes::Shape);
    scene_.set(n, nodes::shape::geometry, geometry);
    if (appearance) scene_.set(n, nodes::shape::appearance, appearance);
    return n;
  }

  NodeId face_set(const std::vector<double>& points, const std::vector<std::int32_t>& corners) {
    const NodeId coord = add(nodes::Coordinate), faces = add(nodes::IndexedFaceSet);
    scene_.set(coord, nodes::coordinate::point, points);
    scene_.set(faces, nodes::indexed_face_set::coord, coord, nodes::indexed_face_set::coordIndex, corners);
    return faces;
  }

  NodeId dome(bool textures) {
    const Dome d = textures ? make_dome(gradient(t::skyColor, t::skyAngle), gradient(t::groundColor, t::groundAngle))
                            : make_dome(gradient(b::skyColor, b::skyAngle), gradient(b::groundColor, b::groundAngle));
    const NodeId faces = face_set(d.points, d.corners), color = add(nodes::Color);
    scene_.set(color, nodes::color::color, d.colors);
    scene_.set(faces, nodes::indexed_face_set::color, color);
    return shape(faces);
  }

  /// The picture of a url, which has no seam where it ends.
  NodeId image(FieldKey<FieldType::MFString> key) {
    const auto urls = scene_.get(background_, key);
    if (urls.empty()) return {};
    const NodeId picture = add(nodes::ImageTexture);
    scene_.set(picture, nodes::image_texture::url, urls, nodes::image_texture::repeatS, false,
               nodes::image_texture::repeatT, false);
    return picture;
  }

  NodeId square(const Side& side, NodeId picture) {
    std::vector<double> points;
    for (auto [x, y] : {std::pair{-1, -1}, {1, -1}, {1, 1}, {-1, 1}})
      for (std::size_t k = 0; k < 3; ++k)
        points.push_back(half_edge * (side.ahead[k] + x * side.right[k] + y * side.up[k]));
    const NodeId faces = face_set(points, {0, 1, 2, 3, -1}), places = add(nodes::TextureCoordinate),
                 appearance = add(nodes::Appearance);
    scene_.set(places, nodes::texture_coordinate::point, std::vector<double>{0, 0, 1, 0, 1, 1, 0, 1});
    scene_.set(faces, nodes::indexed_face_set::texCoord, places);
    scene_.set(appearance, nodes::appearance::texture, picture);
    return shape(faces, appearance);
  }

  Scene& scene_;
  NodeId background_;
};

/// The first that is shown: a browser binds it when it has loaded the world.
NodeId bound_background(const Scene& scene) {
  std::vector<char> met(scene.node_count(), 0);
  std::vector<NodeId> open(scene.main.roots.rbegin(), scene.main.roots.rend());
  while (!open.empty()) {
    const NodeId n = open.back();
    open.pop_back();
    if (!n || std::exchange(met[n.value], 1)) continue;
    if (scene.is(n, nodes::Background) || scene.is(n, nodes::TextureBackground)) return n;
    const auto below = shown_children(scene, n);
    open.insert(open.end(), below.rbegin(), below.rend());
  }
  return {};
}

}  // namespace

Outcome sky(Scene& scene, const SkyOptions& options, PassContext& ctx) {
  const NodeId background = bound_background(scene);
  if (!background) {
    ctx.diag.report(Diag::no_background, {});
    return Outcome::unchanged;
  }
  Sky made(scene, background);
  if (made.is_made()) return Outcome::unchanged;
  made.make();
  if (options.picture && ctx.resources)
    if (const auto png = sky_panorama(scene, ctx)) ctx.resources->add_made({"sky.png", png, true});
  return Outcome::changed;
}

}  // namespace wrlkit
