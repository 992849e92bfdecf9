#include "passes/expand_protos/expand_protos.h"

#include <algorithm>
#include <unordered_map>
#include <utility>

#include "passes/analysis/nesting.h"
#include "passes/analysis/own_nodes.h"
#include "passes/analysis/prototypes.h"
#include "passes/analysis/route_table.h"
#include "passes/expand_protos/instance_values.h"
#include "scenegraph/any_node.h"
#include "scenegraph/nodes.h"
#include "scenegraph/walk.h"

namespace wrlkit {
namespace {

bool is_instance(const Scene& s, NodeId n) { return s.type(n).kind == NodeKind::proto; }

/// One end of a ROUTE.
struct End {
  NodeId node;
  std::string_view event;
};

/// The inner events that an event of the interface stands for. An exposedField receives and sends.
struct Ends {
  std::vector<End> in, out;
};

/// A value that an instance gives a field, under the body's own definition of that field.
struct Given {
  const FieldDef* field;
  Value value;
};

/// One instance while it is being expanded.
struct Instance {
  NodeId node;
  Span where;  // of the instance; its node can get another place
  ProtoId body;
  std::vector<Given> given;  // sorted by field
  Copies copies;
  bool routed;                                       // ROUTEs touch it
  std::unordered_map<const FieldDef*, Ends> events;  // of the interface, if routed
};

/// Equal for instances of a body that have equal values. Long arrays count as equal only when they are the same array.
class Key {
 public:
  explicit Key(ProtoId body) { number(body.value); }
  void add(const Given& g, std::string_view file) {
    pointer(g.field);
    add(g.value, file);
  }
  void add(const InstanceValues::Unused& u, std::string_view file) {
    number(u.name.size());
    key_ += u.name;
    add(u.value, file);
  }
  std::string text() && { return std::move(key_); }

 private:
  void add(const Value& v, std::string_view file) {
    constexpr std::size_t most = 64;
    number(v.type);
    number(v.count);
    const auto numbers = v.number_span();
    const auto integers = v.integer_span();
    switch (const auto& t = info(v.type); t.element) {
      case Element::node:
        return t.multiple ? pointer(v.nodes) : number(v.node.value);
      case Element::text:
        if (t.multiple) {
          pointer(v.texts);
          key_ += file;
        }  // these may be urls, which are relative to a file
        else if (v.count <= most)
          key_ += v.text();
        else
          pointer(v.chars);
        return;
      case Element::number:
        return numbers.size() <= most ? bytes(numbers.data(), numbers.size_bytes()) : pointer(v.numbers);
      case Element::integer:
      case Element::image:
        return integers.size() <= most ? bytes(integers.data(), integers.size_bytes()) : pointer(v.integers);
    }
  }
  void bytes(const void* p, std::size_t n) { key_.append(static_cast<const char*>(p), n); }
  void pointer(const void* p) { bytes(&p, sizeof p); }
  void number(auto n) { bytes(&n, sizeof n); }
  std::string key_;
};

class Expansion {
 public:
  Expansion(Scene& scene, const ExpandProtosOptions& options, PassContext& ctx, ExpansionBudget& budget)
      : scene_(scene),
        options_(options),
        ctx_(ctx),
        prototypes_(scene, ctx),
        values_(scene, prototypes_, ctx.diag),
        budget_(budget),
        routes_(scene.main.routes) {}

  Outcome run() {
    visit_all({scene_.main.roots.begin(), scene_.main.roots.end()});
    // NOLINTNEXTLINE(modernize-loop-convert): the list grows
    for (std::size_t i = 0; i < hidden_.size(); ++i) visit_all({hidden_[i]});
    if (!expanded_) return Outcome::unchanged;
    finish();
    return Outcome::changed;
  }

