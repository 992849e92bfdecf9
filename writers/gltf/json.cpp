#include "writers/gltf/json.h"

#include <set>

#include "scenegraph/walk.h"

namespace wrlkit::gltf {
namespace {

constexpr int array_buffer = 34962, element_array_buffer = 34963;
constexpr int linear_filter = 9729, linear_mipmap_linear = 9987, repeat = 10497, clamp_to_edge = 33071;

/// Forms whose numbers say more than their triangles do.
bool is_parametric(const Scene& scene, NodeId n) {
  constexpr TypeId types[] = {nodes::Box,       nodes::Cone,   nodes::Cylinder, nodes::ElevationGrid,
                              nodes::Extrusion, nodes::Sphere, nodes::Text};
  return std::ranges::find(types, scene.type_id(n)) != std::end(types);
}

class Writer {
 public:
  Writer(const Parts& parts, const Sink& sink) : p_(parts), d_(parts.document), sink_(sink) {}

  std::vector<GltfSummary::Share> write() {
    json_.begin_object();
    asset();
    extensions_used();
    extensions_required();
    extensions();
    json_.member("scene", 0);
    list("scenes", 1, [&](std::size_t) { scene(); });
    measured("nodes", d_.nodes.size(), [&](std::size_t i) { node(static_cast<std::uint32_t>(i)); });
    auto visible = visibility(p_.scene, d_.navigation_info);
    measured("cameras", d_.cameras.size(),
             [&](std::size_t i) { write_camera(json_, p_.scene, d_.cameras[i], d_.world, visible); });
    measured("meshes", p_.meshes.meshes().size(),
             [&](std::size_t i) { mesh(p_.meshes.meshes()[i], p_.packing.streams(static_cast<std::uint32_t>(i))); });
    measured("materials", p_.materials.materials().size(),
             [&](std::size_t i) { json_.raw(p_.materials.materials()[i]); });
    measured("textures", p_.textures.textures().size(), [&](std::size_t i) { texture(p_.textures.textures()[i]); });
    measured("images", p_.textures.pictures().size(), [&](std::size_t i) { image(i); });
    measured("samplers", p_.textures.samplers().size(), [&](std::size_t i) { sampler(p_.textures.samplers()[i]); });
    measured("animations", p_.animations.count(), [&](std::size_t i) {
      p_.animations.write(json_, i, p_.facts_only ? nullptr : p_.extras,
                          [&](std::uint32_t a) { return p_.packing.of(a); });
    });
    const auto& accessors = p_.packing.store().accessors();
    measured("accessors", accessors.size(), [&](std::size_t i) { accessor(accessors[i]); });
    measured("bufferViews", p_.layout.views().size(), [&](std::size_t i) { buffer_view(p_.layout.views()[i]); });
    list("buffers", (p_.layout.size() > 0) + (p_.layout.unpacked_size() > 0),
         [&](std::size_t i) { i == 0 ? buffer() : unpacked_buffer(); });
    json_.end_object();
    sink_(text_);
    return std::move(shares_);
  }

 private:
  /// An array of objects; glTF allows no empty ones.
  template <class F>
  void list(std::string_view name, std::size_t n, F element) {
    constexpr std::size_t piece = 128 * 1024;
    if (n == 0) return;
    json_.key(name);
    json_.begin_array();
    for (std::size_t i = 0; i < n; ++i) {
      element(i);
      if (text_.size() < piece) continue;
      sink_(text_);
      written_ += text_.size();
      text_.clear();
    }
    json_.end_array();
  }

  /// The same, one of the whole file.
  template <class F>
  void measured(std::string_view name, std::size_t n, F element) {
    const auto before = written_ + text_.size();
    list(name, n, element);
    if (n > 0) shares_.emplace_back(name, written_ + text_.size() - before);
  }

  template <class T>
  void numbers(std::string_view name, std::span<const T> values) {
    json_.member(name, values);
  }

