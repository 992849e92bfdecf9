#include "passes/expand_protos.h"

#include <algorithm>
#include <unordered_map>
#include <utility>

#include "scenegraph/nodes.h"
#include "scenegraph/walk.h"

namespace wrlkit {
namespace {

constexpr std::size_t deepest = 500;  // prototypes inside each other

bool is_instance(const Scene& s, NodeId n) { return s.type(n).kind == NodeKind::proto; }

/// What is known of a prototype before its first instance is expanded.
struct Prepared {
  enum State : std::uint8_t { fresh, busy, ready, missing } state = fresh;
  ProtoId body;                      // the one with a body: itself, or what an EXTERNPROTO names
  std::vector<NodeId> extra_roots;   // roots behind the first that events can reach
};

class Expansion {
 public:
  Expansion(Scene& scene, const ExpandProtosOptions& options, PassContext& ctx) : scene_(scene), options_(options), ctx_(ctx) {}

  Outcome run() {
    routes_ = scene_.main.routes;
    for (std::size_t i = 0; i < routes_.size(); ++i) index_route(i);
    todo_.assign(scene_.main.roots.rbegin(), scene_.main.roots.rend());
    while (!todo_.empty()) {
      NodeId n = todo_.back();
      todo_.pop_back();
      visit(n);
    }
    finish();
    return expanded_ ? Outcome::changed : Outcome::unchanged;
  }

 private:
  struct Target {
    NodeId node;
    std::string_view event;
  };
  /// Inside one instance: which inner events an event of the interface stands for.
  using Events = std::unordered_multimap<std::string, Target>;

  void visit(NodeId n) {
    if (n.value >= seen_.size()) seen_.resize(scene_.node_count() + 1024, 0);
    if (seen_[n.value]) return;
    seen_[n.value] = 1;
    // The first node of a body may be an instance itself.
    for (std::size_t depth = 0; is_instance(scene_, n) && depth < deepest; ++depth)
      if (!expand(n)) break;
    auto mark = todo_.size();
    for_each_child(scene_, n, [&](NodeId c) { todo_.push_back(c); });
    std::reverse(todo_.begin() + static_cast<std::ptrdiff_t>(mark), todo_.end());
  }

  // ---- prototypes --------------------------------------------------------------------------------------------------
  Prepared& prepare(ProtoId p, std::size_t depth) {
    auto& info = prepared_[p.value];
    if (info.state != Prepared::fresh) return info;
    info.state = Prepared::busy;
    ProtoId body = scene_.proto(p).external ? find_external(p, depth) : p;
    bool found = body && depth < deepest && !scene_.proto(body).body.roots.empty();
    if (found) {
      mark_varying(body);
      prepare_inner(body, depth);
    }
    auto& done = prepared_[p.value];
    done.body = body;
    done.state = found ? Prepared::ready : Prepared::missing;
    if (found) {
      auto& roots = scene_.proto(body).body.roots;
      std::copy_if(roots.begin() + 1, roots.end(), std::back_inserter(done.extra_roots), [&](NodeId n) { return varying(n); });
    }
    return done;
  }

  /// Instances in a body of a prototype that is being prepared would contain themselves (possible through EXTERNPROTO).
  void prepare_inner(ProtoId body, std::size_t depth) {
    for (NodeId n : reachable(scene_, scene_.proto(body).body)) {
      if (!is_instance(scene_, n)) continue;
      if (prepare(scene_.type(n).proto, depth + 1).state != Prepared::busy) continue;
      ctx_.diag.report(Diag::proto_cycle, scene_.where(n), scene_.type(n).name);
      scene_.become(n, nodes::Group, {});
    }
  }

  ProtoId find_external(ProtoId p, std::size_t depth) {
    auto urls = scene_.proto(p).urls;
    auto where = scene_.proto(p).where;
    if (!ctx_.resources || urls.empty() || depth >= deepest) return {};
    auto world = ctx_.resources->world(urls, where, ctx_.diag);
    if (!world) return {};
    for (auto url : urls) {
      auto hash = url.find('#');
      auto name = hash == url.npos ? std::string_view{} : url.substr(hash + 1);
      for (ProtoId candidate : protos_of(world)) {
        if (!name.empty() && scene_.type(scene_.proto(candidate).type).name != name) continue;
        if (!scene_.proto(candidate).external) return candidate;
        auto& far = prepare(candidate, depth + 1);
        return far.state == Prepared::ready ? far.body : ProtoId{};
      }
    }
    ctx_.diag.report(Diag::proto_not_found, where, scene_.type(scene_.proto(p).type).name, urls[0]);
    return {};
  }

  std::vector<ProtoId> protos_of(const std::shared_ptr<const Scene>& world) {
    if (world.get() == &scene_) return scene_.main.protos;
    auto known = libraries_.find(world.get());
    if (known == libraries_.end()) {
      kept_.push_back(world);
      known = libraries_.emplace(world.get(), scene_.import(*world).protos).first;
    }
    return known->second;
  }

