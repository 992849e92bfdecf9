#include "passes/analysis/prototypes.h"

#include <algorithm>

#include "passes/analysis/native_node.h"
#include "scenegraph/legal_name.h"
#include "scenegraph/nodes.h"
#include "scenegraph/walk.h"

namespace wrlkit {
namespace {

constexpr std::size_t most_nested = 500;  // prototypes inside each other
const Prototype contains_itself{.state = Prototype::busy};

}  // namespace

const Prototype& Prototypes::prepare(ProtoId p) {
  auto& known = known_[p.value];
  if (known.state != Prototype::fresh) return known;
  known.state = Prototype::busy;
  const Proto& proto = scene_.proto(p);
  busy_.push_back(name(proto));
  Prototype result;
  if (proto.external)
    result = find_body(proto);
  else if (proto.body.roots.empty())
    result.state = Prototype::empty;
  else {
    look_into(proto);
    auto has_state = [&](NodeId n) {
      auto& t = known_[scene_.type(n).proto.value];
      return t.has_state || t.state == Prototype::missing;
    };
    result = {Prototype::ready, p, own_.mark(scene_, proto.body, defaults(proto), has_state)};
  }
  busy_.pop_back();
  if (result.state == Prototype::busy && busy_.empty()) {
    ctx_.diag.report(Diag::proto_cycle, proto.where, name(proto));
    result.state = Prototype::missing;
  }
  // What is part of a circle here can be whole elsewhere: it is asked for again.
  if (result.state == Prototype::busy) {
    known = {};
    return contains_itself;
  }
  return known = result;
}

bool Prototypes::is_missing(ProtoId p) const {
  auto i = known_.find(p.value);
  return i != known_.end() && i->second.state == Prototype::missing;
}

Prototype Prototypes::find_body(const Proto& external) {
  if (const ProtoId native = native_proto(scene_, external)) return prepare(native);
  ProtoId far = busy_.size() < most_nested ? find_external(external) : ProtoId{};
  return far ? prepare(far) : Prototype{.state = Prototype::missing};
}

/// In the first file that has it: urls are in order of preference (4.9.3).
ProtoId Prototypes::find_external(const Proto& external) {
  if (!ctx_.resources) return {};
  std::string_view without_it;
  for (std::span<const std::string_view> urls = external.urls; !urls.empty();) {
    const auto [world, url] = ctx_.resources->world(urls, external.where, ctx_.diag);
    if (!world) break;
    if (ProtoId p = library(world).named_by(url)) return p;
    if (without_it.empty()) without_it = url;
    urls = urls.subspan(static_cast<std::size_t>(std::ranges::find(urls, url) - urls.begin()) + 1);
  }
  if (!without_it.empty()) ctx_.diag.report(Diag::proto_not_found, external.where, name(external), without_it);
  return {};
}

/// Without #name it is the first PROTO of the file; EXTERNPROTOs do not count then (4.9.3).
ProtoId Prototypes::Library::named_by(std::string_view url) const {
  const auto hash = url.find('#');
  if (hash == url.npos) return first;
  const auto i = by_name.find(url.substr(hash + 1));
  return i == by_name.end() ? ProtoId{} : i->second;
}

const Prototypes::Library& Prototypes::library(const std::shared_ptr<const Scene>& world) {
  auto [known, is_new] = libraries_.try_emplace(world.get());
  Library& lib = known->second;
  if (!is_new) return lib;
  kept_.push_back(world);
  for (ProtoId p : world.get() == &scene_ ? scene_.main.protos : scene_.import(*world).protos) {
    lib.by_name.emplace(name(scene_.proto(p)), p);
    if (!lib.first && !scene_.proto(p).external) lib.first = p;
  }
  const auto named = lib.by_name;
  for (const auto& [name, p] : named) lib.by_name.emplace(vrml97_name(name), p);
  return lib;
}

void Prototypes::look_into(const Proto& proto) {
  std::vector<NodeId> nodes;
  reach(scene_, proto.body.roots, met_, nodes);
  reach(scene_, defaults(proto), met_, nodes);
  for (NodeId n : nodes) look_at(n);
}

/// A body that names its own prototype has a node of unknown type there, for the name is known only behind the body
/// (4.8.4); only an EXTERNPROTO can really lead back.
void Prototypes::look_at(NodeId n) {
  const auto& type = scene_.type(n);
  if (type.kind == NodeKind::unknown && std::ranges::find(busy_, type.name) != busy_.end())
    ctx_.diag.report(Diag::proto_cycle, scene_.where(n), type.name);
  if (type.kind != NodeKind::proto) return;
  const bool too_deep = busy_.size() >= most_nested;
  if (!too_deep && prepare(type.proto).state != Prototype::busy) return;
  if (too_deep)
    ctx_.diag.report(Diag::too_deep, scene_.where(n), most_nested);
  else
    ctx_.diag.report(Diag::proto_cycle, scene_.where(n), type.name);
  scene_.become(n, nodes::Group, {});
}

std::vector<NodeId> Prototypes::defaults(const Proto& proto) const {
  std::vector<NodeId> out;
  for (const auto& f : scene_.type(proto.type).fields)
    out.insert(out.end(), f.default_value.node_span().begin(), f.default_value.node_span().end());
  return out;
}

/// What a file of VRML97 that was made from X3D calls it, where it refers to X3D still.
std::string_view Prototypes::vrml97_name(std::string_view name) {
  return is_legal_name(name) ? name : scene_.keep(legal_name(name));
}

const FieldDef* Prototypes::field(ProtoId body, std::string_view name) {
  auto [known, is_new] = interfaces_.try_emplace(body.value);
  if (is_new) {
    const auto& fields = scene_.type(scene_.proto(body).type).fields;
    for (const auto& f : fields) known->second.emplace(f.name, &f);
    for (const auto& f : fields) known->second.emplace(vrml97_name(f.name), &f);
  }
  auto i = known->second.find(name);
  return i == known->second.end() ? nullptr : i->second;
}

const FieldDef* Prototypes::exposed_field(ProtoId body, std::string_view event) {
  const FieldDef* f = field(body, event);
  if (!f && event.starts_with("set_")) f = field(body, event.substr(4));
  if (!f && event.ends_with("_changed")) f = field(body, event.substr(0, event.size() - 8));
  return f && f->access == Access::inout ? f : nullptr;
}

}  // namespace wrlkit