 private:
  void visit_all(std::vector<NodeId> open) {
    std::ranges::reverse(open);
    while (!open.empty()) {
      NodeId n = open.back();
      open.pop_back();
      if (n.value >= seen_.size()) seen_.resize(scene_.node_count() + scene_.node_count() / 2);
      if (std::exchange(seen_[n.value], 1)) continue;
      while (is_instance(scene_, n) && expand(n)) {
      }  // the first node of a body may be an instance itself
      auto mark = open.size();
      for_each_child(scene_, n, [&](NodeId c) { open.push_back(c); });
      std::reverse(open.begin() + static_cast<std::ptrdiff_t>(mark), open.end());
    }
  }

  // ---- instances ---------------------------------------------------------------------------------------------------
  struct Known {
    NodeId node;
    Span where;          // where the instance stood that it was made for
    std::size_t n_sets;  // of metadata that it had as an instance of something else
  };

  bool expand(NodeId n) {
    const Prototype& p = prototypes_.of(n);
    if (p.state != Prototype::ready && p.state != Prototype::empty) return false;
    expanded_ = true;
    const bool routed = routes_.touches(n), whole = p.has_state || routed;
    const auto unused = values_.unused(n, p, whole);
    if (p.state == Prototype::empty || !spend(1, scene_.where(n))) {
      values_.add(n, unused);
      scene_.become(n, nodes::Group, {});
      return false;
    }
    Instance i{n, scene_.where(n), p.body, given_by(n, p.body), {scene_, prototypes_.own()}, routed, {}};
    if (whole) {
      values_.add(n, unused);
      expand_alone(i, true);
      return true;
    }
    Key key(i.body);
    for (const Given& g : i.given) key.add(g, scene_.sources->file(i.where.begin));
    for (const auto& u : unused) key.add(u, scene_.sources->file(i.where.begin));
    auto [known, is_new] = known_.try_emplace(std::move(key).text(), Known{n, i.where, values_.n_sets(n)});
    if (is_new) {
      values_.add(n, unused);
      expand_alone(i, false);
    } else {
      expand_like(n, known->second);
    }
    return true;
  }

  /// The instance has the same nodes as another one.
  void expand_like(NodeId n, const Known& other) {
    budget_.spent += cost_of_copy(scene_, other.node);
    values_.add_like(n, other.node, other.n_sets);
    scene_.become(n, scene_.type_id(other.node), scene_.fields(other.node));
    bool moved = scene_.where(other.node).begin != other.where.begin;
    if (moved) scene_.set_where(n, scene_.where(other.node));
  }

  void expand_alone(Instance& i, bool with_events) {
    const Scope& body = scene_.proto(i.body).body;
    i.copies.put(body.roots[0], i.node);
    fill(i, body.roots[0], i.node);
    if (with_events)
      for (std::size_t k = 1; k < body.roots.size(); ++k)
        if (prototypes_.own()[body.roots[k]]) hidden_.push_back(i.copies.of(body.roots[k]));
    for (const Route& r : body.routes) {
      i.copies.of(r.from);
      i.copies.of(r.to);
    }
    for (const Import& m : body.imports)
      scene_.main.imports.push_back({i.copies.of(m.inline_node), m.exported, i.copies.of(m.node)});
    for (NodeId from, to; i.copies.next(from, to);) fill(i, from, to);
    if (i.routed) redirect(i);
    for (const Route& r : body.routes)
      add_route({i.copies.of(r.from), i.copies.of(r.to), r.event_out, r.event_in}, i.where);
  }

  /// Values that the instance writes. An EXTERNPROTO may declare the fields in another order than the file it names.
  std::vector<Given> given_by(NodeId n, ProtoId body) {
    std::vector<Given> out;
    const auto& interface = scene_.type(n).fields;
    for (const Value& v : scene_.fields(n)) {
      if (scene_.is_extra(v) || v.is) continue;
      if (auto* f = prototypes_.field(body, interface[v.slot].name)) out.push_back({f, v});
    }
    std::ranges::sort(out, {}, &Given::field);
    return out;
  }

  static const Given* find(const std::vector<Given>& given, const FieldDef& f) {
    auto g = std::ranges::lower_bound(given, &f, {}, &Given::field);
    return g != given.end() && g->field == &f ? &*g : nullptr;
  }

