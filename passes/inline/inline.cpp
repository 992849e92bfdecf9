#include "passes/inline/inline.h"

#include <algorithm>
#include <string>
#include <unordered_map>
#include <unordered_set>

#include "passes/analysis/nesting.h"
#include "passes/analysis/own_nodes.h"
#include "scenegraph/nodes.h"
#include "scenegraph/tags.h"
#include "scenegraph/walk.h"

namespace wrlkit {
namespace {

/// The file as it is in the scene for the first Inline that names it.
struct Imported {
  Scope scope;
  bool marked = false;  // what is its own is known
  bool has_state = false;
};

class Inliner {
 public:
  Inliner(Scene& scene, const InlineOptions& options, PassContext& ctx, InlineRuns& runs)
      : scene_(scene), options_(options), ctx_(ctx), runs_(runs) {}

  Outcome run() {
    const auto n_protos = static_cast<std::uint32_t>(scene_.proto_count());
    note_names();
    load_all(scene_.main.roots, scene_.main);
    load_bodies(0, n_protos);
    ++runs_.n_runs;
    if (changed_) limit_nesting(scene_, ctx_.diag);
    return changed_ ? Outcome::changed : Outcome::unchanged;
  }

 private:
  /// `scope` is the one that the nodes are in.
  void load_all(std::span<const NodeId> roots, Scope& scope) {
    std::vector<NodeId> nodes;
    reach(scene_, roots, met_, nodes);
    for (NodeId n : nodes)
      if (scene_.is(n, nodes::Inline)) load(n, scope);
    connect(scope);
  }

  void load_bodies(std::uint32_t begin, std::uint32_t end) {
    for (std::uint32_t i = begin; i < end; ++i) {
      Proto& p = scene_.proto(ProtoId{i});
      for (const auto& f : scene_.type(p.type).fields) load_all(f.default_value.node_span(), p.body);
      load_all(p.body.roots, p.body);
    }
  }

  void load(NodeId n, Scope& scope) {
    auto urls = scene_.get(n, nodes::inline_::url);
    if (urls.empty() || !ctx_.resources || !scene_.get(n, nodes::inline_::load)) return;
    auto world = ctx_.resources->world(urls, scene_.where(n), ctx_.diag).scene;
    if (!world) return;
    if (world.get() == &scene_ || std::ranges::find(chain_, world.get()) != chain_.end())
      return ctx_.diag.report(Diag::url_cycle, scene_.where(n), urls[0]);
    if (chain_.size() + static_cast<std::size_t>(runs_.n_runs) >= static_cast<std::size_t>(options_.depth))
      return ctx_.diag.report(Diag::expansion_limit, scene_.where(n), options_.depth, "Inlines inside each other");
    auto known = imported_.find(world.get());
    if (known == imported_.end()) {
      if (may_import(world, scene_.where(n))) become_group(n, first_use(world), scope);
    } else
      become_group(n, further_use(known->second, scene_.where(n)), scope);
  }

  /// A file that an earlier run brought in comes again as a copy.
  bool may_import(const std::shared_ptr<const Scene>& world, Span where) {
    if (runs_.files.emplace(world.get(), world).second) {
      runs_.n_first += world->node_count();
      return true;
    }
    if (is_full(where)) return false;
    runs_.n_copied += world->node_count();
    return true;
  }

  /// True, which is reported once, when the limit has been reached.
  bool is_full(Span where) {
    if (runs_.n_copied < static_cast<std::size_t>(options_.limit)) return false;
    if (!std::exchange(runs_.full, true))
      ctx_.diag.report(Diag::expansion_limit, where, options_.limit, "copies of nodes and ROUTEs of inlined worlds");
    return true;
  }

  const Scope& first_use(const std::shared_ptr<const Scene>& world) {
    Scope& scope = imported_[world.get()].scope;
    const auto n_nodes = static_cast<std::uint32_t>(scene_.node_count());
    const auto n_protos = static_cast<std::uint32_t>(scene_.proto_count());
    scope = scene_.import(*world);
    const auto end = static_cast<std::uint32_t>(scene_.proto_count());
    rename_protos(scope, n_nodes);
    scene_.main.protos.insert(scene_.main.protos.begin(), scope.protos.begin(), scope.protos.end());
    chain_.push_back(world.get());
    load_all(scope.roots, scope);
    load_bodies(n_protos, end);
    chain_.pop_back();
    return scope;
  }

  /// Prototypes of the file are declared before all others, so that they are known wherever it is inlined, under names
  /// that nothing else has.
  void rename_protos(const Scope& scope, std::uint32_t first_node) {
    std::unordered_map<std::uint32_t, TypeId> renamed;
    for (ProtoId p : scope.protos) {
      const TypeId old = scene_.proto(p).type;
      NodeType type = scene_.type(old);
      if (!find_builtin(type.name, scene_.dialect()) && !is_taken(type.name)) continue;
      type.name = scene_.keep(free_name(type.name));
      renamed[old.value] = scene_.proto(p).type = scene_.add_type(type, {type.fields.begin(), type.fields.end()});
    }
    note_names();
    if (renamed.empty()) return;
    for (NodeId n{first_node}; n.value < scene_.node_count(); ++n.value)
      if (auto r = renamed.find(scene_.type_id(n).value); r != renamed.end()) {
        const auto fields = scene_.copy_of_fields(n);
        scene_.become(n, r->second, fields);
      }
  }

  bool is_taken(std::string_view name) const { return taken_.count(name); }

  std::string free_name(std::string_view base) {
    for (auto& k = counter_[base];;)
      if (auto name = std::string(base) + "_" + std::to_string(++k); !is_taken(name)) return name;
  }

