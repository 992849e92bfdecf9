#include "scenegraph/equal.h"

#include <algorithm>
#include <cmath>
#include <unordered_map>

namespace wrlkit {
namespace {

// Goes through both scenes side by side. `partner_` is the bijection between nodes met so far, so that sharing is
// compared too. Pairs wait on a stack instead of being compared by recursion: depth does not matter.
class Comparison {
 public:
  Comparison(const Scene& a, const Scene& b) : a_(a), b_(b) {}

  std::string run() {
    if (a_.comment != b_.comment) return "comments differ";
    return scope(a_.main, b_.main);
  }

 private:
  struct Pair {
    NodeId a, b;
  };

  bool same(NodeId a, NodeId b) {
    if (!a || !b) return !a && !b;
    auto [i, fresh] = partner_.emplace(a.value, b.value);
    auto [j, fresh_back] = partner_back_.emplace(b.value, a.value);
    if (fresh && fresh_back) todo_.push_back({a, b});
    return i->second == b.value && j->second == a.value;
  }

  bool same(const Value& a, const Value& b) {
    if (a.is != b.is || a.type != b.type) return false;
    if (a.is || info(a.type).element != Element::node) return equal_plain(a, b);
    auto x = a.node_span(), y = b.node_span();
    return x.size() == y.size() &&
           std::equal(x.begin(), x.end(), y.begin(), [&](NodeId m, NodeId n) { return same(m, n); });
  }

  std::string at(NodeId n, const std::string& what) const {
    return std::string(a_.type(n).name) + (a_.name(n).empty() ? "" : " '" + std::string(a_.name(n)) + "'") + ": " +
           what;
  }

  std::string node(NodeId a, NodeId b) {
    const auto &ta = a_.type(a), &tb = b_.type(b);
    if (ta.name != tb.name || ta.kind != tb.kind) return at(a, "type " + std::string(tb.name));
    if (a_.name(a) != b_.name(b)) return at(a, "name '" + std::string(b_.name(b)) + "'");
    if (ta.fields.size() != tb.fields.size()) return at(a, "other fields");
    for (std::size_t i = 0; i < ta.fields.size(); ++i) {
      const auto &fa = ta.fields[i], &fb = tb.fields[i];
      if (fa.name != fb.name || fa.type != fb.type || fa.access != fb.access)
        return at(a, "interface of " + std::string(fa.name));
      const auto slot = static_cast<std::uint16_t>(i);  // no type has more fields than that
      auto *va = a_.find(a, slot), *vb = b_.find(b, slot);
      if (!va && !vb) continue;
      if (!fa.has_value() && (!va || !vb)) return at(a, "IS of " + std::string(fa.name));
      if (!same(va ? *va : fa.default_value, vb ? *vb : fb.default_value))
        return at(a, "field " + std::string(fa.name));
    }
    return extras(a, b);
  }

  std::string extras(NodeId a, NodeId b) {
    auto list = [](const Scene& s, NodeId n) {
      std::vector<const ExtraField*> v;
      for (auto& f : s.fields(n))
        if (s.is_extra(f)) v.push_back(f.extra);
      std::ranges::stable_sort(v, {}, &ExtraField::name);
      return v;
    };
    auto x = list(a_, a), y = list(b_, b);
    if (x.size() != y.size()) return at(a, "number of unknown fields");
    for (std::size_t i = 0; i < x.size(); ++i)
      if (x[i]->name != y[i]->name || !same(x[i]->value, y[i]->value))
        return at(a, "unknown field " + std::string(x[i]->name));
    return {};
  }

  std::string proto(ProtoId a, ProtoId b) {
    const auto &pa = a_.proto(a), &pb = b_.proto(b);
    const auto &ta = a_.type(pa.type), &tb = b_.type(pb.type);
    auto where = "PROTO " + std::string(ta.name) + ": ";
    if (ta.name != tb.name || pa.external != pb.external || pa.urls != pb.urls) return where + "declaration";
    if (ta.fields.size() != tb.fields.size()) return where + "interface";
    for (std::size_t i = 0; i < ta.fields.size(); ++i) {
      const auto &fa = ta.fields[i], &fb = tb.fields[i];
      if (fa.name != fb.name || fa.type != fb.type || fa.access != fb.access ||
          !same(fa.default_value, fb.default_value))
        return where + "field " + std::string(fa.name);
    }
    return scope(pa.body, pb.body);
  }