  void asset() {
    json_.key("asset");
    json_.begin_object();
    json_.member("version", "2.0");
    json_.member("generator", "wrlkit");
    const auto& parts = p_.names.rows();
    const bool listed = !p_.names.columns() && !parts.empty();
    if (p_.extras || listed) {
      json_.key("extras");
      json_.begin_object();
      if (listed) list("features", parts.size(), [&](std::size_t i) { json_.value(parts[i].name); });
    }
    if (p_.extras) {
      json_.key("vrml97");
      json_.begin_object();
      if (p_.facts_only) json_.member("facts", true);
      if (!p_.scene.comment.empty()) json_.member("comment", p_.scene.comment);
      if (d_.world_info) p_.extras->node(json_, d_.world_info, {});
      json_.end_object();
    }
    if (p_.extras || listed) json_.end_object();
    json_.end_object();
  }

  void extensions_used() {
    std::vector<std::string_view> used;
    if (p_.animations.uses_pointers()) used.push_back("KHR_animation_pointer");
    if (!d_.lights.empty()) used.push_back("KHR_lights_punctual");
    if (p_.materials.uses_unlit()) used.push_back("KHR_materials_unlit");
    if (p_.materials.uses_texture_transform()) used.push_back("KHR_texture_transform");
    if (p_.materials.uses_moz_lightmap()) used.push_back("MOZ_lightmap");
    if (std::ranges::any_of(d_.instances, [](const Instances& i) { return i.features != none; }))
      used.push_back("EXT_instance_features");
    if (p_.meshes.any_features()) used.push_back("EXT_mesh_features");
    if (has_table()) used.push_back("EXT_structural_metadata");
    if (!d_.lods.empty()) used.push_back("MSFT_lod");
    const auto needed = required();
    used.insert(used.end(), needed.begin(), needed.end());
    list("extensionsUsed", used.size(), [&](std::size_t i) { json_.value(used[i]); });
  }

  /// What a reader must know to see anything.
  std::vector<std::string_view> required() const {
    std::vector<std::string_view> names;
    if (!d_.instances.empty()) names.push_back("EXT_mesh_gpu_instancing");
    if (p_.packing.uses_quantization()) names.push_back("KHR_mesh_quantization");
    if (p_.layout.unpacked_size() > 0) names.push_back("EXT_meshopt_compression");
    if (!p_.packing.blobs().empty()) names.push_back("KHR_draco_mesh_compression");
    if (p_.textures.uses_webp()) names.push_back("EXT_texture_webp");
    return names;
  }

  void extensions_required() {
    const auto names = required();
    list("extensionsRequired", names.size(), [&](std::size_t i) { json_.value(names[i]); });
  }

  void extensions() {
    if (d_.lights.empty() && !has_table()) return;
    json_.key("extensions");
    json_.begin_object();
    if (has_table()) table();
    if (!d_.lights.empty()) {
      json_.key("KHR_lights_punctual");
      json_.begin_object();
      list("lights", d_.lights.size(), [&](std::size_t i) { write_light(json_, p_.scene, d_.lights[i], d_.world); });
      json_.end_object();
    }
    json_.end_object();
  }

  bool has_table() const { return p_.names.columns() && !p_.names.rows().empty(); }

  /// EXT_structural_metadata: a row for each part and group.
  void table() {
    const bool packed = p_.packing.uses_meshopt(), parents = p_.names.any_parent();
    const std::size_t n = p_.names.rows().size();
    const auto no_parent = PartTable::no_parent(packed, n);
    auto object = [&](std::string_view name, auto members) {
      json_.key(name);
      json_.begin_object();
      members();
      json_.end_object();
    };
    auto schema = [&] {
      json_.member("id", "parts");
      object("classes", [&] {
        object("part", [&] {
          object("properties", [&] {
            json_.key("name");
            json_.raw(R"({"type":"STRING","semantic":"NAME","required":true})");
            if (parents)
              object("parent", [&] {
                json_.member("type", "SCALAR");
                json_.member("componentType", no_parent == none ? "UINT32" : "UINT16");
                json_.member("noData", no_parent);
              });
          });
        });
      });
    };
    auto columns = [&] {
      object("name", [&] {
        json_.member("values", p_.layout.of_column(0));
        json_.member("stringOffsets", p_.layout.of_column(1));
        if (p_.layout.stride_of_column(1) != 4) json_.member("stringOffsetType", "UINT16");
      });
      if (parents) object("parent", [&] { json_.member("values", p_.layout.of_column(2)); });
    };
    object("EXT_structural_metadata", [&] {
      object("schema", schema);
      list("propertyTables", 1, [&](std::size_t) {
        json_.begin_object();
        json_.member("class", "part");
        json_.member("count", n);
        object("properties", columns);
        json_.end_object();
      });
    });
  }

