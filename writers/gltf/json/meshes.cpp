#include "writers/gltf/json/lists.h"

#include <algorithm>

#include "scenegraph/nodes.h"
#include "scenegraph/walk.h"
#include "writers/gltf/json/part.h"

namespace wrlkit::gltf {
namespace {

/// Forms whose numbers express more than their triangles do.
bool is_parametric(const Scene& scene, NodeId n) {
  constexpr TypeId types[] = {nodes::Box,       nodes::Cone,   nodes::Cylinder, nodes::ElevationGrid,
                              nodes::Extrusion, nodes::Sphere, nodes::Text};
  return std::ranges::find(types, scene.type_id(n)) != std::end(types);
}

/// Cut as a part was that it was recognised in: only fields of our own express it.
bool is_recognised(const Scene& scene, NodeId n) {
  if (scene.is(n, nodes::Cylinder)) return scene.get(n, nodes::cylinder::segments) > 0;
  if (scene.is(n, nodes::Cone)) return scene.get(n, nodes::cone::segments) > 0;
  return scene.type(n).kind == NodeKind::builtin && scene.type(n).is_own();
}

class MeshJson : public JsonPart {
 public:
  using JsonPart::JsonPart;

  void mesh(const MeshRecord& m, const Streams& s) {
    const Geometry& g = p_.meshes.geometries()[m.geometry];
    json_.object([&] {
      if (auto name = name_of(g.source); !name.empty()) json_.member("name", name);
      json_.key("primitives");
      json_.begin_array();
      json_.object([&] {
        json_.object("attributes", [&] { attributes(m, s); });
        if (s.indices != none) json_.member("indices", s.indices);
        if (g.morph != none) targets(p_.meshes.morphs()[g.morph]);
        if (m.material != none) json_.member("material", m.material);
        if (s.draco != none) draco(m, s);
        if (g.mode != Mode::triangles) json_.member("mode", static_cast<int>(g.mode));
        if (g.features != none) mesh_features(g);
      });
      json_.end_array();
      if (p_.extras && p_.facts_only && p_.extras->has_facts_of_geometry(g.source, names_without(m, s)))
        mesh_facts(g.source, names_without(m, s));
      if (p_.extras && !p_.facts_only) mesh_extras(g, s.draco == none, p_.packing.dequantization(m));
    });
  }

 private:
  void mesh_facts(NodeId geometry, const std::vector<std::string_view>& without) {
    json_.object("extras",
                 [&] { json_.object("vrml97", [&] { p_.extras->facts_of_geometry(json_, geometry, without); }); });
  }

  /// Fields whose values no accessor has, so that a name would be that of nothing.
  std::vector<std::string_view> names_without(const MeshRecord& m, const Streams& s) const {
    std::vector<std::string_view> out;
    if (s.texcoords == none) out.push_back("texCoord");
    if (s.normals == none) out.push_back("normal");
    if (s.colors == none || !m.shows_color) out.push_back("color");
    return out;
  }

  /// EXT_mesh_features: the numbers of the first set are in _FEATURE_ID_0.
  void mesh_features(const Geometry& g) {
    extension("EXT_mesh_features", [&] {
      list("featureIds", 1, [&](std::size_t) {
        json_.object([&] {
          json_.members("featureCount", g.n_features, "attribute", 0);
          if (p_.has_table()) json_.member("propertyTable", 0);
        });
      });
    });
  }

  void targets(const Morph& m) {
    list("targets", m.targets.size(), [&](std::size_t i) {
      const auto& t = m.targets[i];
      json_.object([&] {
        if (t.positions != none) json_.member("POSITION", p_.packing.of(t.positions));
        if (t.normals != none) json_.member("NORMAL", p_.packing.of(t.normals));
      });
    });
  }

  void attributes(const MeshRecord& m, const Streams& s) {
    json_.member("POSITION", s.positions);
    if (s.normals != none) json_.member("NORMAL", s.normals);
    // Colours that a picture hides are kept under a name that viewers do not know.
    if (s.colors != none) json_.member(m.shows_color ? "COLOR_0" : "_COLOR", s.colors);
    if (s.texcoords != none) json_.member("TEXCOORD_0", s.texcoords);
    if (s.lightcoords != none) json_.member(s.texcoords != none ? "TEXCOORD_1" : "TEXCOORD_0", s.lightcoords);
    if (s.features != none) json_.member("_FEATURE_ID_0", s.features);
  }

  /// Attributes of Draco are numbered in the order in which the mesh has them.
  void draco(const MeshRecord& m, const Streams& s) {
    Streams ids;
    std::uint32_t next = 0;
    for (auto part : {&Streams::positions, &Streams::normals, &Streams::colors, &Streams::texcoords,
                      &Streams::lightcoords, &Streams::features})
      if (s.*part != none) ids.*part = next++;
    extension("KHR_draco_mesh_compression", [&] {
      json_.member("bufferView", p_.layout.of_blob(s.draco));
      json_.object("attributes", [&] { attributes(m, ids); });
    });
  }

  /// `in_order`: the triangles are in the order of the polygons that they were cut from.
  void mesh_extras(const Geometry& g, bool in_order, const Dequantization* whole) {
    const double step = whole ? whole->step : 1;
    const auto polygons = in_order ? p_.meshes.polygons(g) : std::span<const std::uint32_t>();
    if (is_recognised(p_.scene, g.source))
      p_.extras->form(json_, g.source);
    else if (is_parametric(p_.scene, g.source) || points_move(g.source))
      p_.extras->member(json_, g.source, {});
    else if (!polygons.empty() || step != 1 || p_.extras->geometry_says_more(g.source))
      p_.extras->geometry(json_, g.source, polygons, step);
  }

  /// The order of points that events replace matters.
  bool points_move(NodeId geometry) const {
    bool moves = p_.extras->is_routed(geometry);
    for_each_child(p_.scene, geometry, [&](NodeId n) { moves |= p_.extras->is_routed(n); });
    return moves;
  }
};

}  // namespace

void write_mesh(JsonOut& json, const Parts& parts, std::uint32_t mesh) {
  MeshJson(json, parts).mesh(parts.meshes.meshes()[mesh], parts.packing.streams(mesh));
}

}  // namespace wrlkit::gltf
