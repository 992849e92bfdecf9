// What connects nodes: USE of those that come later, ROUTEs, IMPORT and EXPORT.
#include <unordered_set>
#include <utility>

#include "parsers/gltf/extras.h"
#include "scenegraph/legal_name.h"
#include "scenegraph/nodes.h"
#include "scenegraph/walk.h"

namespace wrlkit::gltf_reader {
namespace {

/// "Node.event" in two.
std::pair<std::string_view, std::string_view> split(std::string_view s) {
  auto point = s.rfind('.');
  return point == s.npos ? std::pair{s, std::string_view{}} : std::pair{s.substr(0, point), s.substr(point + 1)};
}

}  // namespace

void Extras::routes(Json list, Scope& scope) {
  for (Json r : list.elements()) {
    auto text = r.text();
    auto to_at = text.find(" TO ");
    if (to_at == text.npos) {
      bad(r, "a ROUTE");
      continue;
    }
    auto [from, out] = split(text.substr(0, to_at));
    auto [to, in] = split(text.substr(to_at + 4));
    NodeId a = named(from), b = named(to);
    if (!is_read_as_name(out) || !is_legal_name(in))
      bad(r, "a ROUTE");
    else if (a && b)
      scope.routes.push_back({a, b, c_.scene.keep(out), c_.scene.keep(in)});
    else
      c_.diag().report(Diag::undefined_route, c_.file.where(r), a ? to : from);
  }
}

/// False when the one is in the other already. For files that ask this for very many nodes: false.
bool Extras::may_hold(NodeId owner, NodeId held) {
  constexpr std::size_t most_steps = 50'000'000;
  const auto& t = c_.scene.type(owner);
  if (t.name == "Script" || t.kind == NodeKind::proto) return true;
  std::vector<NodeId> open{held};
  std::unordered_set<std::uint32_t> seen;
  while (!open.empty()) {
    NodeId n = open.back();
    open.pop_back();
    if (n == owner || ++n_steps_ > most_steps) return false;
    if (n && seen.insert(n.value).second) for_each_child(c_.scene, n, [&](NodeId c) { open.push_back(c); });
  }
  return true;
}

/// Nodes that are held and that stood behind them, from a place in pending_ on.
void Extras::resolve(std::size_t first) {
  for (auto p = pending_.begin() + static_cast<std::ptrdiff_t>(first); p != pending_.end(); ++p) {
    const Value* old = c_.scene.find(p->owner, p->slot);
    if (!old) continue;
    NodeId n = named(p->name);
    if (!n)
      c_.diag().report(Diag::undefined_use, c_.scene.where(p->owner), p->name);
    else if (!may_hold(p->owner, n)) {
      c_.diag().report(Diag::use_cycle, c_.scene.where(p->owner), p->name);
      n = {};
    }
    std::vector<NodeId> all(old->node_span().begin(), old->node_span().end());
    if (!info(old->type).multiple)
      c_.scene.set(p->owner, c_.scene.make(old->type, p->slot, n));
    else if (p->position < all.size()) {
      all[p->position] = n;
      c_.scene.set(p->owner, c_.scene.make(old->type, p->slot, all));
    }
  }
  for (auto p = pending_.begin() + static_cast<std::ptrdiff_t>(first); p != pending_.end(); ++p)
    if (const Value* v = c_.scene.find(p->owner, p->slot); v && info(v->type).multiple) {
      std::vector<NodeId> all(v->node_span().begin(), v->node_span().end());
      if (std::erase(all, NodeId{})) c_.scene.set(p->owner, c_.scene.make(v->type, p->slot, all));
    }
  pending_.resize(first);
}

void Extras::imports(Json list, Scope& scope) {
  for (Json i : list.elements()) {
    const auto text = i.text();
    const auto as_at = text.find(" AS ");
    if (as_at == text.npos) {
      bad(i, "an IMPORT");
      continue;
    }
    const auto [world, exported] = split(text.substr(0, as_at));
    const auto name = text.substr(as_at + 4);
    const NodeId n = named(world);
    if (!is_read_as_name(exported) || !is_legal_name(name)) {
      bad(i, "an IMPORT");
    } else if (!c_.scene.is(n, wrlkit::nodes::Inline)) {
      c_.diag().report(Diag::undefined_import, c_.file.where(i), "IMPORT", world, n ? "not an Inline" : "not defined");
    } else if (named(name)) {
      c_.diag().report(Diag::duplicate_import, c_.file.where(i), "IMPORT", name);
    } else {
      scope.imports.push_back({n, c_.scene.keep(exported), c_.scene.add_stand_in(name, c_.file.where(i))});
      define(scope.imports.back().node);
    }
  }
}

void Extras::exports(Json list, Scope& scope) {
  for (Json e : list.elements()) {
    const auto text = e.text();
    const auto as_at = text.find(" AS ");
    const auto name = as_at == text.npos ? std::string_view() : text.substr(as_at + 4);
    const NodeId n = named(text.substr(0, as_at));
    if (!is_read_as_name(name))
      bad(e, "an EXPORT");
    else if (!n)
      c_.diag().report(Diag::undefined_import, c_.file.where(e), "EXPORT", text.substr(0, as_at), "not defined");
    else
      scope.exports.push_back({n, c_.scene.keep(name)});
  }
}

/// What connects the nodes of a scope with each other and with other scenes.
void Extras::links(Json from, Scope& scope) {
  imports(from["imports"], scope);
  exports(from["exports"], scope);
  routes(from["routes"], scope);
}

void Extras::finish(Json scene) {
  resolve(0);
  links(scene, c_.scene.main);
}

}  // namespace wrlkit::gltf_reader
