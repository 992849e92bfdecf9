#include "parsers/x3d/units.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <tuple>

#include "scenegraph/equal.h"
#include "scenegraph/nodes.h"
#include "scenegraph/walk.h"

namespace wrlkit::x3d {
namespace {

enum class Measure : std::uint8_t { unknown, none, length, angle, several };

Measure both(Measure a, Measure b) {
  if (a == Measure::unknown || a == b) return b;
  return b == Measure::unknown ? a : Measure::several;
}

Measure of_table(const FieldDef& f) {
  if (f.unit == "length" || f.unit == "speed") return Measure::length;
  return f.unit == "angle" ? Measure::angle : Measure::none;
}

class Applying {
 public:
  Applying(const Units& units, Scene& scene, Diagnostics& diag) : units_(units), scene_(scene), diag_(diag) {}

  void run() {
    constexpr int enough =
        16;  // prototypes in one another; each round goes through all that are declared before they are used
    for (int i = 0; i < enough && round(); ++i) {
    }
    for (std::uint32_t i = 0; i < scene_.node_count(); ++i) node(NodeId{i});
    for (std::uint32_t i = 0; i < scene_.proto_count(); ++i) defaults(ProtoId{i});
  }

 private:
  using Slot = std::pair<TypeId, std::uint16_t>;

  // ---- what measures what ----

  static std::optional<std::uint16_t> slot_of(const NodeType& t, std::string_view name) {
    return t.find(name, Dialect::x3d, true);
  }

  /// An interpolator's values, in and out, have one unit; so have the events of a field. The others of the node table
  /// are known.
  Measure* open(NodeId n, std::uint16_t slot) {
    const auto& t = scene_.type(n);
    if (t.kind == NodeKind::proto) return &of_proto_[{scene_.type_id(n), slot}];
    const auto name = t.fields[slot].name;
    const bool values = name == "keyValue" || name == "keyVelocity" || name == "value_changed";
    return t.is_a(nodes::X3DInterpolatorNode) && values && t.fields[slot].unit.empty() ? &of_values_[n] : nullptr;
  }

  Measure measure(NodeId n, std::uint16_t slot) {
    if (const Measure* m = open(n, slot)) return *m;
    const auto& t = scene_.type(n);
    return t.kind == NodeKind::builtin ? of_table(t.fields[slot]) : Measure::unknown;
  }

  void learn(Measure* m, Measure from) {
    if (!m || both(*m, from) == *m) return;
    *m = both(*m, from);
    changed_ = true;
  }

  bool round() {
    changed_ = false;
    routes(scene_.main);
    for (std::uint32_t i = 0; i < scene_.proto_count(); ++i) {
      const Proto& p = scene_.proto(ProtoId{i});
      routes(p.body);
      for (NodeId n : reachable(scene_, p.body)) connections(n, p.type);
    }
    return changed_;
  }

  void routes(const Scope& s) {
    for (const Route& r : s.routes) {
      const auto from = slot_of(scene_.type(r.from), r.event_out), to = slot_of(scene_.type(r.to), r.event_in);
      if (from && to) learn(open(r.from, *from), measure(r.to, *to));
    }
  }

  void connections(NodeId n, TypeId proto) {
    if (scene_.type(n).kind != NodeKind::builtin && scene_.type(n).kind != NodeKind::proto) return;
    for (const Value& v : scene_.fields(n)) {
      if (scene_.is_extra(v) || !v.is) continue;
      const auto slot = slot_of(scene_.type(proto), v.text());
      if (!slot) continue;
      learn(&of_proto_[{proto, *slot}], measure(n, v.slot));
      learn(open(n, v.slot), of_proto_[{proto, *slot}]);
    }
  }

  // ---- values ----

  double factor(Measure m) const {
    return m == Measure::length ? units_.length : m == Measure::angle ? units_.angle : 1;
  }

  Value scaled(const Value& v, double factor) {
    const auto& t = info(v.type);
    if (!t.multiple && t.arity == 1) return scene_.make(v.type, v.slot, v.number * factor);
    std::vector<double> numbers(v.number_span().begin(), v.number_span().end());
    const bool rotation = v.type == FieldType::SFRotation || v.type == FieldType::MFRotation;
    for (std::size_t i = rotation ? 3 : 0; i < numbers.size(); i += rotation ? 4 : 1) numbers[i] *= factor;
    return scene_.make(v.type, v.slot, numbers);
  }

  /// The coefficients of a + b r + c r^2, where r is a distance.
  Value attenuation(const Value& v) {
    const auto a = v.number_span();
    return scene_.make(v.type, v.slot, Vec3{a[0], a[1] / units_.length, a[2] / (units_.length * units_.length)});
  }

  /// -1 where the default is -1 means that nothing is given; and what the reader has added, as the default of this
  /// version, is in radians.
  static bool says_nothing(const Value& v, const FieldDef& f) {
    if (f.x3d_from && equal_plain(v, f.x3d_default)) return true;
    return !info(v.type).multiple && !v.number_span().empty() && v.number_span()[0] < 0 &&
           !f.default_value.number_span().empty() && f.default_value.number_span()[0] < 0;
  }

  void node(NodeId n) {
    const auto kind = scene_.type(n).kind;
    if (kind != NodeKind::builtin && kind != NodeKind::proto) return;
    const auto fields = scene_.copy_of_fields(n);
    for (const Value& v : fields) {
      if (scene_.is_extra(v) || v.is || info(v.type).element != Element::number) continue;
      const auto& f = scene_.type(n).fields[v.slot];
      const Measure m = measure(n, v.slot);
      if (m == Measure::several)
        diag_.report(Diag::unit_dropped, scene_.where(n), scene_.type(n).name,
                     std::string(f.name) + ", which leads to several units,");
      if (kind == NodeKind::builtin && f.name == "attenuation" && f.type == FieldType::SFVec3f)
        scene_.set(n, attenuation(v));
      else if (factor(m) != 1 && !(kind == NodeKind::builtin && says_nothing(v, f)))
        scene_.set(n, scaled(v, factor(m)));
    }
  }

  void defaults(ProtoId p) {
    const TypeId type = scene_.proto(p).type;
    for (std::uint16_t i = 0; i < scene_.type(type).fields.size(); ++i) {
      const auto& f = scene_.type(type).fields[i];
      const auto m = of_proto_.find({type, i});
      if (m == of_proto_.end() || factor(m->second) == 1 || !f.has_value() || info(f.type).element != Element::number ||
          f.default_value.is)
        continue;
      const_cast<FieldDef&>(f).default_value =
          scaled(f.default_value, factor(m->second));  // rows of a scene's own types are its own
    }
  }

  const Units& units_;
  Scene& scene_;
  Diagnostics& diag_;
  std::map<Slot, Measure> of_proto_;
  std::map<NodeId, Measure> of_values_;
  bool changed_ = false;
};

}  // namespace

bool Units::set(std::string_view category, double factor) {
  if (!(factor > 0) || !std::isfinite(factor)) return false;
  if (category == "length") {
    length = factor;
    return true;
  }
  if (category == "angle") {
    angle = factor;
    return true;
  }
  return false;
}

void apply(const Units& units, Scene& scene, Diagnostics& diag) {
  if (units.length != 1 || units.angle != 1) Applying(units, scene, diag).run();
}

}  // namespace wrlkit::x3d