  void scene() {
    json_.begin_object();
    if (d_.world_info) {
      auto title = p_.scene.get(d_.world_info, nodes::world_info::title);
      if (!title.empty()) json_.member("name", title);
    }
    if (!d_.roots.empty()) numbers("nodes", std::span(d_.roots));
    if (p_.extras) scene_extras();
    json_.end_object();
  }

  void scene_extras() {
    const auto& main = p_.scene.main;
    const bool protos = !main.protos.empty() && !p_.facts_only;  // what they made is there
    if (!d_.navigation_info && !d_.origin && main.routes.empty() && !protos && main.imports.empty() &&
        main.exports.empty())
      return;
    json_.key("extras");
    json_.begin_object();
    json_.key("vrml97");
    json_.begin_object();
    if (d_.origin) numbers("origin", std::span<const double>(*d_.origin));
    if (d_.navigation_info) p_.extras->node(json_, d_.navigation_info, {});
    if (protos) p_.extras->protos(json_, main.protos);
    list("imports", main.imports.size(), [&](std::size_t i) { p_.extras->import(json_, main.imports[i]); });
    list("exports", main.exports.size(), [&](std::size_t i) { p_.extras->export_(json_, main.exports[i]); });
    // Facts are of what is in the file: a ROUTE to what no Switch shows leads nowhere.
    std::vector<const Route*> routes;
    for (const Route& r : main.routes)
      if (!p_.facts_only || (p_.extras->is_placed(r.from) && p_.extras->is_placed(r.to))) routes.push_back(&r);
    list("routes", routes.size(), [&](std::size_t i) { p_.extras->route(json_, *routes[i]); });
    json_.end_object();
    json_.end_object();
  }

  void node(std::uint32_t id) {
    const Node& n = d_.nodes[id];
    json_.begin_object();
    if (auto name = node_name(n); !name.empty()) json_.member("name", name);
    if (n.transform != none) transform(d_.transforms[n.transform]);
    if (n.attachment == Attachment::mesh) json_.member("mesh", n.attached);
    if (n.attachment == Attachment::camera) json_.member("camera", n.attached);
    if (n.n_children > 0) numbers("children", d_.children_of(n));
    if (n.attachment == Attachment::light || n.lod) node_extensions(n, id);
    if (n.instances != none)
      instances(d_.instances[n.instances]);
    else
      node_extras(n, id);
    json_.end_object();
  }

  std::string_view node_name(const Node& n) const {
    if (!n.source) return n.attachment == Attachment::light ? "headlight" : "";
    if (n.attachment == Attachment::camera) return camera_name(p_.scene, n.source);
    return name_of(n.source);
  }

  std::string_view name_of(NodeId n) const { return p_.extras ? p_.extras->name(n) : p_.scene.name(n); }

  void transform(const Trs& t) {
    if (t.translation != Vec3{0, 0, 0}) numbers("translation", std::span<const double>(t.translation));
    if (!t.rotation.identity()) {
      const auto& q = t.rotation;
      numbers("rotation", std::span<const double>(std::array{q.x, q.y, q.z, q.w}));
    }
    if (t.scale != Vec3{1, 1, 1}) numbers("scale", std::span<const double>(t.scale));
  }

  void node_extensions(const Node& n, std::uint32_t id) {
    json_.key("extensions");
    json_.begin_object();
    if (n.attachment == Attachment::light) {
      json_.key("KHR_lights_punctual");
      json_.begin_object();
      json_.member("light", n.attached);
      json_.end_object();
    }
    if (n.lod) {
      json_.key("MSFT_lod");
      json_.begin_object();
      numbers("ids", std::span(d_.lods.at(id).levels));
      json_.end_object();
    }
    json_.end_object();
  }

