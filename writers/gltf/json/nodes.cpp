#include "writers/gltf/json/lists.h"

#include <algorithm>
#include <array>
#include <set>

#include "scenegraph/nodes.h"
#include "scenegraph/tags.h"
#include "writers/gltf/json/part.h"

namespace wrlkit::gltf {
namespace {

class NodeJson : public JsonPart {
 public:
  using JsonPart::JsonPart;

  void scene() {
    json_.object([&] {
      if (d_.world_info) {
        auto title = p_.scene.get(d_.world_info, nodes::world_info::title);
        if (!title.empty()) json_.member("name", title);
      }
      if (!d_.roots.empty()) json_.member("nodes", std::span(d_.roots));
      if (p_.extras)
        scene_extras();
      else if (d_.origin)
        json_.object("extras", [&] { json_.object("vrml97", [&] { origin(); }); });
    });
  }

  void node(std::uint32_t id) {
    const Node& n = d_.nodes[id];
    json_.object([&] {
      if (auto name = node_name(n); !name.empty()) json_.member("name", name);
      if (n.transform != none) transform(d_.transforms[n.transform], n.moved);
      if (n.attachment == Attachment::mesh) json_.member("mesh", n.attached);
      if (n.attachment == Attachment::camera) json_.member("camera", n.attached);
      if (n.n_children > 0) json_.member("children", d_.children_of(n));
      if (n.attachment == Attachment::light || n.lod || n.hidden) node_extensions(n, id);
      if (n.instances != none)
        instances(d_.instances[n.instances]);
      else
        node_extras(n, id);
    });
  }

 private:
  void scene_extras() {
    const auto& main = p_.scene.main;
    const bool protos = !main.protos.empty() && !p_.facts_only;  // what they made is there
    if (!d_.navigation_info && !d_.origin && main.routes.empty() && !protos && main.imports.empty() &&
        main.exports.empty() && d_.tagged_rows.empty())
      return;
    json_.object("extras", [&] {
      json_.object("vrml97", [&] {
        if (d_.origin) origin();
        if (d_.navigation_info) p_.extras->node(json_, d_.navigation_info, {});
        if (protos) p_.extras->protos(json_, main.protos);
        list("imports", main.imports.size(), [&](std::size_t i) { p_.extras->import(json_, main.imports[i]); });
        list("exports", main.exports.size(), [&](std::size_t i) { p_.extras->export_(json_, main.exports[i]); });
        // Facts are of what is in the file: a ROUTE to what no Switch shows leads nowhere.
        std::vector<const Route*> routes;
        for (const Route& r : main.routes)
          if (!p_.facts_only || (p_.extras->is_placed(r.from) && p_.extras->is_placed(r.to))) routes.push_back(&r);
        list("routes", routes.size(), [&](std::size_t i) { p_.extras->route(json_, *routes[i]); });
        list("parts", d_.tagged_rows.size(), [&](std::size_t i) { tagged_row(d_.tagged_rows[i]); });
      });
    });
  }

  /// {row: 7, Transform: {metadata: ...}}: of the property table of parts.
  void tagged_row(const std::pair<std::uint32_t, NodeId>& of) {
    json_.object([&] {
      json_.member("row", of.first);
      p_.extras->tags(json_, of.second);
    });
  }

  /// What is not there cannot be made again: it is said even where nothing else is kept.
  void origin() { json_.member("origin", std::span<const double>(*d_.origin)); }

  std::string_view node_name(const Node& n) const {
    if (!n.source) return n.attachment == Attachment::light ? "headlight" : "";
    if (n.attachment == Attachment::camera) return camera_name(p_.scene, n.source);
    return name_of(n.source);
  }

  void transform(const Trs& t, bool moved) {
    if (moved || t.translation != Vec3{0, 0, 0}) json_.member("translation", std::span<const double>(t.translation));
    if (!t.rotation.identity()) {
      const auto& q = t.rotation;
      json_.member("rotation", std::span<const double>(std::array{q.x, q.y, q.z, q.w}));
    }
    if (t.scale != Vec3{1, 1, 1}) json_.member("scale", std::span<const double>(t.scale));
  }

  void node_extensions(const Node& n, std::uint32_t id) {
    json_.object("extensions", [&] {
      if (n.attachment == Attachment::light) {
        json_.object("KHR_lights_punctual", [&] { json_.member("light", n.attached); });
      }
      if (n.lod) {
        json_.object("MSFT_lod", [&] { json_.member("ids", std::span(d_.lods.at(id).levels)); });
      }
      if (n.hidden) hidden();
    });
  }