  // ---- what varies between instances -------------------------------------------------------------------------------
  bool varying(NodeId n) const { return n.value < varying_.size() && varying_[n.value]; }

  /// A node varies when it has an IS, is an end of a ROUTE, or holds one that varies.
  void mark_varying(ProtoId body) {
    auto order = reachable(scene_, scene_.proto(body).body);
    varying_.resize(std::max(varying_.size(), scene_.node_count()));
    for (auto& r : scene_.proto(body).body.routes) varying_[r.from.value] = varying_[r.to.value] = 1;
    for (NodeId n : order)
      for (auto& v : scene_.fields(n))
        if (scene_.content(v).is) varying_[n.value] = 1;
    // Parents come before children in a depth-first order, but sharing can put a parent behind; repeat until it holds.
    for (bool again = true; again;) {
      again = false;
      for (auto n = order.rbegin(); n != order.rend(); ++n) {
        if (varying_[n->value]) continue;
        bool holds = false;
        for_each_child(scene_, *n, [&](NodeId c) { holds |= varying_[c.value] != 0; });
        if (holds) varying_[n->value] = 1, again = true;
      }
    }
  }

  // ---- instances ---------------------------------------------------------------------------------------------------
  struct Instance {
    NodeId node;
    TypeId interface;
    TypeId declared;  // of the body: has the defaults
    std::vector<Value> values;
    std::unordered_map<std::uint32_t, NodeId> copies;
    Events events;
  };

  bool expand(NodeId n) {
    auto& info = prepare(scene_.type(n).proto, 0);
    if (info.state != Prepared::ready) return false;
    if (copied_ > static_cast<std::size_t>(options_.limit)) {
      ctx_.diag.report(Diag::expansion_limit, scene_.where(n), options_.limit, "nodes of prototypes");
      return false;
    }
    expanded_ = true;
    const ProtoId body = info.body;
    const auto extra = info.extra_roots;
    auto written = scene_.fields(n);
    Instance i{n, scene_.type_id(n), scene_.proto(body).type, {written.begin(), written.end()}, {}, {}};
    NodeId first = scene_.proto(body).body.roots[0];
    i.copies[first.value] = n;
    fill(i, first, n);
    for (NodeId e : extra) detached_.push_back(copy(i, e));
    while (!i_todo_.empty()) {
      auto [from, to] = i_todo_.back();
      i_todo_.pop_back();
      fill(i, from, to);
    }
    redirect(i);
    for (auto r : scene_.proto(body).body.routes) add_route({copy(i, r.from), copy(i, r.to), r.event_out, r.event_in});
    while (!i_todo_.empty()) {  // ends of ROUTEs that are in no tree
      auto [from, to] = i_todo_.back();
      i_todo_.pop_back();
      fill(i, from, to);
    }
    return true;
  }

  /// The node that stands for `n` of the body in this instance.
  NodeId copy(Instance& i, NodeId n) {
    if (!n || !varying(n)) return i.copies.count(n.value) ? i.copies[n.value] : n;
    auto [entry, fresh] = i.copies.emplace(n.value, NodeId{});
    if (!fresh) return entry->second;
    NodeId to = scene_.add(scene_.type_id(n), scene_.where(n));
    scene_.set_name(to, scene_.name(n));
    ++copied_;
    entry->second = to;
    i_todo_.push_back({n, to});
    return to;
  }

  /// Gives `to` the type and fields of `from`, with the values of the instance where the body says IS.
  void fill(Instance& i, NodeId from, NodeId to) {
    std::vector<Value> fields;
    std::vector<Value> source(scene_.fields(from).begin(), scene_.fields(from).end());
    for (const Value& v : source) {
      const Value& content = scene_.content(v);
      if (!content.is) { fields.push_back(copy_value(i, v)); continue; }
      connect(i, from, to, v);
      if (scene_.is_extra(v)) continue;
      const auto& def = scene_.type(from).fields[v.slot];
      if (!def.has_value()) continue;
      if (const Value* given = value_of(i, content.text()); given && fits(*given, def.type)) {
        fields.push_back(adapt(*given, def.type, v.slot));
      }
    }
    scene_.become(to, scene_.type_id(from), fields);
    if (to != i.node) seen_.resize(std::max(seen_.size(), scene_.node_count()), 0);
  }

  Value copy_value(Instance& i, const Value& v) {
    if (scene_.is_extra(v)) {
      if (info(v.extra->value.type).element != Element::node) return v;
      return scene_.make_extra(v.extra->name, copy_value(i, [&] { Value c = v.extra->value; c.slot = 0; return c; }()));
    }
    if (info(v.type).element != Element::node) return v;
    std::vector<NodeId> to;
    bool same = true;
    for (NodeId c : v.node_span()) { to.push_back(copy(i, c)); same &= to.back() == c; }
    if (same) return v;
    return info(v.type).multiple ? scene_.make(v.type, v.slot, to) : scene_.make(v.type, v.slot, to[0]);
  }

