// Fields of nodes as Python values, and back, with the types of the node table.
#include <algorithm>
#include <cmath>
#include <limits>
#include <set>
#include <string_view>

#include "base/text/nearest_name.h"
#include "python/world.h"
#include "scenegraph/equal.h"
#include "scenegraph/verify.h"

namespace wrlkit::python {
namespace {

py::object to_python(const PyNode& node, const Value& v) {
  const auto& t = info(v.type);
  auto tuple = [](auto span) {
    py::tuple out(span.size());
    for (std::size_t i = 0; i < span.size(); ++i) out[i] = span[i];
    return out;
  };
  const auto array = [&](auto span, std::size_t width) { return view(py::cast(node.world), span, width); };
  switch (t.element) {
    case Element::number:
      if (t.multiple) return array(v.number_span(), t.arity);
      return t.arity == 1 ? py::object(py::float_(v.number)) : py::object(tuple(v.number_span()));
    case Element::integer:
      if (t.multiple) return array(v.integer_span(), 1);
      return v.type == FieldType::SFBool ? py::object(py::bool_(v.integer != 0)) : py::object(py::int_(v.integer));
    case Element::image:
      return array(v.integer_span(), 1);
    case Element::text:
      if (t.multiple) return py::cast(std::vector<std::string>(v.text_span().begin(), v.text_span().end()));
      return py::str(std::string(v.text()));
    case Element::node:
      if (!t.multiple) return v.node ? py::cast(PyNode{node.world, v.node}) : py::none();
      std::vector<PyNode> nodes;
      for (NodeId n : v.node_span()) nodes.push_back({node.world, n});
      return py::cast(nodes);
  }
  return py::none();
}

NodeId node_of(const PyNode& holder, const py::handle& value) {
  if (value.is_none()) return {};
  const auto& node = value.cast<const PyNode&>();
  if (node.world != holder.world) throw py::value_error("the node is of another world");
  return node.id;
}

/// What Python gives for a field of that type, in words.
std::string expected(const FieldTypeInfo& t, FieldType type) {
  const auto list_of = [&](const std::string& what) { return "a list of " + what; };
  switch (t.element) {
    case Element::number:
      if (t.arity == 1) return t.multiple ? list_of("numbers") : "a number";
      return t.multiple ? list_of(std::to_string(t.arity) + " numbers each") : std::to_string(t.arity) + " numbers";
    case Element::integer:
      if (type == FieldType::SFBool) return "True or False";
      return t.multiple ? list_of("ints") : "an int";
    case Element::image:
      return list_of("ints: width, height, components, pixels");
    case Element::text:
      return t.multiple ? list_of("texts") : "a str";
    case Element::node:
      return t.multiple ? list_of("Nodes") : "a Node or None";
  }
  return {};
}

/// Whether nothing of a list of numbers gets lost as integers.
bool is_whole(const py::object& value) {
  const auto array = py::array::ensure(value);
  if (!array || std::string_view("biuf").find(array.dtype().kind()) == std::string_view::npos) return false;
  const auto numbers = py::array_t<double, py::array::c_style | py::array::forcecast>::ensure(array);
  return std::all_of(numbers.data(), numbers.data() + numbers.size(), [](double v) {
    return std::trunc(v) == v && v >= std::numeric_limits<std::int32_t>::min() &&
           v <= std::numeric_limits<std::int32_t>::max();
  });
}

/// Whether an array holds tuples of so many numbers: one after the other, or each in a row of its own.
bool fits(const py::array& array, std::size_t arity) {
  const auto last = array.ndim() > 0 ? static_cast<std::size_t>(array.shape(array.ndim() - 1)) : 1;
  return array.ndim() < 2 ? static_cast<std::size_t>(array.size()) % arity == 0 : last == arity;
}

/// 1.0000000000000004, as arithmetic gives it, is 1 where no more is allowed.
double without_rounding(const FieldRange& range, double v) {
  constexpr double little = 1e-9;
  if (v > range.high && v <= range.high + little && !range.high_open) return range.high;
  if (v < range.low && v >= range.low - little && !range.low_open) return range.low;
  return v;
}

/// What the field does not hold yet. What it holds may be wrong already: files are.
Value new_part(const PyNode& node, const Value& value) {
  Scene& scene = node.scene();
  const Value& before = scene.value(node.id, value.slot);
  if (info(value.type).element != Element::node) return value;
  const std::set<NodeId> old(before.node_span().begin(), before.node_span().end());
  std::vector<NodeId> added;
  std::ranges::copy_if(value.node_span(), std::back_inserter(added), [&](NodeId n) { return !old.contains(n); });
  return info(value.type).multiple ? scene.make(value.type, value.slot, added)
                                   : scene.make(value.type, value.slot, added.empty() ? NodeId{} : added[0]);
}

/// What a file would be warned of is an error of the program that sets it.
void require_valid(const PyNode& node, const FieldDef& field, const Value& value) {
  if (!std::ranges::all_of(value.number_span(), [](double v) { return std::isfinite(v); }))
    throw py::value_error(std::string(node.type().name) + "." + std::string(field.name) + ": not a finite number");
  Diagnostics faults;
  check_value(node.scene(), node.id, value, faults);
  if (!faults.messages().empty()) throw py::value_error(faults.messages()[0].text());
}

Value from_python(const PyNode& node, const FieldDef& field, std::uint16_t slot, const py::object& value) {
  const auto& t = info(field.type);
  Scene& scene = node.scene();
  const auto wrong = [&] {
    return py::type_error(std::string(node.type().name) + "." + std::string(field.name) +
                          (t.name[0] == 'S' || t.name[0] == 'M' ? " is an " : " is a ") + std::string(t.name) + ": " +
                          expected(t, field.type) + ", not " + shown_value(value));
  };
  try {
    switch (t.element) {
      case Element::number: {
        if (t.arity == 1 && !t.multiple)
          return scene.make(field.type, slot, without_rounding(field.range, value.cast<double>()));
        const auto array = py::array_t<double, py::array::c_style | py::array::forcecast>::ensure(value);
        if (!array || !fits(array, t.arity) || (!t.multiple && array.size() != t.arity)) throw wrong();
        const std::span<const double> given(array.data(), static_cast<std::size_t>(array.size()));
        if (!field.range.bounded()) return scene.make(field.type, slot, given);
        std::vector<double> rounded(given.size());
        std::ranges::transform(given, rounded.begin(), [&](double v) { return without_rounding(field.range, v); });
        return scene.make(field.type, slot, rounded);
      }
      case Element::integer:
      case Element::image: {
        if (field.type == FieldType::SFBool) return scene.make(field.type, slot, value.cast<bool>());
        if (field.type == FieldType::SFInt32) return scene.make(field.type, slot, value.cast<std::int32_t>());
        const auto array = py::array_t<std::int32_t, py::array::c_style | py::array::forcecast>::ensure(value);
        if (!is_whole(value) || !array) throw wrong();
        return scene.make(field.type, slot,
                          std::span<const std::int32_t>(array.data(), static_cast<std::size_t>(array.size())));
      }
      case Element::text: {
        if (!t.multiple) return scene.make(field.type, slot, value.cast<std::string>());
        const auto texts = py::isinstance<py::str>(value) ? std::vector{value.cast<std::string>()}
                                                          : value.cast<std::vector<std::string>>();
        const std::vector<std::string_view> kept(texts.begin(), texts.end());
        return scene.make(field.type, slot, kept);
      }
      case Element::node: {
        if (!t.multiple) return scene.make(field.type, slot, node_of(node, value));
        std::vector<NodeId> ids;
        if (py::isinstance<PyNode>(value)) return scene.make(field.type, slot, std::vector{node_of(node, value)});
        if (!py::isinstance<py::iterable>(value) || py::isinstance<py::str>(value)) throw wrong();
        for (auto item : value) ids.push_back(item.is_none() ? throw wrong() : node_of(node, item));
        return scene.make(field.type, slot, ids);
      }
    }
  } catch (const py::cast_error&) {
    throw wrong();
  }
  throw wrong();
}

std::uint16_t slot_of(const PyNode& node, const std::string& name) {
  auto slot = node.type().find(name, Dialect::vrml97);
  if (!slot) slot = node.type().find(name, Dialect::x3d);
  if (slot && node.type().fields[*slot].has_value()) return *slot;
  NearestName nearest(name);
  for (const auto& f : node.type().fields) nearest.consider(f.name);
  throw py::attribute_error(std::string(node.type().name) + " has no field '" + name + "'" + nearest.question());
}

}  // namespace

std::string shown_value(const py::object& value) {
  if (value.is_none()) return "None";
  constexpr std::size_t longest = 60;
  const std::string kind = py::str(value.get_type().attr("__name__")), text = py::repr(value);
  return text.size() > longest || text.find(kind) != text.npos ? "a " + kind : kind + ' ' + text;
}

py::object get_field(const PyNode& node, const std::string& name) {
  return to_python(node, node.scene().value(node.id, slot_of(node, name)));
}

void set_field(const PyNode& node, const std::string& name, const py::object& value) {
  const auto slot = slot_of(node, name);
  const auto& field = node.type().fields[slot];
  const Value made = from_python(node, field, slot, value);
  if (field.range.bounded() && equal_plain(node.scene().value(node.id, slot), made)) return;
  require_valid(node, field, new_part(node, made));
  node.scene().set(node.id, made);
}

}  // namespace wrlkit::python