  void instances(const Instances& all) {
    json_.key("extensions");
    json_.begin_object();
    json_.key("EXT_mesh_gpu_instancing");
    json_.begin_object();
    json_.key("attributes");
    json_.begin_object();
    if (all.translations != none) json_.member("TRANSLATION", p_.packing.of(all.translations));
    if (all.rotations != none) json_.member("ROTATION", p_.packing.of(all.rotations));
    if (all.scales != none) json_.member("SCALE", p_.packing.of(all.scales));
    if (all.features != none) json_.member("_FEATURE_ID_0", p_.packing.of(all.features));
    json_.end_object();
    json_.end_object();
    if (all.features != none) instance_features(all);
    json_.end_object();
    if (!all.rows.empty() || std::ranges::all_of(all.sources, [&](NodeId n) { return name_of(n).empty(); })) return;
    json_.key("extras");
    json_.begin_object();
    list("names", all.sources.size(), [&](std::size_t i) { json_.value(name_of(all.sources[i])); });
    json_.end_object();
  }

  void instance_features(const Instances& all) {
    const std::set<std::uint32_t> ids(all.rows.begin(), all.rows.end());
    json_.key("EXT_instance_features");
    json_.begin_object();
    list("featureIds", 1, [&](std::size_t) {
      json_.begin_object();
      json_.member("featureCount", ids.size() - ids.count(none));
      if (ids.contains(none)) json_.member("nullFeatureId", no_part);
      json_.member("attribute", 0);
      json_.member("propertyTable", 0);
      json_.end_object();
    });
    json_.end_object();
  }

  /// The type that a reader takes a node for.
  TypeId implied(const Node& n) const {
    const bool stays = d_.place(n).identity();
    switch (n.attachment) {
      case Attachment::mesh:
        return stays ? nodes::Shape : nodes::Transform;
      case Attachment::camera:
        return nodes::Viewpoint;
      case Attachment::light:
        return n.source ? p_.scene.type_id(n.source) : TypeId{};
      case Attachment::nothing:
        break;
    }
    return stays ? nodes::Group : nodes::Transform;
  }

  void node_extras(const Node& n, std::uint32_t id) {
    bool vrml97 =
        p_.extras && (p_.facts_only ? is_fact(n)
                                    : !n.source || n.same_as != none ||
                                          p_.extras->says_more(n.source, implied(n), n.plain) || named_as_described(n));
    bool coverage = n.lod && !d_.lods.at(id).coverage.empty();
    const bool unseen = p_.extras && p_.facts_only && !vrml97 && n.source && n.attachment == Attachment::nothing &&
                        p_.scene.is(n.source, nodes::Shape) && p_.extras->has_unseen_names(n.source);
    if (!vrml97 && !coverage && !unseen) return;
    json_.key("extras");
    json_.begin_object();
    if (coverage) numbers("MSFT_screencoverage", std::span(d_.lods.at(id).coverage));
    if (unseen) p_.extras->unseen_names(json_, n.source);
    if (vrml97 && (!n.source || n.same_as != none)) {
      json_.key("vrml97");
      json_.begin_object();
      if (n.source) json_.member("USE", n.same_as);
      if (n.attachment == Attachment::mesh && !n.source) {
        json_.key("Shape");
        json_.raw("{}");
      }
      json_.end_object();
    } else if (vrml97) {
      p_.extras->vrml97(json_, n.source, p_.extras->said_by_node(n.source, n.plain), named_as_described(n));
    }
    json_.end_object();
  }

  /// What a reader other than wrlkit may want to know: the whole of what glTF has no node for, links and descriptions.
  bool is_fact(const Node& n) const {
    if (!n.source || n.same_as != none || p_.scene.is(n.source, nodes::Switch) || p_.scene.is(n.source, nodes::LOD))
      return false;
    const bool group = p_.scene.type(n.source).is_a("X3DGroupingNode") && !p_.scene.is(n.source, nodes::Anchor) &&
                       !p_.scene.is(n.source, nodes::Billboard);
    return !group && !p_.scene.is(n.source, nodes::Shape) && p_.extras->says_more(n.source, implied(n), n.plain);
  }

  /// A Viewpoint without a name has its description as that of its node: one that has both says so.
  bool named_as_described(const Node& n) const {
    if (n.attachment != Attachment::camera || !p_.scene.is(n.source, nodes::Viewpoint)) return false;
    auto name = p_.scene.name(n.source);
    return !name.empty() && name == p_.scene.get(n.source, nodes::viewpoint::description);
  }