  /// The value that the instance gives a field of the interface, or the default of the prototype. An EXTERNPROTO may
  /// declare the fields in another order than the file it names.
  const Value* value_of(const Instance& i, std::string_view name) const {
    const auto& interface = scene_.type(i.interface);
    for (const Value& v : i.values)
      if (!scene_.is_extra(v) && !v.is && interface.fields[v.slot].name == name) return &v;
    for (const auto& f : scene_.type(i.declared).fields)
      if (f.name == name && f.has_value()) return &f.default_value;
    return nullptr;
  }

  static bool fits(const Value& v, FieldType t) {
    const auto &a = info(v.type), &b = info(t);
    return !v.is && a.element == b.element && a.arity == b.arity && (a.multiple == b.multiple || a.element == Element::node);
  }

  Value adapt(Value v, FieldType t, std::uint16_t slot) {
    if (v.type != t && info(t).element == Element::node && info(t).multiple != info(v.type).multiple) {
      auto nodes = v.node_span();
      return info(t).multiple ? scene_.make(t, slot, nodes) : scene_.make(t, slot, nodes.empty() ? NodeId{} : nodes[0]);
    }
    v.type = t;
    v.slot = slot;
    return v;
  }

  // ---- events ------------------------------------------------------------------------------------------------------
  void connect(Instance& i, NodeId from, NodeId to, const Value& v) {
    auto outer = std::string(scene_.content(v).text());
    auto inner = scene_.is_extra(v) ? v.extra->name : scene_.type(from).fields[v.slot].name_in(scene_.dialect());
    i.events.emplace(outer, Target{to, inner});
    if (scene_.is_extra(v) || scene_.type(from).fields[v.slot].access != Access::inout) return;
    i.events.emplace("set_" + outer, Target{to, scene_.keep("set_" + std::string(inner))});
    i.events.emplace(outer + "_changed", Target{to, scene_.keep(std::string(inner) + "_changed")});
  }

  void index_route(std::size_t i) {
    by_node_[routes_[i].from.value].push_back(i);
    if (routes_[i].to != routes_[i].from) by_node_[routes_[i].to.value].push_back(i);
  }
  void add_route(const Route& r) {
    routes_.push_back(r);
    index_route(routes_.size() - 1);
  }

  /// ROUTEs from and to the instance, all of them written outside of its body, go to the inner nodes.
  void redirect(Instance& i) {
    auto found = by_node_.find(i.node.value);
    if (found == by_node_.end()) return;
    auto old = std::move(found->second);
    by_node_.erase(found);
    for (std::size_t r : old) {
      Route route = std::exchange(routes_[r], Route{});
      if (!route.from) continue;
      std::vector<Target> from{{route.from, route.event_out}}, to{{route.to, route.event_in}};
      if (route.from == i.node) from = targets(i, route.event_out);
      if (route.to == i.node) to = targets(i, route.event_in);
      for (auto& f : from)
        for (auto& t : to) add_route({f.node, t.node, f.event, t.event});
    }
  }

  static std::vector<Target> targets(const Instance& i, std::string_view event) {
    std::vector<Target> out;
    auto [b, e] = i.events.equal_range(std::string(event));
    for (; b != e; ++b) out.push_back(b->second);
    return out;
  }

  // ---- the end -----------------------------------------------------------------------------------------------------
  void finish() {
    for (std::size_t k = 0; k < detached_.size(); ++k) {  // they may hold instances, too
      todo_.push_back(detached_[k]);
      while (!todo_.empty()) {
        NodeId n = todo_.back();
        todo_.pop_back();
        visit(n);
      }
    }
    std::erase_if(routes_, [](const Route& r) { return !r.from; });
    scene_.main.routes = std::move(routes_);
    if (!detached_.empty()) {
      NodeId hidden = scene_.add(nodes::Switch);
      scene_.set(hidden, nodes::switch_::children, detached_);
      scene_.main.roots.push_back(hidden);
    }
    if (!options_.keep_declarations) std::erase_if(scene_.main.protos, [&](ProtoId p) { auto i = prepared_.find(p.value); return i == prepared_.end() || i->second.state != Prepared::missing; });
  }

  Scene& scene_;
  const ExpandProtosOptions& options_;
  PassContext& ctx_;
  std::unordered_map<std::uint32_t, Prepared> prepared_;
  std::unordered_map<const Scene*, std::vector<ProtoId>> libraries_;
  std::vector<std::shared_ptr<const Scene>> kept_;
  std::vector<char> seen_, varying_;
  std::vector<NodeId> todo_, detached_;
  std::vector<std::pair<NodeId, NodeId>> i_todo_;
  std::vector<Route> routes_;
  std::unordered_map<std::uint32_t, std::vector<std::size_t>> by_node_;
  std::size_t copied_ = 0;
  bool expanded_ = false;
};

}  // namespace

Outcome expand_protos(Scene& scene, const ExpandProtosOptions& options, PassContext& ctx) { return Expansion(scene, options, ctx).run(); }

}  // namespace wrlkit
