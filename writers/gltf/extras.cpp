#include "writers/gltf/extras.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>

#include "scenegraph/access_word.h"
#include "scenegraph/any_node.h"
#include "scenegraph/equal.h"
#include "scenegraph/features.h"
#include "scenegraph/nodes.h"
#include "scenegraph/tags.h"
#include "scenegraph/walk.h"

namespace wrlkit::gltf {
namespace {

/// The fields that the type has in the node table; those behind them were declared by the node itself.
std::size_t n_table_fields(const NodeType& t) {
  TypeId built_in = t.kind == NodeKind::script ? find_builtin(t.name, Dialect::vrml97) : TypeId{};
  if (t.kind == NodeKind::proto) return 0;
  return built_in ? builtin_nodes()[built_in.value].fields.size() : t.fields.size();
}

bool is_long(const Value& v) {
  constexpr std::size_t most = 128;  // characters, about
  std::size_t n = 0;
  switch (info(v.type).element) {
    case Element::node:
      return !v.node_span().empty();
    case Element::text:
      if (!info(v.type).multiple) return v.text().size() > most;
      for (auto s : v.text_span()) n += s.size() + 3;
      return n > most;
    case Element::integer:
    case Element::image:
      return v.integer_span().size() * 4 > most;
    case Element::number:
      return v.number_span().size() * 4 > most;
  }
  return false;
}

}  // namespace

Extras::Extras(const Scene& scene, const LeadUrls& lead, Diagnostics& diag)
    : scene_(scene), lead_(lead), url_fields_(scene), diag_(diag), marks_(scene.node_count(), 0) {
  name_what_is_referred_to();
}

/// Names that a ROUTE or a Script uses must be unique in the file, as there are no scopes left.
void Extras::name_what_is_referred_to() {
  std::vector<NodeId> referred;
  for (const Route& r : scene_.main.routes) {
    for (NodeId n : {r.from, r.to}) {
      marks_[n.value] |= routed;
      referred.push_back(n);
    }
  }
  for (const Import& i : scene_.main.imports) referred.push_back(i.inline_node);
  for (const Export& e : scene_.main.exports) referred.push_back(e.node);
  const auto is_script = [&](NodeId n) { return scene_.type(n).kind == NodeKind::script; };
  if (any_node(scene_, is_script))
    for (NodeId n : all_nodes(scene_))
      if (is_script(n)) for_each_child(scene_, n, [&](NodeId held) { referred.push_back(held); });
  if (referred.empty()) return;
  std::unordered_map<std::string, std::size_t> times;
  for (NodeId n : reachable(scene_, scene_.main)) ++times[std::string(scene_.name(n))];
  for (const Import& i : scene_.main.imports) ++times[std::string(scene_.name(i.node))];
  std::size_t count = 0;
  for (NodeId n : referred) {
    std::string name(scene_.name(n));
    if ((!name.empty() && times[name] <= 1) || given_.contains(n.value)) continue;
    std::string fresh;
    do fresh = (name.empty() ? "_" : name + "_") + std::to_string(++count);
    while (times.contains(fresh));
    given_[n.value] = fresh;
  }
}

std::string_view Extras::name(NodeId n) const {
  auto i = body_ ? given_.end() : given_.find(n.value);
  return i == given_.end() ? scene_.name(n) : std::string_view(i->second);
}

Extras::Said Extras::said_by_node(NodeId n, bool plain_transform) const {
  using namespace nodes;
  static constexpr std::uint16_t transform_slots[] = {transform::children.slot, transform::translation.slot,
                                                      transform::rotation.slot, transform::scale.slot};
  struct Row {
    TypeId type;
    std::array<std::uint16_t, 3> slots;
    std::size_t n;
  };
  static constexpr Row rows[] = {
      {Anchor, {anchor::children.slot}, 1},
      {Billboard, {billboard::children.slot}, 1},
      {Collision, {collision::children.slot}, 1},
      {Group, {group::children.slot}, 1},
      {LOD, {lod::children.slot}, 1},
      {Shape, {shape::appearance.slot, shape::geometry.slot}, 2},
      {OrthoViewpoint,
       {ortho_viewpoint::position.slot, ortho_viewpoint::orientation.slot, ortho_viewpoint::fieldOfView.slot},
       3},
      {Viewpoint, {viewpoint::position.slot, viewpoint::orientation.slot, viewpoint::fieldOfView.slot}, 3},
      {DirectionalLight, {directional_light::direction.slot}, 1},
      {PointLight, {point_light::location.slot}, 1},
      {SpotLight, {spot_light::location.slot, spot_light::direction.slot}, 2},
  };
  if (scene_.is(n, Transform)) return Said(transform_slots, plain_transform ? 4 : 1);
  if (scene_.is(n, Shape) && !shown(n)) return {};
  static constexpr std::uint16_t shape_alone[] = {shape::geometry.slot};
  const NodeId look = scene_.is(n, Shape) ? scene_.get(n, shape::appearance) : NodeId{};
  if (look && !scene_.is(look, Appearance)) return shape_alone;  // of a prototype that was not found
  static constexpr std::uint16_t choices[] = {switch_::children.slot};
  if (marks_[n.value] & keeps_hidden_mark) return choices;
  for (const Row& r : rows)
    if (scene_.is(n, r.type)) return Said(r.slots).first(r.n);
  return {};
}

bool Extras::speaks(NodeId n, const Value& v, Said said) const {
  if (scene_.is_extra(v)) return true;
  if (std::ranges::find(said, v.slot) != said.end()) return false;
  const auto& t = scene_.type(n);
  if (!own_fields_ && t.fields[v.slot].is_own()) return false;
  return v.slot < n_table_fields(t) && (v.is || !equals_default(v, t.fields[v.slot]));
}

bool Extras::anything(NodeId n, Said said) const {
  return std::ranges::any_of(scene_.fields(n), [&](const Value& v) { return speaks(n, v, said); });
}

void Extras::member(JsonOut& json, NodeId n, Said said) {
  json.object("extras", [&] { vrml97(json, n, said); });
}

void Extras::vrml97(JsonOut& json, NodeId n, Said said, bool with_name) {
  json.object("vrml97", [&] { node(json, n, said, with_name); });
}

void Extras::form(JsonOut& json, NodeId n) {
  own_fields_ = true;
  json.object("extras", [&] { json.object("wrlkit", [&] { node(json, n, {}); }); });
  own_fields_ = false;
}

/// Slots of a geometry whose values its vertices, indices and material give.
Extras::Said Extras::said_by_vertices(NodeId n) const {
  using namespace nodes;
  static constexpr std::uint16_t faces[] = {indexed_face_set::colorIndex.slot,  indexed_face_set::coordIndex.slot,
                                            indexed_face_set::normalIndex.slot, indexed_face_set::texCoordIndex.slot,
                                            indexed_face_set::ccw.slot,         indexed_face_set::solid.slot};
  static constexpr std::uint16_t lines[] = {indexed_line_set::colorIndex.slot, indexed_line_set::coordIndex.slot,
                                            indexed_line_set::colorPerVertex.slot};
  return scene_.is(n, IndexedFaceSet) ? Said(faces) : scene_.is(n, IndexedLineSet) ? Said(lines) : Said();
}

/// Points and colours are in the vertices whether or not the file gave them a name; normals and texture coordinates of
/// the vertices may be made from creaseAngle and the bounding box.
bool Extras::adds_to_vertices(NodeId n, const Value& v) const {
  if (!speaks(n, v, said_by_vertices(n))) return false;
  if (scene_.is_extra(v) || info(v.type).element != Element::node) return true;
  const auto field = scene_.type(n).fields[v.slot].name;
  if (field == "metadata" && features_of(scene_, n)) return false;  // feature ids give it
  if (v.node_span().empty()) return false;
  return (field != "coord" && field != "color") || !name(v.node).empty() || is_child_with_more(v);
}

bool Extras::geometry_says_more(NodeId n) const {
  return std::ranges::any_of(scene_.fields(n), [&](const Value& v) { return adds_to_vertices(n, v); });
}

void Extras::geometry(JsonOut& json, NodeId n, std::span<const std::uint32_t> polygons, double step) {
  json.object("extras", [&] {
    json.object("vrml97", [&] {
      if (geometry_says_more(n)) {
        json.object(scene_.type(n).name, [&] {
          for (const Value& v : scene_.fields(n))
            if (adds_to_vertices(n, v)) geometry_field(json, n, v);
        });
      }
      if (!polygons.empty()) json.member("polygons", polygons);
      if (step != 1) json.member("step", step);
    });
  });
}

/// A name that another mesh has written already is not written again.
bool Extras::is_named_child(const Value& v) const {
  return !scene_.is_extra(v) && !v.is && v.type == FieldType::SFNode && v.node && !name(v.node).empty() &&
         !said_names_.contains(std::string(name(v.node)));
}

/// Of Coordinates and the like: what is not in the vertices.
bool Extras::adds_to_data(NodeId n, const Value& v) const {
  if (is_tag(scene_, n, v)) return true;
  if (!speaks(n, v, {})) return false;
  const auto field = scene_.type(n).fields[v.slot].name;
  return field != "point" && field != "color" && field != "vector" && info(v.type).element != Element::node;
}

bool Extras::is_said_of(const Value& v) const {
  return !scene_.is_extra(v) && !v.is && v.type == FieldType::SFNode && v.node &&
         !scene_.is(v.node, nodes::X3DMetadataObject);
}

/// Of a single node in a field that has tags of its own.
bool Extras::is_tagged_child(const Value& v) const { return is_said_of(v) && has_tags(scene_, v.node); }

/// Of one that says more than vertices do.
bool Extras::is_child_with_more(const Value& v) const {
  return is_said_of(v) &&
         std::ranges::any_of(scene_.fields(v.node), [&](const Value& own) { return adds_to_data(v.node, own); });
}

bool Extras::has_facts_of_geometry(NodeId n, std::span<const std::string_view> without) const {
  return has_tags(scene_, n) || std::ranges::any_of(scene_.fields(n), [&](const Value& v) {
           return is_tagged_child(v) ||
                  (is_named_child(v) &&
                   std::ranges::find(without, scene_.type(n).fields[v.slot].name) == without.end());
         });
}

void Extras::facts_of_geometry(JsonOut& json, NodeId n, std::span<const std::string_view> without) {
  json.object(scene_.type(n).name, [&] {
    tag_fields(json, n);
    for (const Value& v : scene_.fields(n)) {
      const bool named =
          is_named_child(v) && std::ranges::find(without, scene_.type(n).fields[v.slot].name) == without.end();
      if (!named && !is_tagged_child(v)) continue;
      geometry_field(json, n, v);
      said_names_.emplace(name(v.node));
    }
  });
}

bool Extras::has_facts_below(NodeId n, std::size_t depth) const {
  return has_tags(scene_, n) ||
         (depth > 0 && std::ranges::any_of(scene_.fields(n), [&](const Value& v) {
            return is_named_child(v) ||
                   (!scene_.is_extra(v) && !v.is && v.type == FieldType::SFNode && v.node &&
                    !scene_.is(v.node, nodes::X3DMetadataObject) && has_facts_below(v.node, depth - 1));
          }));
}

void Extras::facts_below(JsonOut& json, NodeId n, std::size_t depth) {
  tag_fields(json, n);
  if (depth == 0) return;
  for (const Value& v : scene_.fields(n)) {
    if (!is_said_of(v)) continue;
    const bool named = is_named_child(v);
    if (!named && !has_facts_below(v.node, depth - 1)) continue;
    json.object(scene_.type(n).fields[v.slot].name_in(Dialect::vrml97), [&] {
      json.object(scene_.type(v.node).name, [&] {
        if (named) {
          json.member("DEF", name(v.node));
          said_names_.emplace(name(v.node));
        }
        facts_below(json, v.node, depth - 1);
      });
    });
  }
}

bool Extras::has_unseen_facts(NodeId shape) const { return !shown(shape) && has_facts_below(shape, depth_of_names); }

void Extras::unseen_facts(JsonOut& json, NodeId shape) {
  json.object("vrml97", [&] { json.object("Shape", [&] { facts_below(json, shape, depth_of_names); }); });
}

void Extras::tags(JsonOut& json, NodeId n, bool with_name) {
  // Without its other fields a Switch or LOD would show something else.
  const bool chooses = scene_.is(n, nodes::Switch) || scene_.is(n, nodes::LOD);
  json.object(chooses ? "Group" : scene_.type(n).name, [&] {
    if (with_name) json.member("DEF", name(n));
    tag_fields(json, n);
  });
}

void Extras::tag_fields(JsonOut& json, NodeId n) {
  for (const Value& v : scene_.fields(n)) {
    if (!is_tag(scene_, n, v)) continue;
    json.key(scene_.is_extra(v) ? v.extra->name : scene_.type(n).fields[v.slot].name_in(Dialect::vrml97));
    field_value(json, v, 0);
  }
}

void Extras::geometry_field(JsonOut& json, NodeId n, const Value& v) {
  json.key(scene_.is_extra(v) ? v.extra->name : scene_.type(n).fields[v.slot].name_in(Dialect::vrml97));
  const bool one_node = !scene_.is_extra(v) && !is_tag(scene_, n, v) && v.type == FieldType::SFNode;
  if (!one_node || scene_.type(v.node).kind == NodeKind::unknown) return field_value(json, v, 0);
  json.object([&] {
    json.object(scene_.type(v.node).name, [&] {
      if (auto def = name(v.node); !def.empty()) json.member("DEF", def);
      for (const Value& own : scene_.fields(v.node))
        if (adds_to_data(v.node, own)) geometry_field(json, v.node, own);
    });
  });
}

void Extras::node(JsonOut& json, NodeId n, Said said, bool with_name) {
  bool again = marks_[n.value] & told;
  marks_[n.value] |= told;
  json.object(scene_.type(n).name, [&] {
    if (with_name) json.member("DEF", name(n));
    fields(json, n, said, 0, again);
  });
}

void Extras::fields(JsonOut& json, NodeId n, Said said, std::size_t depth, bool only_short) {
  const auto& t = scene_.type(n);
  for (const Value& v : scene_.fields(n)) {
    if (!speaks(n, v, said) || (only_short && is_long(scene_.content(v)))) continue;
    json.key(scene_.is_extra(v) ? v.extra->name : t.fields[v.slot].name_in(Dialect::vrml97));
    if (scene_.is_extra(v) || !urls(json, scene_.where(n), scene_.type_id(n), v.slot, v)) field_value(json, v, depth);
  }
  if (only_short || n_table_fields(t) == t.fields.size()) return;
  json.key("interface");
  interface(json, t, n, depth);
}

/// With the values of a node, otherwise with the defaults of a declaration. An instance has only what it was given:
/// what it was not is for its prototype to say, which may not be there.
void Extras::interface(JsonOut& json, const NodeType& t, NodeId n, std::size_t depth) {
  json.begin_array();
  for (std::size_t i = n_table_fields(t); i < t.fields.size(); ++i) {
    const auto& f = t.fields[i];
    const Value* given = n ? scene_.find(n, static_cast<std::uint16_t>(i)) : nullptr;
    if (n && !given && t.kind == NodeKind::proto) continue;
    json.begin_array();
    json.values(access_word(f.access), info(f.type).name, f.name_in(Dialect::vrml97));
    if (f.has_value() || (given && given->is)) value(json, given ? *given : f.default_value, depth);
    json.end_array();
  }
  json.end_array();
}

void Extras::protos(JsonOut& json, std::span<const ProtoId> declared) {
  struct Item {
    ProtoId proto;
    std::optional<std::size_t> in;
  };
  std::vector<Item> list;
  for (ProtoId p : declared) list.push_back({p, {}});
  json.key("protos");
  json.begin_array();
  for (std::size_t i = 0; i < list.size(); ++i) {
    const Proto& p = scene_.proto(list[i].proto);
    proto(json, p, list[i].in);
    for (ProtoId inner : p.body.protos) list.push_back({inner, i});
  }
  json.end_array();
}

void Extras::proto(JsonOut& json, const Proto& p, std::optional<std::size_t> in) {
  const auto& type = scene_.type(p.type);
  body_.emplace();
  json.begin_object();
  json.member(p.external ? "EXTERNPROTO" : "PROTO", type.name);
  if (in) json.member("in", *in);
  json.key("interface");
  interface(json, type, {}, 0);
  if (p.external) {
    json.key("url");
    urls(json, p.where, p.urls, UrlUse::world);
  }
  auto list = [&](std::string_view name, const auto& items, auto write) {
    if (items.empty()) return;
    json.list(name, items, write);
  };
  list("body", p.body.roots, [&](NodeId n) { reference(json, n, 0); });
  list("imports", p.body.imports, [&](const Import& i) { import(json, i); });
  list("exports", p.body.exports, [&](const Export& e) { export_(json, e); });
  list("routes", p.body.routes, [&](const Route& r) { route(json, r); });
  json.end_object();
  body_.reset();
}

bool Extras::urls(JsonOut& json, Span where, TypeId type, std::uint16_t slot, const Value& v) {
  if (v.is || v.type != FieldType::MFString || !lead_) return false;
  const auto use = url_fields_.use(type, slot);
  if (use != UrlUse::none) urls(json, where, v.text_span(), use);
  return use != UrlUse::none;
}

void Extras::urls(JsonOut& json, Span where, std::span<const std::string_view> list, UrlUse use) {
  if (!lead_) return json.value(list);
  const auto led = lead_(where, list, use);
  json.value(std::span<const std::string>(led));
}

void Extras::route(JsonOut& json, const Route& r) const {
  json.value(fmt::format("{}.{} TO {}.{}", name(r.from), r.event_out, name(r.to), r.event_in));
}

void Extras::import(JsonOut& json, const Import& i) const {
  json.value(fmt::format("{}.{} AS {}", name(i.inline_node), i.exported, name(i.node)));
}

void Extras::export_(JsonOut& json, const Export& e) const {
  json.value(fmt::format("{} AS {}", name(e.node), e.name));
}

void Extras::field_value(JsonOut& json, const Value& v, std::size_t depth) {
  if (scene_.is_extra(v)) return unknown(json, v.extra->value, depth);
  value(json, v, depth);
}

void Extras::unknown(JsonOut& json, const Value& v, std::size_t depth) {
  const bool is_list = v.type == FieldType::MFString && v.count > 0;
  const bool tells_type = is_list || v.type == FieldType::SFString || v.type == FieldType::SFBool;
  if (v.is || v.type == FieldType::verbatim || tells_type || info(v.type).element == Element::node)
    return value(json, v, depth);
  json.object([&] {
    json.key(info(v.type).name);
    value(json, v, depth);
  });
}

void Extras::value(JsonOut& json, const Value& v, std::size_t depth) {
  const auto& t = info(v.type);
  if (v.type == FieldType::verbatim || v.is) return json.object(v.is ? "IS" : "verbatim", v.text());
  switch (t.element) {
    case Element::node:
      if (!t.multiple) return reference(json, v.node, depth);
      return json.list(v.node_span(), [&](NodeId n) { reference(json, n, depth); });
    case Element::text:
      return t.multiple ? json.value(v.text_span()) : json.value(v.text());
    case Element::integer:
      if (v.type == FieldType::SFBool) return json.value(v.integer != 0);
      return t.multiple ? json.value(v.integer_span()) : json.value(v.integer);
    case Element::image:
      return json.value(v.integer_span());
    case Element::number:
      return t.multiple || t.arity > 1 ? json.value(v.number_span()) : json.value(v.number);
  }
}

void Extras::reference(JsonOut& json, NodeId n, std::size_t depth) {
  bool nameless_child = n && !body_ && is_placed(n) && name(n).empty();
  if (!n || nameless_child || too_much(n, depth)) return json.raw("null");
  json.object([&] { json.object(scene_.type(n).name, [&] { content(json, n, depth); }); });
}

void Extras::content(JsonOut& json, NodeId n, std::size_t depth) {
  auto def = name(n);
  const bool known = body_ ? !body_->insert(n.value).second : (marks_[n.value] & (placed | written)) != 0;
  if (!def.empty() && known) return json.member("USE", def);
  if (!def.empty()) json.member("DEF", def);
  if (!body_) marks_[n.value] |= written;
  ++n_written_;
  fields(json, n, {}, depth + 1);
}

// Nodes without a name can be shared, too, by instances of prototypes: those are written again and again.
bool Extras::too_much(NodeId n, std::size_t depth) {
  if (depth >= max_depth) {
    diag_.report(Diag::no_gltf_depth, scene_.where(n), max_depth);
    return true;
  }
  if (n_written_ == max_nodes) {
    diag_.report(Diag::expansion_limit, scene_.where(n), max_nodes, "nodes in extras");
    ++n_written_;
  }
  return n_written_ > max_nodes;
}

}  // namespace wrlkit::gltf