  std::string scope(const Scope& a, const Scope& b) {
    if (a.protos.size() != b.protos.size()) return "number of prototypes";
    for (std::size_t i = 0; i < a.protos.size(); ++i)
      if (auto d = proto(a.protos[i], b.protos[i]); !d.empty()) return d;
    if (a.roots.size() != b.roots.size())
      return "number of root nodes: " + std::to_string(a.roots.size()) + " and " + std::to_string(b.roots.size());
    for (std::size_t i = 0; i < a.roots.size(); ++i)
      if (!same(a.roots[i], b.roots[i])) return "root node " + std::to_string(i);
    if (auto d = rest_of_nodes(); !d.empty()) return d;
    if (auto d = links(a, b); !d.empty()) return d;
    const auto x = met(a.routes, partner_), y = met(b.routes, partner_back_);
    if (x.size() != y.size()) return "number of ROUTEs";
    for (std::size_t i = 0; i < x.size(); ++i) {
      const auto &r = x[i], &s = y[i];
      if (!same(r.from, s.from) || !same(r.to, s.to) || r.event_out != s.event_out || r.event_in != s.event_in)
        return "ROUTE " + std::to_string(i);
    }
    return {};
  }

  std::string rest_of_nodes() {
    while (!todo_.empty()) {
      auto [x, y] = todo_.back();
      todo_.pop_back();
      if (auto d = node(x, y); !d.empty()) return d;
    }
    return {};
  }

  /// IMPORTs and EXPORTs.
  std::string links(const Scope& a, const Scope& b) {
    auto met = [](const auto& all, auto member, const auto& nodes) {
      auto out = all;
      std::erase_if(out, [&](const auto& l) { return !nodes.count((l.*member).value); });
      return out;
    };
    const auto imports = met(a.imports, &Import::inline_node, partner_),
               imports_b = met(b.imports, &Import::inline_node, partner_back_);
    auto same_import = [&](const Import& x, const Import& y) {
      return same(x.inline_node, y.inline_node) && x.exported == y.exported && same(x.node, y.node);
    };
    if (!std::ranges::equal(imports, imports_b, same_import)) return "IMPORTs";
    if (auto d = rest_of_nodes(); !d.empty()) return d;
    const auto exports = met(a.exports, &Export::node, partner_),
               exports_b = met(b.exports, &Export::node, partner_back_);
    auto same_export = [&](const Export& x, const Export& y) { return same(x.node, y.node) && x.name == y.name; };
    return std::ranges::equal(exports, exports_b, same_export) ? "" : "EXPORTs";
  }

  /// Those of them whose nodes are in the scene: a fault in the file may have cost the others.
  static std::vector<Route> met(const std::vector<Route>& routes,
                                const std::unordered_map<std::uint32_t, std::uint32_t>& nodes) {
    std::vector<Route> out;
    std::ranges::copy_if(routes, std::back_inserter(out),
                         [&](const Route& r) { return nodes.count(r.from.value) && nodes.count(r.to.value); });
    return out;
  }

  const Scene &a_, &b_;
  std::unordered_map<std::uint32_t, std::uint32_t> partner_, partner_back_;
  std::vector<Pair> todo_;
};

}  // namespace

bool equal_plain(const Value& a, const Value& b) {
  if (a.type != b.type || a.is != b.is || a.count != b.count) return false;
  const auto& t = info(a.type);
  if (a.is || (t.element == Element::text && !t.multiple)) return a.text() == b.text();
  switch (t.element) {
    case Element::text:
      return std::ranges::equal(a.text_span(), b.text_span());
    case Element::number:
      return std::ranges::equal(a.number_span(), b.number_span());
    case Element::integer:
    case Element::image:
      return std::ranges::equal(a.integer_span(), b.integer_span());
    case Element::node:
      return std::ranges::equal(a.node_span(), b.node_span());
  }
  return false;
}

bool equals_default(const Value& v, const FieldDef& f) {
  if (info(f.type).element == Element::node) return v.node_span().empty();
  return equal_plain(v, f.default_value);
}

std::string difference(const Scene& a, const Scene& b) { return Comparison(a, b).run(); }

}  // namespace wrlkit
