// What the traversal of VRML 1.0 does at nodes that VRML 1.0 does not have. In a world of VRML97 it goes only where
// nodes of VRML 1.0 are; groups of VRML97 keep the state in, as Coin's do.
#include <iterator>
#include <utility>

#include "base/text/bit_mask.h"
#include "base/text/vrml_value.h"
#include "passes/lower_vrml1/lowering.h"
#include "scenegraph/any_node.h"
#include "scenegraph/metadata.h"
#include "scenegraph/nodes.h"
#include "scenegraph/walk.h"

namespace wrlkit::vrml1 {
namespace {

/// A Shape that the parser put around geometry which stood among children.
bool is_bare(const Scene& scene, NodeId n) {
  if (!scene.is(n, nodes::Shape) || scene.get(n, nodes::shape::appearance)) return false;
  const NodeId geometry = scene.get(n, nodes::shape::geometry);
  return geometry && scene.where(geometry).begin == scene.where(n).begin;
}

/// Materials of VRML97 where only children stand.
std::vector<NodeId> child_materials(const Scene& scene) {
  std::vector<NodeId> out;
  const auto take = [&](NodeId c) {
    if (scene.is(c, nodes::Material)) out.push_back(c);
  };
  std::ranges::for_each(scene.main.roots, take);
  for (NodeId n : all_nodes(scene))
    if (scene.is(n, nodes::X3DGroupingNode)) std::ranges::for_each(hierarchy_children(scene, n), take);
  return out;
}

/// Nodes that the state of VRML 1.0 comes from or goes to, and all that these are in.
std::vector<char> stateful_nodes(const Scene& scene) {
  std::vector<char> out(scene.node_count());
  std::vector<std::pair<NodeId, NodeId>> parents;  // of a child
  std::vector<NodeId> next = child_materials(scene);
  std::ranges::copy_if(scene.main.roots, std::back_inserter(next),
                       [&](NodeId n) { return scene.is(n, nodes::X3DGeometryNode); });
  for (NodeId n : all_nodes(scene)) {
    for_each_child(scene, n, [&](NodeId c) {
      if (c) parents.emplace_back(c, n);
    });
    if (scene.is(n, nodes::Vrml1Node) || is_bare(scene, n)) next.push_back(n);
  }
  std::ranges::sort(parents);
  while (!next.empty()) {
    const NodeId n = next.back();
    next.pop_back();
    if (std::exchange(out[n.value], 1)) continue;
    for (auto i = std::ranges::lower_bound(parents, n, {}, &std::pair<NodeId, NodeId>::first);
         i != parents.end() && i->first == n; ++i)
      next.push_back(i->second);
  }
  return out;
}

}  // namespace

bool has_state(const Scene& scene) {
  const auto is_vrml1 = [&](NodeId n) { return scene.is(n, nodes::Vrml1Node); };
  if (any_node(scene, is_vrml1) && std::ranges::any_of(all_nodes(scene), is_vrml1)) return true;
  return any_node(scene, [&](NodeId n) { return is_bare(scene, n); }) && !child_materials(scene).empty();
}

/// A Material of VRML97 that stands among children, as one of VRML 1.0.
NodeId Lowering::vrml1_material(NodeId n) {
  namespace from = nodes::material;
  namespace to = nodes::vrml1::material;
  NodeId& made = bases_[n];
  if (made) return made;
  made = scene_.add(nodes::vrml1::Material, scene_.where(n));
  scene_.set_name(made, scene_.name(n));
  const auto color = [](const Vec3& c) { return std::vector<double>{c[0], c[1], c[2]}; };
  const Vec3 diffuse = scene_.get(n, from::diffuseColor);
  scene_.set(made, to::diffuseColor, color(diffuse), to::specularColor, color(scene_.get(n, from::specularColor)),
             to::emissiveColor, color(scene_.get(n, from::emissiveColor)));
  scene_.set(made, to::shininess, std::vector<double>{scene_.get(n, from::shininess)}, to::transparency,
             std::vector<double>{scene_.get(n, from::transparency)});
  if (scene_.find(n, from::ambientIntensity.slot))
    scene_.set(made, to::ambientColor, color(scene_.get(n, from::ambientIntensity) * diffuse));
  return made;
}

void Lowering::visit_other(NodeId n, State& s, Frame& frame) {
  const auto kind = scene_.type(n).kind;
  if (!stateful_.empty() && is(n, nodes::Material)) {
    s.material = vrml1_material(n);
    s.color = {};
    return;
  }
  if (!stateful_.empty() && (kind == NodeKind::script || !(n.value < stateful_.size() && stateful_[n.value])))
    return frame.add(n);
  if (kind == NodeKind::builtin) return visit_vrml97(n, s, frame);
  if (stateful_.empty() || kind != NodeKind::proto) return visit_unknown(n, s, frame);
  visit_instance(n, s);
  frame.add(n);
}

/// A node of the first known type among `isA`, with the fields that it shares with that.
NodeId Lowering::known_base(NodeId n) {
  auto& made = bases_[n];
  if (made) return made;
  const auto fields = scene_.copy_of_fields(n);
  for (const Value& v : fields) {
    if (!scene_.is_extra(v) || v.extra->name != "isA" || v.extra->value.type != FieldType::MFString) continue;
    for (auto base : v.extra->value.text_span()) {
      const TypeId type = find_builtin(base, Dialect::vrml1);
      if (!type) continue;
      made = scene_.add(type, scene_.where(n));
      scene_.set_name(made, scene_.name(n));
      for (const Value& own : fields) {
        auto slot = scene_.is_extra(own) ? scene_.type(type).find(own.extra->name, Dialect::vrml1) : std::nullopt;
        if (!slot || scene_.type(type).fields[*slot].type != own.extra->value.type) continue;
        Value same = own.extra->value;
        same.slot = *slot;
        scene_.set(made, same);
      }
      return made;
    }
  }
  return {};
}

void Lowering::visit_unknown(NodeId n, State& s, Frame& frame) {
  if (NodeId base = known_base(n)) return visit(base, s, frame);
  std::vector<NodeId> nodes;
  for (const Value& v : scene_.fields(n))
    for (NodeId c : scene_.content(v).node_span()) nodes.push_back(c);
  if (nodes.empty()) {
    quote_words(n);
    return frame.add(n);
  }
  const Frame inner = contents(nodes, s);
  const NodeId g = group(scene_, inner, scene_.where(n), scene_.name(n));
  if (!g) return;
  keep_fields(n, g);
  frame.add(g);
}

/// Words without quotes, and sets of them, are values of VRML 1.0 only: strings say the same.
void Lowering::quote_words(NodeId n) {
  auto fields = scene_.copy_of_fields(n);
  for (Value& v : fields) {
    if (!scene_.is_extra(v) || v.extra->value.is) continue;
    const auto name = v.extra->name;
    const Value& said = v.extra->value;
    const bool is_word =
        said.type == FieldType::SFEnum ||
        (said.type == FieldType::verbatim && is_vrml_value(said.text()) && !is_vrml97_value(said.text()));
    if (is_word) v = scene_.make_extra(name, scene_.make(FieldType::SFString, Value::extra_slot, said.text()));
    if (said.type != FieldType::SFBitMask) continue;
    std::vector<std::string_view> words;
    for_each_bit(said.text(), [&](std::string_view word) { words.push_back(word); });
    v = scene_.make_extra(name, scene_.make(FieldType::MFString, Value::extra_slot, words));
  }
  scene_.set_fields(n, fields);
}

/// Fields of a node that nobody knows are said of the group that it becomes.
void Lowering::keep_fields(NodeId n, NodeId group) {
  std::vector<NodeId> members;
  for (const Value& v : scene_.copy_of_fields(n)) {
    if (!scene_.is_extra(v) || v.extra->value.is || v.extra->name == "isA") continue;
    if (const NodeId m = metadata_of(scene_, {scene_.where(n), v.extra->name}, v.extra->value)) members.push_back(m);
  }
  if (members.empty()) return;
  add_metadata(scene_, group, metadata_set(scene_, {scene_.where(n), scene_.type(n).name}, members));
}

// Nodes of VRML97 stay as they are; in their children the state is that around them.
void Lowering::visit_vrml97(NodeId n, const State& s, Frame& frame) {
  if (scene_.is(n, nodes::X3DGeometryNode)) return visit_shape(n, s, frame);
  if (!stateful_.empty() && is_bare(scene_, n)) return visit_shape(scene_.get(n, nodes::shape::geometry), s, frame);
  if (!scene_.is(n, nodes::X3DGroupingNode)) return frame.add(n);
  auto known = effects_.find({n, s});
  if (known == effects_.end()) {
    const auto below = vrml97_children(n, s);
    // What ROUTEs refer to stays that node. In another state it is a copy.
    NodeId made = n;
    if (stateful_.empty() || !originals_.emplace(n, children_of(n)).second) {
      made = scene_.add(scene_.type_id(n), scene_.where(n));
      scene_.set_name(made, scene_.name(n));
      const auto fields = scene_.copy_of_fields(n);
      scene_.set_fields(made, fields);
    }
    if (auto field = child_field(n)) scene_.set(made, scene_.make(FieldType::MFNode, field->slot, below));
    known = effects_.emplace(std::pair{n, s}, Effect{made, {}, {}, {}}).first;
  }
  frame.add(known->second.drawn);
}

std::vector<NodeId> Lowering::vrml97_children(NodeId n, const State& s) {
  if (!is(n, nodes::Switch) && !is(n, nodes::LOD)) return children(scene_, contents(children_of(n), s));
  std::vector<NodeId> out;
  for (NodeId c : children_of(n)) {
    State own = s;
    Frame inner;
    out.push_back(choice(c, own, inner));
  }
  return out;
}

// Nodes in the fields of an instance are drawn where its prototype says, in a state that is not known here.
void Lowering::visit_instance(NodeId n, const State& s) {
  if (!originals_.emplace(n, std::span<const NodeId>{}).second) return;
  const auto fields = scene_.copy_of_fields(n);
  for (const Value& v : fields) {
    if (v.is || scene_.is_extra(v) || v.type != FieldType::MFNode) continue;
    scene_.set(n, scene_.make(v.type, v.slot, children(scene_, contents(v.node_span(), s))));
  }
}

// ---- a world of VRML97 ---------------------------------------------------------------------------------------------

void Lowering::run_among_vrml97() {
  stateful_ = stateful_nodes(scene_);
  report_unknown_fields();
  for (std::uint32_t i = 0; i < scene_.proto_count(); ++i) lower_body(scene_.proto(ProtoId{i}));
  State state;
  Frame frame;
  for (NodeId n : scene_.main.roots) visit(n, state, frame);
  scene_.main.roots = children(scene_, frame);
  for (ProtoId p : scene_.main.protos) scene_.proto(p).roots_before = 0;  // there are fewer roots now
  drop_routes(scene_.main);
}

// The first node of a body takes the place of the instance; each of them stays one.
void Lowering::lower_body(Proto& p) {
  for (NodeId& root : p.body.roots) {
    if (!stateful_[root.value]) continue;
    const Frame frame = contents(std::span(&root, 1), {});
    const NodeId made = group(scene_, frame, scene_.where(root), scene_.name(root));
    root = made ? made : scene_.add(nodes::Group, scene_.where(root));
  }
  drop_routes(p.body);
}

void Lowering::drop_routes(Scope& scope) {
  const auto ends_here = [&](const Route& r) {
    const bool gone = scene_.is(r.from, nodes::Vrml1Node) || scene_.is(r.to, nodes::Vrml1Node);
    if (gone) diag_.report(Diag::no_vrml97_node, scene_.where(r.to), "ROUTE");
    return gone;
  };
  std::erase_if(scope.routes, ends_here);
}

}  // namespace wrlkit::vrml1