  void mesh(const MeshRecord& m, const Streams& s) {
    const Geometry& g = p_.meshes.geometries()[m.geometry];
    json_.begin_object();
    if (auto name = name_of(g.source); !name.empty()) json_.member("name", name);
    json_.key("primitives");
    json_.begin_array();
    json_.begin_object();
    json_.key("attributes");
    json_.begin_object();
    attributes(m, s);
    json_.end_object();
    if (s.indices != none) json_.member("indices", s.indices);
    if (g.morph != none) targets(p_.meshes.morphs()[g.morph]);
    if (m.material != none) json_.member("material", m.material);
    if (s.draco != none) draco(m, s);
    if (g.mode != Mode::triangles) json_.member("mode", static_cast<int>(g.mode));
    if (g.features != none) mesh_features(g);
    json_.end_object();
    json_.end_array();
    if (p_.extras && p_.facts_only && p_.extras->has_names_in_geometry(g.source, names_without(m, s)))
      mesh_names(g.source, names_without(m, s));
    if (p_.extras && !p_.facts_only) mesh_extras(g, s.draco == none, p_.packing.dequantization(m));
    json_.end_object();
  }

  /// Fields whose values no accessor has, so that a name would be that of nothing.
  std::vector<std::string_view> names_without(const MeshRecord& m, const Streams& s) const {
    std::vector<std::string_view> out;
    if (s.texcoords == none) out.push_back("texCoord");
    if (s.normals == none) out.push_back("normal");
    if (s.colors == none || !m.shows_color) out.push_back("color");
    return out;
  }

  void mesh_names(NodeId geometry, const std::vector<std::string_view>& without) {
    json_.key("extras");
    json_.begin_object();
    json_.key("vrml97");
    json_.begin_object();
    p_.extras->names_in_geometry(json_, geometry, without);
    json_.end_object();
    json_.end_object();
  }

  /// EXT_mesh_features: the numbers of the first set are in _FEATURE_ID_0.
  void mesh_features(const Geometry& g) {
    json_.key("extensions");
    json_.begin_object();
    json_.key("EXT_mesh_features");
    json_.begin_object();
    list("featureIds", 1, [&](std::size_t) {
      json_.begin_object();
      json_.member("featureCount", g.n_features);
      json_.member("attribute", 0);
      if (has_table()) json_.member("propertyTable", 0);
      json_.end_object();
    });
    json_.end_object();
    json_.end_object();
  }

