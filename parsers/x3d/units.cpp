#include "parsers/x3d/units.h"

#include <algorithm>
#include <cmath>

namespace wrlkit::x3d {
namespace {

Value scaled(Scene& scene, const Value& v, double factor, std::size_t from, std::size_t step) {
  const auto& t = info(v.type);
  if (!t.multiple && t.arity == 1) return scene.make(v.type, v.slot, v.number * factor);
  std::vector<double> numbers(v.number_span().begin(), v.number_span().end());
  for (std::size_t i = from; i < numbers.size(); i += step) numbers[i] *= factor;
  return scene.make(v.type, v.slot, numbers);
}

}  // namespace

bool Units::set(std::string_view category, double factor) {
  if (!(factor > 0) || !std::isfinite(factor)) return false;
  if (category == "length") return length = factor, true;
  if (category == "angle") return angle = factor, true;
  return false;
}

void apply(const Units& units, Scene& scene) {
  if (units.length == 1 && units.angle == 1) return;
  for (std::uint32_t i = 0; i < scene.node_count(); ++i) {
    const NodeId n{i};
    if (scene.type(n).kind != NodeKind::builtin) continue;
    const std::vector<Value> fields(scene.fields(n).begin(), scene.fields(n).end());
    for (const Value& v : fields) {
      if (scene.is_extra(v) || v.is || info(v.type).element != Element::number) continue;
      const auto& f = scene.type(n).fields[v.slot];
      const bool length = f.unit == "length" || f.unit == "speed";
      // -1 -1 -1 says nothing.
      if (!length && f.unit != "angle") continue;
      if (f.name == "bboxSize" && v.numbers[0] < 0) continue;
      const bool rotation = info(v.type).arity == 4;
      scene.set(n, scaled(scene, v, length ? units.length : units.angle, rotation ? 3 : 0, rotation ? 4 : 1));
    }
  }
}

}  // namespace wrlkit::x3d
