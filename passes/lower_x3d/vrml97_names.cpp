#include "passes/lower_x3d/vrml97_names.h"

#include <functional>
#include <map>
#include <optional>
#include <set>
#include <string>
#include <unordered_map>
#include <vector>

#include "scenegraph/declared_protos.h"
#include "scenegraph/legal_name.h"
#include "scenegraph/scopes.h"
#include "scenegraph/urls.h"
#include "scenegraph/walk.h"

namespace wrlkit::x3d {
namespace {

/// The names of one kind of thing. What was called alike is called alike, and no two become one.
class Renaming {
 public:
  explicit Renaming(Diagnostics& diag) : diag_(diag) {}

  void take(std::string_view name) { taken_.emplace(name); }

  /// Valid as long as this.
  std::string_view legal(std::string_view name, Span where) {
    if (name.empty() || is_legal_name(name)) return name;
    const auto [at, is_new] = renamed_.try_emplace(std::string(name), legal_name(name));
    if (!is_new) return at->second;
    for (int k = 2; !taken_.insert(at->second).second; ++k) at->second = legal_name(name) + "_" + std::to_string(k);
    diag_.report(Diag::name_changed, where, name, at->second);
    return at->second;
  }

  /// What a name has become; nothing: it is what it was.
  std::optional<std::string_view> now(std::string_view name) const {
    const auto at = renamed_.find(name);
    return at == renamed_.end() ? std::nullopt : std::optional<std::string_view>(at->second);
  }

  bool any() const { return !renamed_.empty(); }

 private:
  Diagnostics& diag_;
  std::set<std::string, std::less<>> taken_;
  std::map<std::string, std::string, std::less<>> renamed_;
};

class LegalNames {
 public:
  LegalNames(Scene& scene, Diagnostics& diag)
      : scene_(scene), all_(all_nodes(scene)), urls_(scene), nodes_(diag), types_(diag), fields_(diag) {}

  bool give() {
    if (!has_others()) return false;
    collect();
    if (!is_gltf_)
      for (const NodeId n : all_) name(n);
    for (const ProtoId p : declared_protos(scene_)) declaration(scene_.proto(p), p);
    for_each_scope(scene_, [&](Scope& s) {
      for (Route& r : s.routes) {
        r.event_out = event(r.from, r.event_out);
        r.event_in = event(r.to, r.event_in);
      }
    });
    for (const NodeId n : all_) node(n);
    return nodes_.any() || types_.any() || fields_.any();
  }

 private:
  /// Most scenes have none.
  bool has_others() const {
    bool any = false;
    const auto look_at = [&](std::string_view name) { any |= !name.empty() && !is_legal_name(name); };
    for (const NodeType& t : scene_.own_types()) {
      if (t.kind != NodeKind::script) look_at(t.name);
      for (const FieldDef& f : t.fields) look_at(f.name);
    }
    for_each_route(scene_, [&](const Route& r) {
      look_at(r.event_out);
      look_at(r.event_in);
    });
    for (const NodeId n : all_) {
      if (is_gltf_) break;
      look_at(scene_.name(n));
      for (const Value& v : scene_.fields(n))
        if (scene_.is_extra(v)) look_at(v.extra->name);
    }
    return any;
  }

  void collect() {
    for (const NodeId n : all_) nodes_.take(scene_.name(n));
    for (const NodeType& row : builtin_nodes())
      if (row.dialects & static_cast<DialectSet>(Dialect::vrml97)) types_.take(row.name);
    for (const NodeType& t : scene_.own_types()) {
      types_.take(t.name);
      for (const FieldDef& f : t.fields) fields_.take(f.name);
    }
  }

  void name(NodeId n) {
    const auto old = scene_.name(n);
    if (const auto now = nodes_.legal(old, scene_.where(n)); now != old) scene_.set_name(n, now);
  }

  std::string_view field_name(std::string_view name, Span where) { return kept(name, fields_.legal(name, where)); }

  std::string_view kept(std::string_view old, std::string_view now) { return now == old ? old : scene_.keep(now); }