  static Value default_of(Instance& i, const FieldDef& f) {
    Value v = f.default_value;
    v.slot = 0;
    return i.copies.of(v);
  }

  // ---- nodes -------------------------------------------------------------------------------------------------------
  /// Gives `to` the type and fields of `from`, with the values of the instance where the body says IS.
  void fill(Instance& i, NodeId from, NodeId to) {
    budget_.spent += cost_of_copy(scene_, from);
    std::vector<Value> fields;
    const auto source = scene_.copy_of_fields(from);
    bool urls_given = false, urls_here = false;
    for (const Value& v : source) {
      const Value& content = scene_.content(v);
      if (!content.is) {
        fields.push_back(i.copies.of(v));
        urls_here |= content.type == FieldType::MFString;
        continue;
      }
      const FieldDef* outer = prototypes_.field(i.body, content.text());
      if (!outer) continue;
      if (i.routed) connect(i.events[outer], from, to, v);
      const Given* given = find(i.given, *outer);
      if (!given && !outer->has_value()) continue;
      if (!add_value(from, v, given ? given->value : default_of(i, *outer), fields)) continue;
      if (outer->type == FieldType::MFString) (given ? urls_given : urls_here) = true;
    }
    scene_.become(to, scene_.type_id(from), fields);
    if (urls_given)
      scene_.set_where(to, i.where);
    else if (urls_here)
      scene_.set_where(to, scene_.where(from));
  }

  /// False when the field of `from` cannot have that value: an event, or another type.
  bool add_value(NodeId from, const Value& field, const Value& value, std::vector<Value>& out) {
    const auto& type = scene_.type(from);
    if (scene_.is_extra(field)) {  // set_x IS y of a known node, or a field of an unknown one
      if (type.kind != NodeKind::unknown) return false;
      out.push_back(scene_.make_extra(field.extra->name, value));
      return true;
    }
    const FieldDef& def = type.fields[field.slot];
    if (!def.has_value() || !fits(value, def.type)) return false;
    out.push_back(adapt(value, def.type, field.slot));
    return true;
  }