  /// What is not shown can still be clicked, if a graph does not say otherwise.
  void hidden() {
    json_.object("KHR_node_visibility", [&] { json_.member("visible", false); });
    if (p_.graph.uses(GltfExtension::node_selectability))
      json_.object("KHR_node_selectability", [&] { json_.member("selectable", false); });
    if (p_.graph.uses(GltfExtension::node_hoverability))
      json_.object("KHR_node_hoverability", [&] { json_.member("hoverable", false); });
  }

  void instances(const Instances& all) {
    json_.object("extensions", [&] {
      json_.object("EXT_mesh_gpu_instancing", [&] {
        json_.object("attributes", [&] {
          if (all.translations != none) json_.member("TRANSLATION", p_.packing.of(all.translations));
          if (all.rotations != none) json_.member("ROTATION", p_.packing.of(all.rotations));
          if (all.scales != none) json_.member("SCALE", p_.packing.of(all.scales));
          if (all.features != none) json_.member("_FEATURE_ID_0", p_.packing.of(all.features));
        });
      });
      if (all.features != none) instance_features(all);
    });
    if (!all.rows.empty() || std::ranges::all_of(all.sources, [&](NodeId n) { return name_of(n).empty(); })) return;
    json_.object("extras", [&] {
      list("names", all.sources.size(), [&](std::size_t i) { json_.value(name_of(all.sources[i])); });
    });
  }

  void instance_features(const Instances& all) {
    const std::set<std::uint32_t> ids(all.rows.begin(), all.rows.end());
    json_.object("EXT_instance_features", [&] {
      list("featureIds", 1, [&](std::size_t) {
        json_.object([&] {
          json_.member("featureCount", ids.size() - ids.count(none));
          if (ids.contains(none)) json_.member("nullFeatureId", no_part);
          json_.members("attribute", 0, "propertyTable", 0);
        });
      });
    });
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

  /// Whoever reads facts alone finds them wherever the node is.
  std::uint32_t same_as(const Node& n) const { return p_.facts_only ? none : n.same_as; }

  void node_extras(const Node& n, std::uint32_t id) {
    bool vrml97 =
        p_.extras && (p_.facts_only ? is_fact(n)
                                    : !n.source || same_as(n) != none ||
                                          p_.extras->says_more(n.source, implied(n), n.plain) || named_as_described(n));
    bool coverage = n.lod && !d_.lods.at(id).coverage.empty();
    const bool unseen = p_.extras && p_.facts_only && !vrml97 && n.source && n.attachment == Attachment::nothing &&
                        p_.scene.is(n.source, nodes::Shape) && p_.extras->has_unseen_facts(n.source);
    const bool tagged = p_.extras && p_.facts_only && !vrml97 && !unseen && has_tags(p_.scene, n.source);
    if (!vrml97 && !coverage && !unseen && !tagged) return;
    json_.object("extras", [&] {
      if (coverage) json_.member("MSFT_screencoverage", std::span(d_.lods.at(id).coverage));
      if (unseen) p_.extras->unseen_facts(json_, n.source);
      if (tagged) json_.object("vrml97", [&] { p_.extras->tags(json_, n.source); });
      if (vrml97 && (!n.source || same_as(n) != none)) {
        json_.object("vrml97", [&] {
          if (n.source) json_.member("USE", same_as(n));
          if (n.attachment == Attachment::mesh && !n.source) {
            json_.member("Shape", JsonText{"{}"});
          }
        });
      } else if (vrml97) {
        p_.extras->vrml97(json_, n.source, p_.extras->said_by_node(n.source, n.plain), named_as_described(n));
      }
    });
  }

  /// What a reader other than wrlkit may want to know: the whole of what glTF has no node for, links and descriptions.
  bool is_fact(const Node& n) const {
    if (!n.source || same_as(n) != none || p_.scene.is(n.source, nodes::Switch) || p_.scene.is(n.source, nodes::LOD))
      return false;
    const bool group = p_.scene.is(n.source, nodes::X3DGroupingNode) && !p_.scene.is(n.source, nodes::Anchor) &&
                       !p_.scene.is(n.source, nodes::Billboard);
    return !group && !p_.scene.is(n.source, nodes::Shape) && p_.extras->says_more(n.source, implied(n), n.plain);
  }

  /// A Viewpoint without a name has its description as that of its node: one that has both says so.
  bool named_as_described(const Node& n) const {
    if (n.attachment != Attachment::camera || !p_.scene.is(n.source, nodes::Viewpoint)) return false;
    auto name = p_.scene.name(n.source);
    return !name.empty() && name == p_.scene.get(n.source, nodes::viewpoint::description);
  }
};

}  // namespace

void write_scene(JsonOut& json, const Parts& parts) { NodeJson(json, parts).scene(); }

void write_node(JsonOut& json, const Parts& parts, std::uint32_t node) { NodeJson(json, parts).node(node); }

}  // namespace wrlkit::gltf
