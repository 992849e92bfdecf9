// What the writers of VRML and X3D have in common: the order of what is printed, and names that a USE finds again.
#pragma once
#include <algorithm>
#include <string>
#include <unordered_map>
#include <unordered_set>
#include <utility>
#include <vector>

#include "base/diagnostics.h"
#include "base/text/xml_characters.h"
#include "scenegraph/legal_name.h"
#include "scenegraph/scene.h"
#include "scenegraph/walk.h"

namespace wrlkit {

/// Calls proto(ProtoId) and node(NodeId) in the order in which a scope is printed: prototypes first, but those whose
/// name means something else as well, where they stood: one that is declared again, of the standard, or of nodes that
/// nobody knew.
template <class P, class N>
void for_each_statement(const Scene& scene, Dialect dialect, const std::unordered_set<std::string_view>& unknown,
                        const Scope& s, P&& proto, N&& node) {
  std::unordered_set<std::string_view> declared;
  std::vector<ProtoId> later;
  for (ProtoId p : s.protos) {
    auto name = scene.type(scene.proto(p).type).name;
    if (declared.insert(name).second && later.empty() && !unknown.contains(name) && !find_builtin(name, dialect))
      proto(p);
    else
      later.push_back(p);
  }
  auto next = later.begin();
  for (std::size_t i = 0; i < s.roots.size(); ++i) {
    for (; next != later.end() && scene.proto(*next).roots_before <= i; ++next) proto(*next);
    node(s.roots[i]);
  }
  for (; next != later.end(); ++next) proto(*next);
}

/// Output names of a scope and of the bodies of its prototypes, which are scopes of their own: what is in one and
/// outside is printed in both. A name may be defined several times: USE means the last one before it (4.4.3). Nodes are
/// met in the order in which they will be printed, and one that a USE or a ROUTE would miss gets a name of its own. So
/// does one whose name no reader would take for a name, as programs may give it, or XML cannot hold; that is reported.
class Names {
 public:
  Names(const Scene& scene, Dialect dialect, bool own_fields, Diagnostics& diag)
      : scene_(scene), dialect_(dialect), own_fields_(own_fields), diag_(diag), met_(scene.node_count(), 0) {
    const auto is_unknown = [](const auto& t) { return t.kind == NodeKind::unknown; };
    if (std::ranges::none_of(scene.own_types(), is_unknown)) return;
    for (const NodeId n : all_nodes(scene))  // of others nothing is printed
      if (is_unknown(scene.type(n))) unknown_.insert(scene.type(n).name);
  }

  /// Types of nodes that nobody knew.
  const std::unordered_set<std::string_view>& unknown() const { return unknown_; }

  void scope(const Scope& s) {
    ++scope_;
    last_.clear();
    auto defaults = [&](ProtoId p) {
      for (auto& f : scene_.type(scene_.proto(p).type).fields) meet(f.default_value.node_span());
    };
    for_each_statement(scene_, dialect_, unknown_, s, defaults, [&](NodeId n) { meet({&n, 1}); });
    for (auto& i : s.imports) {
      referred(i.inline_node);
      if (auto name = scene_.name(i.node); !last_.try_emplace(name, i.node).second) given_[i.node.value] = fresh(name);
    }
    for (auto& r : s.routes) {
      referred(r.from);
      referred(r.to);
    }
    for (auto& e : s.exports) referred(e.node);
    for_each_statement(
        scene_, dialect_, unknown_, s, [&](ProtoId p) { scope(scene_.proto(p).body); }, [](NodeId) {});
  }
  std::string_view operator[](NodeId n) const {
    auto i = given_.find(n.value);
    return i == given_.end() ? scene_.name(n) : std::string_view(i->second);
  }

  /// Written fields in the order of the table, unknown ones behind; in X3D metadata before all. Without `own_fields`
  /// those that no standard has are left out.
  std::vector<const Value*> printed_order(NodeId n) const {
    const auto& t = scene_.type(n);
    auto hidden = [&](const Value& f) { return !own_fields_ && !scene_.is_extra(f) && t.fields[f.slot].is_own(); };
    std::vector<const Value*> v;
    for (auto& f : scene_.fields(n))
      if (!hidden(f)) v.push_back(&f);
    auto by_slot = [](const Value* a, const Value* b) { return a->slot < b->slot; };
    if (!std::ranges::is_sorted(v, by_slot)) std::ranges::stable_sort(v, by_slot);
    if (dialect_ == Dialect::x3d && !v.empty())
      std::stable_partition(v.begin(), v.end(), [&](const Value* f) {
        return !scene_.is_extra(*f) && t.fields[f->slot].name == "metadata";
      });
    return v;
  }

 private:
  void meet(std::span<const NodeId> roots) {
    std::vector<NodeId> stack(roots.rbegin(), roots.rend());
    while (!stack.empty()) {
      NodeId n = stack.back();
      stack.pop_back();
      if (!n) continue;
      if (std::exchange(met_[n.value], scope_) == scope_) {
        referred(n);
        continue;
      }
      if (auto name = scene_.name(n); !name.empty()) {
        last_[name] = n;
        if (!is_one_word(name)) repair(n, name, legal_name(name));
        if (dialect_ == Dialect::x3d && !is_xml_text(name)) repair(n, name, std::string(XmlCharacters().only(name)));
      }
      auto mark = stack.size();
      for_each_printed_child(n, [&](NodeId c) { stack.push_back(c); });
      std::reverse(stack.begin() + static_cast<std::ptrdiff_t>(mark), stack.end());
    }
  }

  template <class F>
  void for_each_printed_child(NodeId n, F&& f) {
    for (const Value* v : printed_order(n))
      for (NodeId c : scene_.content(*v).node_span()) f(c);
  }

  void referred(NodeId n) {
    auto name = scene_.name(n);
    if (given_.count(n.value)) return;
    if (!name.empty() && last_[name] == n) return;
    given_[n.value] = fresh(name);
  }

  void repair(NodeId n, std::string_view name, const std::string& legal) {
    if (given_.count(n.value)) return;
    const auto& written = given_[n.value] = taken().insert(legal).second ? legal : fresh(legal);
    diag_.report(Diag::name_changed, scene_.where(n), name, written);
  }

  std::unordered_set<std::string>& taken() {
    if (taken_.empty()) {
      taken_.insert("");
      for (std::uint32_t i = 0; i < scene_.node_count(); ++i) taken_.insert(std::string(scene_.name(NodeId{i})));
    }
    return taken_;
  }

  std::string fresh(std::string_view base) {
    auto& k = counter_[std::string(base)];
    for (;;) {
      std::string s = (base.empty() ? std::string("_") : std::string(base) + "_") + std::to_string(++k);
      if (taken().insert(s).second) return s;
    }
  }

  const Scene& scene_;
  Dialect dialect_;
  bool own_fields_;
  Diagnostics& diag_;
  std::unordered_set<std::string_view> unknown_;
  std::vector<std::uint32_t> met_;  // the last scope that held the node
  std::uint32_t scope_ = 0;
  std::unordered_map<std::string_view, NodeId> last_;
  std::unordered_map<std::uint32_t, std::string> given_;
  std::unordered_set<std::string> taken_;
  std::unordered_map<std::string, std::uint64_t> counter_;
};

}  // namespace wrlkit