  void targets(const Morph& m) {
    list("targets", m.targets.size(), [&](std::size_t i) {
      const auto& t = m.targets[i];
      json_.begin_object();
      if (t.positions != none) json_.member("POSITION", p_.packing.of(t.positions));
      if (t.normals != none) json_.member("NORMAL", p_.packing.of(t.normals));
      json_.end_object();
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
    json_.key("extensions");
    json_.begin_object();
    json_.key("KHR_draco_mesh_compression");
    json_.begin_object();
    json_.member("bufferView", p_.layout.of_blob(s.draco));
    json_.key("attributes");
    json_.begin_object();
    attributes(m, ids);
    json_.end_object();
    json_.end_object();
    json_.end_object();
  }

  /// `in_order`: the triangles are in the order of the polygons that they were cut from.
  void mesh_extras(const Geometry& g, bool in_order, const Dequantization* whole) {
    const double step = whole ? whole->step : 1;
    const auto polygons = in_order ? std::span<const std::uint32_t>(g.polygons) : std::span<const std::uint32_t>();
    if (is_parametric(p_.scene, g.source) || points_move(g.source))
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

  void texture(const Texture& t) {
    json_.begin_object();
    if (auto name = name_of(t.source); !name.empty()) json_.member("name", name);
    json_.member("sampler", t.sampler);
    if (p_.textures.pictures()[t.picture].is_webp())
      webp(t.picture);
    else
      json_.member("source", t.picture);
    if (p_.extras && !p_.facts_only) p_.extras->member(json_, t.source, said_by_texture(p_.scene, t.source));
    json_.end_object();
  }

  void webp(std::uint32_t picture) {
    json_.key("extensions");
    json_.begin_object();
    json_.key("EXT_texture_webp");
    json_.begin_object();
    json_.member("source", picture);
    json_.end_object();
    json_.end_object();
  }

  void image(std::size_t i) {
    const Picture& picture = p_.textures.pictures()[i];
    json_.begin_object();
    json_.member("name", picture.name);
    if (p_.layout.pictures_inside()) {
      json_.member("mimeType", picture.mime);
      json_.member("bufferView", p_.layout.of_picture(i));
    } else {
      json_.member("uri", p_.picture_uris[i]);
    }
    json_.end_object();
  }

  void sampler(const Sampler& s) {
    json_.begin_object();
    json_.member("magFilter", linear_filter);
    json_.member("minFilter", linear_mipmap_linear);
    if (!s.repeat_s) json_.member("wrapS", clamp_to_edge);
    if (!s.repeat_t) json_.member("wrapT", clamp_to_edge);
    json_.end_object();
  }

  void accessor(const Accessor& a) {
    const auto& type = info(a.view);
    json_.begin_object();
    if (a.offset != none) json_.member("bufferView", p_.layout.of(a.view));
    if (a.offset > 0 && a.offset != none) json_.member("byteOffset", a.offset);
    json_.member("componentType", type.component_type);
    json_.member("count", a.count);
    if (type.normalized) json_.member("normalized", true);
    json_.member("type", type.type);
    if (a.bounds != none) {
      const auto& b = p_.packing.store().bounds()[a.bounds];
      const std::size_t n = a.view == View::time ? 1 : 3;
      numbers("max", std::span<const float>(b.high).first(n));
      numbers("min", std::span<const float>(b.low).first(n));
    }
    json_.end_object();
  }

  void buffer_view(const Layout::BufferView& v) {
    const bool packed = v.unpacked > 0;
    const auto offset = packed ? v.unpacked_offset : v.offset;
    json_.begin_object();
    json_.member("buffer", packed ? 1 : 0);
    if (offset > 0) json_.member("byteOffset", offset);
    json_.member("byteLength", packed ? v.unpacked : v.length);
    if (v.picture == none && v.blob == none && v.column == none) {
      const auto& type = info(v.view);
      if (type.vertices) json_.member("byteStride", type.element);
      if (type.vertices || type.indices) json_.member("target", type.vertices ? array_buffer : element_array_buffer);
    }
    if (packed) packed_view(v);
    json_.end_object();
  }

  void packed_view(const Layout::BufferView& v) {
    constexpr std::string_view filters[] = {"", "OCTAHEDRAL", "EXPONENTIAL"};
    const auto& type =
        v.column == none ? info(v.view) : info(View::part);  // columns that are packed have elements of four bytes
    const bool triangles = v.column == none && (v.view == View::index16 || v.view == View::index32);
    json_.key("extensions");
    json_.begin_object();
    json_.key("EXT_meshopt_compression");
    json_.begin_object();
    json_.member("buffer", 0);
    if (v.offset > 0) json_.member("byteOffset", v.offset);
    json_.member("byteLength", v.length);
    json_.member("byteStride", type.element);
    json_.member("count", v.unpacked / type.element);
    json_.member("mode", !type.indices ? "ATTRIBUTES" : triangles ? "TRIANGLES" : "INDICES");
    if (type.filter != Filter::none) json_.member("filter", filters[static_cast<std::size_t>(type.filter)]);
    json_.end_object();
    json_.end_object();
  }

  void unpacked_buffer() {
    json_.begin_object();
    json_.member("byteLength", p_.layout.unpacked_size());
    json_.key("extensions");
    json_.raw(R"({"EXT_meshopt_compression":{"fallback":true}})");
    json_.end_object();
  }

  void buffer() {
    json_.begin_object();
    json_.member("byteLength", p_.layout.size());
    if (!p_.buffer_uri.empty()) json_.member("uri", p_.buffer_uri);
    json_.end_object();
  }

  const Parts& p_;
  const Document& d_;
  const Sink& sink_;
  std::string text_;
  std::uint64_t written_ = 0;
  std::vector<GltfSummary::Share> shares_;
  JsonOut json_{text_};
};

}  // namespace

std::vector<GltfSummary::Share> write_json(const Parts& parts, const Sink& sink) { return Writer(parts, sink).write(); }

}  // namespace wrlkit::gltf
