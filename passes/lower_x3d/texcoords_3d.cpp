#include "passes/lower_x3d/texcoords_3d.h"

#include <map>
#include <set>
#include <utility>

#include "base/math/matrix.h"
#include "geometry/geometry.h"
#include "geometry/tessellation.h"
#include "scenegraph/any_node.h"
#include "scenegraph/driven.h"
#include "scenegraph/nodes.h"
#include "scenegraph/walk.h"

namespace wrlkit::x3d {
namespace {

namespace k = nodes;

bool is_transform(const Scene& scene, NodeId n) {
  return scene.is(n, k::TextureTransform3D) || scene.is(n, k::TextureTransformMatrix3D);
}

bool has_depth(const Scene& scene, NodeId coord) {
  return scene.is(coord, k::TextureCoordinate3D) || scene.is(coord, k::TextureCoordinate4D);
}

/// As for a flat TextureTransform: -C S R C T, on rows of numbers for a matrix (19775-1, 33.4).
Matrix matrix_of_transform(const Scene& scene, NodeId n) {
  if (scene.is(n, k::TextureTransformMatrix3D)) {
    const Value& v = scene.value(n, k::texture_transform_matrix3d::matrix.slot);
    return matrix_of_columns(v.number_span().data());
  }
  if (!scene.is(n, k::TextureTransform3D)) return {};
  namespace f = k::texture_transform3d;
  const Vec3 c = scene.get(n, f::center), t = scene.get(n, f::translation);
  return translation_matrix({-c[0], -c[1], -c[2]}) * scale_matrix(scene.get(n, f::scale)) *
         rotation_matrix(scene.get(n, f::rotation)) * translation_matrix(c + t);
}

/// Places in space; flat ones have depth 0.
std::vector<Vec3> places_of(const Scene& scene, NodeId coord) {
  std::vector<Vec3> out;
  const auto take = [&](auto numbers, std::size_t width, auto place) {
    for (std::size_t i = 0; i + width <= numbers.size(); i += width) out.push_back(place(&numbers[i]));
  };
  if (scene.is(coord, k::TextureCoordinate3D))
    take(scene.get(coord, k::texture_coordinate3d::point), 3, [](const double* p) { return wrlkit::vec3(p); });
  else if (scene.is(coord, k::TextureCoordinate4D))
    take(scene.get(coord, k::texture_coordinate4d::point), 4, [](const double* p) {
      const double w = p[3] != 0 ? 1 / p[3] : 1;
      return w * wrlkit::vec3(p);
    });
  else if (scene.is(coord, k::TextureCoordinate))
    take(scene.get(coord, k::texture_coordinate::point), 2, [](const double* p) { return Vec3{p[0], p[1], 0}; });
  return out;
}

class Flattener {
 public:
  Flattener(Scene& scene, PassContext& ctx) : scene_(scene), ctx_(ctx), driven_(driven_geometry(scene)) {}

  bool run() {
    const auto all = all_nodes(scene_);
    for (const NodeId n : all) note(asked_of(n));
    for (const NodeId n : all) shape(n, asked_of(n));
    for (const NodeId n : moved_) scene_.unset(n, k::appearance::textureTransform.slot);
    return changed_;
  }

 private:
  /// What a Shape asks for; no geometry: nothing that can be done.
  struct Asked {
    NodeId geometry, look, transform;
  };

  Asked asked_of(NodeId n) const {
    namespace a = k::appearance;
    if (!scene_.is(n, k::Shape)) return {};
    const NodeId look = scene_.get(n, k::shape::appearance), geometry = scene_.get(n, k::shape::geometry);
    const bool has_look = scene_.is(look, k::Appearance);
    if (!geometry || (has_look && is_deep(scene_.get(look, a::texture))) || is_driven(geometry)) return {};
    const NodeId asked = has_look ? scene_.get(look, a::textureTransform) : NodeId{};
    return {geometry, look, is_transform(scene_, asked) ? asked : NodeId{}};
  }

  /// Shapes that ask for different places of one geometry need copies of it.
  void note(const Asked& asked) {
    if (!asked.geometry) return;
    const auto [first, is_new] = transform_of_.try_emplace(asked.geometry, asked.transform);
    if (!is_new && first->second != asked.transform) several_.insert(asked.geometry);
    if (!asked.transform) plain_.insert(asked.geometry);
  }