  /// Notes the names of the prototypes that have been added since.
  void note_names() {
    for (; n_noted_ < scene_.proto_count(); ++n_noted_)
      taken_.insert(scene_.type(scene_.proto(ProtoId{n_noted_}).type).name);
  }

  Scope further_use(Imported& file, Span where) {
    if (!std::exchange(file.marked, true)) file.has_state = mark(file.scope);
    if (!file.has_state) return {file.scope.roots, {}, {}};
    if (is_full(where)) return {file.scope.roots, {}, {}};
    return copy(file.scope);
  }

  Scope copy(const Scope& scope) {
    Copies copies(scene_, own_);
    Scope out;
    for (NodeId n : scope.roots) out.roots.push_back(copies.of(n));
    for (const Route& r : scope.routes)
      out.routes.push_back({copies.of(r.from), copies.of(r.to), r.event_out, r.event_in});
    for (const Import& i : scope.imports)
      out.imports.push_back({copies.of(i.inline_node), i.exported, copies.of(i.node)});
    for (const Export& e : scope.exports) out.exports.push_back({copies.of(e.node), e.name});
    for (NodeId from, to; copies.next(from, to);) {
      const auto source = scene_.copy_of_fields(from);
      std::vector<Value> fields;
      fields.reserve(source.size());
      for (const Value& v : source) fields.push_back(copies.of(v));
      scene_.set_fields(to, fields);
      runs_.n_copied += cost_of_copy(scene_, from);
    }
    runs_.n_copied += out.routes.size() + out.exports.size();
    return out;
  }

  bool mark(const Scope& scope) {
    // A body holds instances of prototypes that are declared before its own, and of those that came with an Inline,
    // of which nothing is known yet. What an EXTERNPROTO is is not known here.
    auto has_state = [&](NodeId n) {
      const auto proto = scene_.type(n).proto.value;
      return proto >= proto_has_state_.size() || proto_has_state_[proto] != 0;
    };
    for (auto i = static_cast<std::uint32_t>(proto_has_state_.size()); i < scene_.proto_count(); ++i) {
      const Proto& p = scene_.proto(ProtoId{i});
      proto_has_state_.push_back(0);
      proto_has_state_[i] = p.external || own_.mark(scene_, p.body, {}, has_state);
    }
    return own_.mark(scene_, scope, {}, has_state);
  }

  void become_group(NodeId n, const Scope& use, Scope& scope) {
    std::vector<Value> fields;
    if (!use.roots.empty()) fields.push_back(scene_.make(FieldType::MFNode, nodes::group::children.slot, use.roots));
    for (auto [from, to] : {std::pair{nodes::inline_::bboxCenter.slot, nodes::group::bboxCenter.slot},
                            {nodes::inline_::bboxSize.slot, nodes::group::bboxSize.slot}})
      if (auto* v = scene_.find(n, from); v && !v->is) {
        fields.push_back(*v);
        fields.back().slot = to;
      }
    for (const Value& v : scene_.fields(n)) {
      if (!is_tag(scene_, n, v)) continue;
      fields.push_back(v);
      if (!scene_.is_extra(v)) fields.back().slot = nodes::group::metadata.slot;
    }
    scene_.become(n, nodes::Group, fields);
    scope.routes.insert(scope.routes.end(), use.routes.begin(), use.routes.end());
    scope.imports.insert(scope.imports.end(), use.imports.begin(), use.imports.end());
    for (const Export& e : use.exports) exports_[n.value].emplace(e.name, e.node);
    changed_ = true;
  }

  /// What a scope imports of scenes that are there now.
  void connect(Scope& scope) {
    std::unordered_map<std::uint32_t, NodeId> meant;
    std::erase_if(scope.imports, [&](const Import& i) {
      if (scene_.is(i.inline_node, nodes::Inline)) return false;
      const auto& exports = exports_[i.inline_node.value];
      const auto found = exports.find(i.exported);
      if (found == exports.end())
        ctx_.diag.report(Diag::import_not_found, scene_.where(i.node), scene_.name(i.inline_node), i.exported);
      meant[i.node.value] = found == exports.end() ? NodeId{} : found->second;
      return true;
    });
    if (meant.empty()) return;
    auto lead = [&](NodeId& n) {
      if (auto m = meant.find(n.value); m != meant.end()) n = m->second;
    };
    for (Route& r : scope.routes) {
      lead(r.from);
      lead(r.to);
    }
    for (Export& e : scope.exports) lead(e.node);
    std::erase_if(scope.routes, [](const Route& r) { return !r.from || !r.to; });
    std::erase_if(scope.exports, [](const Export& e) { return !e.node; });
  }

  Scene& scene_;
  const InlineOptions& options_;
  PassContext& ctx_;
  InlineRuns& runs_;
  std::unordered_map<const Scene*, Imported> imported_;
  std::unordered_map<std::uint32_t, std::unordered_map<std::string_view, NodeId>> exports_;  // of the file of an Inline
  std::vector<const Scene*> chain_;             // files that are being loaded, each inlined by the one before
  std::unordered_set<std::string_view> taken_;  // names of prototypes
  std::unordered_map<std::string_view, std::size_t> counter_;
  std::uint32_t n_noted_ = 0;
  std::vector<char> met_, proto_has_state_;
  OwnNodes own_;
  bool changed_ = false;
};

}  // namespace

Outcome inline_within(Scene& scene, const InlineOptions& options, PassContext& ctx, InlineRuns& runs) {
  return Inliner(scene, options, ctx, runs).run();
}

Outcome inline_worlds(Scene& scene, const InlineOptions& options, PassContext& ctx) {
  InlineRuns runs;
  return inline_within(scene, options, ctx, runs);
}

}  // namespace wrlkit