  static bool fits(const Value& v, FieldType t) {
    const auto &a = info(v.type), &b = info(t);
    return !v.is && a.element == b.element && a.arity == b.arity &&
           (a.multiple == b.multiple || a.element == Element::node);
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
  void connect(Ends& outer, NodeId from, NodeId to, const Value& v) {
    const auto& type = scene_.type(from);
    if (scene_.is_extra(v)) {  // set_x IS y of an exposedField x, or anything of an unknown node
      auto name = v.extra->name;
      if (!name.ends_with("_changed")) outer.in.push_back({to, name});
      if (!name.starts_with("set_")) outer.out.push_back({to, name});
      return;
    }
    const FieldDef& f = type.fields[v.slot];
    const auto name = f.name_in(scene_.dialect());
    const bool both = f.access == Access::inout;
    if (both || f.access == Access::in) outer.in.push_back({to, both ? scene_.keep("set_" + std::string(name)) : name});
    if (both || f.access == Access::out)
      outer.out.push_back({to, both ? scene_.keep(std::string(name) + "_changed") : name});
  }

  /// ROUTEs from and to the instance, all of them written outside of its body, go to the inner nodes.
  void redirect(Instance& i) {
    auto routes = routes_.take(i.node);
    pass_on(i, routes);
    for (const Route& r : routes) {
      const auto from = r.from == i.node ? ends(i, r.event_out).out : std::vector<End>{{r.from, r.event_out}};
      const auto to = r.to == i.node ? ends(i, r.event_in).in : std::vector<End>{{r.to, r.event_in}};
      for (const End& f : from)
        for (const End& t : to)
          if (!add_route({f.node, t.node, f.event, t.event}, i.where)) return;
    }
  }

  const Ends& ends(const Instance& i, std::string_view event) {
    static const Ends none;
    const FieldDef* f = prototypes_.field(i.body, event);
    if (!f) f = prototypes_.exposed_field(i.body, event);
    auto found = i.events.find(f);
    return found == i.events.end() ? none : found->second;
  }

  /// An exposedField sends on what it receives, unless something in the body receives it and answers.
  void pass_on(const Instance& i, std::vector<Route>& routes) {
    std::unordered_map<const FieldDef*, std::vector<Route>> received;
    for (const Route& r : routes)
      if (r.to == i.node && r.from != i.node && ends(i, r.event_in).in.empty())
        if (auto* f = prototypes_.exposed_field(i.body, r.event_in)) received[f].push_back(r);
    if (received.empty()) return;
    for (std::size_t k = 0, n = routes.size(); k < n; ++k) {
      const Route sent = routes[k];
      auto found = received.find(prototypes_.exposed_field(i.body, sent.event_out));
      if (sent.from != i.node || sent.to == i.node || found == received.end()) continue;
      for (const Route& r : found->second) {
        if (!spend(1, i.where)) return;
        routes.push_back({r.from, sent.to, r.event_out, sent.event_in});
      }
    }
  }

  bool add_route(const Route& r, Span where) {
    if (!spend(1, where)) return false;
    routes_.add(r);
    return true;
  }

  // ---- limits and the end ------------------------------------------------------------------------------------------
  /// False, which is reported once, when the limit has been reached.
  bool spend(std::size_t cost, Span where) {
    if (budget_.spent + cost > budget_.most) {
      if (!std::exchange(budget_.full, true))
        ctx_.diag.report(Diag::expansion_limit, where, budget_.most, "nodes and ROUTEs of prototypes");
      return false;
    }
    budget_.spent += cost;
    return true;
  }

  void finish() {
    scene_.main.routes = std::move(routes_).all();
    values_.finish();
    if (!hidden_.empty()) {
      NodeId choice = scene_.add(nodes::Switch);
      scene_.set(choice, nodes::switch_::children, hidden_);
      scene_.main.roots.push_back(choice);
    }
    limit_nesting(scene_, ctx_.diag);
    if (!options_.keep_declarations)
      std::erase_if(scene_.main.protos, [&](ProtoId p) { return !prototypes_.is_missing(p); });
    declare_missing();
  }

  /// Instances that stay may come from bodies and files whose declarations they leave behind.
  void declare_missing() {
    if (!any_node(scene_, [&](NodeId n) { return is_instance(scene_, n); })) return forget_bodies();
    auto& protos = scene_.main.protos;
    std::vector<char> declared(scene_.proto_count());
    for (ProtoId p : protos) declared[p.value] = 1;
    for (NodeId n : reachable(scene_, scene_.main))
      if (is_instance(scene_, n) && !std::exchange(declared[scene_.type(n).proto.value], 1))
        protos.push_back(scene_.type(n).proto);
  }

  /// Passes that look at all nodes would find what nothing shows any more.
  void forget_bodies() {
    if (!scene_.main.protos.empty()) return;
    for (std::uint32_t i = 0; i < scene_.proto_count(); ++i) scene_.proto(ProtoId{i}).body = {};
  }

  Scene& scene_;
  const ExpandProtosOptions& options_;
  PassContext& ctx_;
  Prototypes prototypes_;
  InstanceValues values_;
  ExpansionBudget& budget_;
  RouteTable routes_;
  std::unordered_map<std::string, Known> known_;  // by Key
  std::vector<char> seen_;
  std::vector<NodeId> hidden_;
  bool expanded_ = false;
};

}  // namespace

ExpansionBudget expansion_budget(const Scene& scene, const ExpandProtosOptions& options) {
  return {.most = static_cast<std::size_t>(options.limit) + 16 * scene.node_count()};
}

Outcome expand_within(Scene& scene, const ExpandProtosOptions& options, PassContext& ctx, ExpansionBudget& budget) {
  return Expansion(scene, options, ctx, budget).run();
}

Outcome expand_protos(Scene& scene, const ExpandProtosOptions& options, PassContext& ctx) {
  auto budget = expansion_budget(scene, options);
  return expand_within(scene, options, ctx, budget);
}

}  // namespace wrlkit