  /// An event, as it may also be called of an exposedField.
  std::string_view event(NodeId n, std::string_view name) {
    const auto& t = scene_.type(n);
    if (t.kind == NodeKind::builtin) return name;
    const auto slot = t.find(name, scene_.dialect(), true);
    const auto field = slot ? t.fields[*slot].name : name;
    const auto now = fields_.legal(field, scene_.where(n));
    if (now == field) return name;
    std::string out(name);
    return scene_.keep(out.replace(out.find(field), field.size(), now));
  }

  void declaration(Proto& p, ProtoId id) {
    p.type = type(p.type, p.where);
    scene_.set_type_proto(p.type, id);
    if (const auto now = led(p.urls); !now.empty()) p.urls = now;
  }

  /// A row of a scene cannot be changed, for its nodes rely on it: there is another one instead.
  TypeId type(TypeId id, Span where) {
    if (id.value < builtin_nodes().size()) return id;
    const auto [at, is_new] = now_.try_emplace(id.value, id);
    if (!is_new) return at->second;
    NodeType t = scene_.type(id);
    std::vector<FieldDef> fields(t.fields.begin(), t.fields.end());
    const auto name = t.name;
    if (t.kind != NodeKind::script) t.name = kept(name, types_.legal(name, where));
    bool changed = t.name != name;
    for (std::uint16_t slot = 0; slot < fields.size(); ++slot) {
      auto& f = fields[slot];
      const auto old = f.name;
      f.name = field_name(old, where);
      changed |= f.name != old;
      if (const auto v = led(id, slot, f.default_value)) {
        f.default_value = *v;
        changed = true;
      }
    }
    if (changed) at->second = scene_.add_type(t, fields);
    return at->second;
  }

  void node(NodeId n) {
    const auto old = scene_.type_id(n);
    const auto now = type(old, scene_.where(n));
    auto fields = scene_.copy_of_fields(n);
    bool changed = now != old;
    for (Value& v : fields) changed |= scene_.is_extra(v) ? extra(n, v) : value(n, old, v);
    if (changed) scene_.become(n, now, fields);
  }

  bool value(NodeId n, TypeId type, Value& v) {
    if (v.is) return is(n, v);
    const auto now = led(type, v.slot, v);
    if (now) v = *now;
    return now.has_value();
  }

  bool is(NodeId n, Value& v) {
    const auto old = v.text();
    const auto now = field_name(old, scene_.where(n));
    v.chars = now.data();
    v.count = static_cast<std::uint32_t>(now.size());
    return now != old;
  }

  bool extra(NodeId n, Value& v) {
    Value content = v.extra->value;
    const auto name = is_gltf_ ? v.extra->name : field_name(v.extra->name, scene_.where(n));
    const bool is_changed = content.is && is(n, content);
    if (name == v.extra->name && !is_changed) return false;
    v = scene_.make_extra(name, content);
    return true;
  }

  // ---- urls of Viewpoints of this file ----
  std::optional<Value> led(TypeId type, std::uint16_t slot, const Value& v) {
    if (v.is || v.type != FieldType::MFString || v.count == 0 || urls_.use(type, slot) == UrlUse::none) return {};
    const auto now = led(v.text_span());
    return now.empty() ? std::nullopt : std::optional(scene_.make(FieldType::MFString, slot, now));
  }

  /// Empty: they stay.
  std::vector<std::string_view> led(std::span<const std::string_view> urls) {
    std::vector<std::string_view> out(urls.begin(), urls.end());
    bool any = false;
    for (auto& url : out) {
      if (!url.starts_with('#')) continue;
      const auto now = nodes_.now(url.substr(1));
      if (now) url = scene_.keep("#" + std::string(*now));
      any |= now.has_value();
    }
    return any ? out : std::vector<std::string_view>();
  }

  Scene& scene_;
  const bool is_gltf_ = scene_.format == Format::gltf;  // whose reader has seen to nodes, and fields of no type
  const std::vector<NodeId> all_;
  const UrlFields urls_;
  Renaming nodes_, types_, fields_;
  std::unordered_map<std::uint32_t, TypeId> now_;
};

}  // namespace

bool give_legal_names(Scene& scene, Diagnostics& diag) {
  return scene.format != Format::vrml97 && LegalNames(scene, diag).give();
}

}  // namespace wrlkit::x3d