  void shape(NodeId n, const Asked& asked) {
    if (!asked.geometry) return;
    const auto slot =
        is_geometry(scene_, asked.geometry) ? scene_.type(asked.geometry).find("texCoord", Dialect::x3d) : std::nullopt;
    const auto [made, is_new] = made_.try_emplace({asked.geometry, asked.transform}, asked.geometry);
    if (is_new) {
      const auto coord_of = [&](NodeId geometry) { return slot ? scene_.value(geometry, *slot).node : NodeId{}; };
      if (!asked.transform && !has_depth(scene_, coord_of(asked.geometry))) return;
      if (several_.contains(asked.geometry)) made->second = own_of(asked.geometry);
      const Matrix m = matrix_of_transform(scene_, asked.transform);
      const NodeId coord = coord_of(made->second);
      coord ? set_places(made->second, *slot, coord, m) : make_places(made->second, m);
      changed_ = true;
    }
    if (asked.transform) moved_.insert(asked.look);
    if (made->second != asked.geometry) scene_.set(n, k::shape::geometry, made->second);
  }

  /// A picture of three dimensions.
  bool is_deep(NodeId n) const {
    return scene_.is(n, k::PixelTexture3D) || scene_.is(n, k::ImageTexture3D) || scene_.is(n, k::ComposedTexture3D) ||
           scene_.is(n, k::ImageTextureAtlas);
  }
  bool is_driven(NodeId n) const { return n.value < driven_.size() && driven_[n.value]; }

  /// What a geometry was before its places were moved.
  struct Before {
    TypeId type;
    std::vector<Value> fields;
  };

  /// Itself for the first transformation, unless some Shape shows it as it is; then copies of what it was.
  NodeId own_of(NodeId geometry) {
    const auto [before, is_first] =
        before_.try_emplace(geometry, Before{scene_.type_id(geometry), scene_.copy_of_fields(geometry)});
    if (is_first && !plain_.contains(geometry)) return geometry;
    const NodeId out = scene_.add(before->second.type, scene_.where(geometry));
    scene_.set_fields(out, before->second.fields);
    return out;
  }

  void set_places(NodeId geometry, std::uint16_t slot, NodeId coord, const Matrix& m) {
    std::vector<double> flat;
    for (const Vec3& p : places_of(scene_, coord)) {
      const Vec3 moved = m.point(p);
      flat.insert(flat.end(), {moved[0], moved[1]});
    }
    if (flat.empty()) return;
    const NodeId to = scene_.add(k::TextureCoordinate, scene_.where(coord));
    scene_.set(to, k::texture_coordinate::point, flat);
    scene_.set(geometry, scene_.make(FieldType::SFNode, slot, to));
  }

  /// The default ones of its form or its box.
  void make_places(NodeId geometry, const Matrix& m) {
    mesh_.clear();
    MeshJob job{scene_, geometry, mesh_, scratch_, ctx_, true};
    make_mesh(job, {.triangles = false, .texcoords = true});
    if (mesh_.kind != Mesh::Kind::faces || !mesh_.texcoord.present()) return;
    auto& values = mesh_.texcoord.values;
    for (std::size_t i = 0; i + 1 < values.size(); i += 2) {
      const Vec3 moved = m.point({values[i], values[i + 1], 0});
      values[i] = static_cast<float>(moved[0]);
      values[i + 1] = static_cast<float>(moved[1]);
    }
    store_mesh(scene_, geometry, mesh_);
  }

  Scene& scene_;
  PassContext& ctx_;
  std::vector<char> driven_;
  std::map<NodeId, NodeId> transform_of_;  // the first one of each geometry
  std::set<NodeId> plain_;                 // that a Shape shows without one
  std::map<NodeId, Before> before_;
  std::set<NodeId> several_;                          // geometries with more than one
  std::map<std::pair<NodeId, NodeId>, NodeId> made_;  // by geometry and transformation: the geometry to show
  std::set<NodeId> moved_;                            // Appearances
  Mesh mesh_;
  MeshScratch scratch_;
  bool changed_ = false;
};

}  // namespace

bool flatten_texcoords(Scene& scene, PassContext& ctx) {
  if (!any_node(scene, [&](NodeId n) { return is_transform(scene, n) || has_depth(scene, n); })) return false;
  return Flattener(scene, ctx).run();
}

}  // namespace wrlkit::x3d
