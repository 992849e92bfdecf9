// Fields of nodes as Python values, and back, with the types of the node table.
#include <algorithm>
#include <cmath>
#include <limits>
#include <set>
#include <string_view>

#include "base/text/nearest_name.h"
#include "python/pictures.h"
#include "python/world.h"
#include "scenegraph/equal.h"
#include "scenegraph/verify.h"

namespace wrlkit::python {
namespace {

std::string full_name(const PyNode& node, std::string_view field) {
  return std::string(node.type().name) + "." + std::string(field);
}

template <class T>
py::list list_of(std::span<const T> all, const auto& as_python) {
  py::list out;
  for (const auto& item : all) out.append(as_python(item));
  return out;
}

py::object to_python(const PyNode& node, const FieldDef& field, const Value& v) {
  const auto& t = info(v.type);
  auto tuple = [](auto span) {
    py::tuple out(span.size());
    for (std::size_t i = 0; i < span.size(); ++i) out[i] = span[i];
    return out;
  };
  const auto array = [&](auto span, std::size_t width) { return view(py::cast(node.world), span, width); };
  const auto fixed = [&](const py::list& list) { return fixed_list(list, full_name(node, field.name)); };
  switch (t.element) {
    case Element::number:
      if (t.multiple) return array(v.number_span(), t.arity);
      return t.arity == 1 ? py::object(py::float_(v.number)) : py::object(tuple(v.number_span()));
    case Element::integer:
      if (v.type == FieldType::MFBool) return truths(v.integer_span());
      if (t.multiple) return array(v.integer_span(), 1);
      return v.type == FieldType::SFBool ? py::object(py::bool_(v.integer != 0)) : py::object(py::int_(v.integer));
    case Element::image:
      return t.multiple ? py::object(fixed(pictures(v.integer_span()))) : picture(v.integer_span());
    case Element::text:
      if (t.multiple) return fixed(list_of(v.text_span(), text_value));
      return text_value(v.text());
    case Element::node:
      if (!t.multiple) return v.node ? py::cast(PyNode{node.world, v.node}) : py::none();
      return fixed(list_of(v.node_span(), [&](NodeId n) { return py::cast(PyNode{node.world, n}); }));
  }
  return py::none();
}

NodeId node_of(const PyNode& holder, const py::handle& value) {
  if (value.is_none()) return {};
  const auto& node = value.cast<const PyNode&>();
  if (node.world != holder.world) throw value_error("the node is of another world");
  return node.id;
}

/// What Python gives for a field of that type, in words.
std::string expected(const FieldTypeInfo& t, FieldType type) {
  switch (t.element) {
    case Element::number:
      if (t.arity == 1) return t.multiple ? "a list of numbers" : "a number";
      return t.multiple ? "a list of " + std::to_string(t.arity) + " numbers each"
                        : std::to_string(t.arity) + " numbers";
    case Element::integer:
      if (type == FieldType::SFBool) return "True or False";
      if (type == FieldType::MFBool) return "a list of True and False";
      return t.multiple ? "a list of ints" : "an int";
    case Element::image:
      return (t.multiple ? "a list of arrays" : "an array") + std::string(" of bytes (height, width, components)");
    case Element::text:
      return t.multiple ? "a list of texts" : "a str";
    case Element::node:
      return t.multiple ? "a list of Nodes" : "a Node or None";
  }
  return {};
}

bool is_numeric(const py::array& array) {
  return std::string_view("biuf").find(array.dtype().kind()) != std::string_view::npos;
}

/// Other texts than those of numbers would be read as such. An object may be a fraction.
bool may_hold_numbers(const py::array& array) {
  return array.size() == 0 || is_numeric(array) || array.dtype().kind() == 'O';
}

/// Integers of a flat list; nothing when one gets lost as such.
std::optional<std::vector<std::int32_t>> whole_numbers(const py::object& value) {
  const auto array = py::array::ensure(value);
  if (!array || array.ndim() > 1 || (array.size() > 0 && !is_numeric(array))) return std::nullopt;
  const auto numbers = py::array_t<double, py::array::c_style | py::array::forcecast>::ensure(array);
  const std::span<const double> given(numbers.data(), static_cast<std::size_t>(numbers.size()));
  const bool are_whole = std::ranges::all_of(given, [](double v) {
    return std::trunc(v) == v && v >= std::numeric_limits<std::int32_t>::min() &&
           v <= std::numeric_limits<std::int32_t>::max();
  });
  if (!are_whole) return std::nullopt;
  std::vector<std::int32_t> out(given.size());
  std::ranges::transform(given, out.begin(), [](double v) { return static_cast<std::int32_t>(v); });
  return out;
}

/// Whether an array holds tuples of so many numbers: one after the other, or each in a row of its own.
bool fits(const py::array& array, std::size_t arity) {
  if (array.ndim() < 2) return static_cast<std::size_t>(array.size()) % arity == 0;
  return array.ndim() == 2 && static_cast<std::size_t>(array.shape(1)) == arity;
}

/// True or False, also as NumPy has them, 1 and 0; nothing for what has a truth only in passing.
std::optional<bool> truth(const py::object& value) {
  const auto numbers = whole_numbers(value);
  if (!numbers || numbers->size() != 1 || py::isinstance<py::sequence>(value)) return std::nullopt;
  const auto number = numbers->front();
  return number == 0 || number == 1 ? std::optional(number == 1) : std::nullopt;
}

/// 1.0000000000000004, as arithmetic gives it, is 1 where no more is allowed.
double without_rounding(const FieldRange& range, double v) {
  constexpr double little = 1e-9;
  if (v > range.high && v <= range.high + little && !range.high_open) return range.high;
  if (v < range.low && v >= range.low - little && !range.low_open) return range.low;
  return v;
}

/// What the field does not hold yet.
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

/// What a file would be warned of is an error of the program that sets it, but for texts of other encodings: those of
/// files have them, too.
void require_valid(const PyNode& node, const FieldDef& field, const Value& value) {
  if (!std::ranges::all_of(value.number_span(), [](double v) { return std::isfinite(v); }))
    throw value_error(full_name(node, field.name) + ": not a finite number");
  Diagnostics faults;
  check_value(node.scene(), node.id, value, faults);
  for (const auto& fault : faults.messages())
    if (fault.id != Diag::encoding_repaired) throw value_error(fault.text());
}

/// A value of a field, made of one of Python; TypeError for what does not fit.
class FromPython {
 public:
  FromPython(const PyNode& node, const FieldDef& field, std::uint16_t slot, const py::object& value)
      : node_(node), field_(field), slot_(slot), value_(value), type_(info(field.type)), scene_(node.scene()) {}

  Value made() const {
    try {
      switch (type_.element) {
        case Element::number:
          return number();
        case Element::integer:
          return integer();
        case Element::image:
          return image();
        case Element::text:
          return text();
        case Element::node:
          return nodes();
      }
    } catch (const py::cast_error&) {
      throw wrong();
    }
    throw wrong();
  }

 private:
  Raised wrong() const {
    const bool is_spelt = type_.name[0] == 'S' || type_.name[0] == 'M';
    return type_error(full_name(node_, field_.name) + (is_spelt ? " is an " : " is a ") + std::string(type_.name) +
                      ": " + expected(type_, field_.type) + ", not " + shown_value(value_));
  }

  Value number() const {
    if (type_.arity == 1 && !type_.multiple)
      return scene_.make(field_.type, slot_, without_rounding(field_.range, value_.cast<double>()));
    const auto given_array = py::array::ensure(value_);
    if (!given_array || !may_hold_numbers(given_array)) throw wrong();
    const auto array = py::array_t<double, py::array::c_style | py::array::forcecast>::ensure(given_array);
    if (!array || !fits(array, type_.arity) || (!type_.multiple && array.size() != type_.arity)) throw wrong();
    const std::span<const double> given(array.data(), static_cast<std::size_t>(array.size()));
    if (!field_.range.bounded()) return scene_.make(field_.type, slot_, given);
    std::vector<double> rounded(given.size());
    std::ranges::transform(given, rounded.begin(), [&](double v) { return without_rounding(field_.range, v); });
    return scene_.make(field_.type, slot_, rounded);
  }

  Value integer() const {
    if (field_.type == FieldType::SFInt32) return scene_.make(field_.type, slot_, value_.cast<std::int32_t>());
    if (field_.type == FieldType::SFBool) {
      const auto is_true = truth(value_);
      return is_true ? scene_.make(field_.type, slot_, *is_true) : throw wrong();
    }
    const auto numbers = whole_numbers(value_);
    const auto is_truth = [](std::int32_t v) { return v == 0 || v == 1; };
    if (!numbers || (field_.type == FieldType::MFBool && !std::ranges::all_of(*numbers, is_truth))) throw wrong();
    return scene_.make(field_.type, slot_, *numbers);
  }

  Value image() const {
    const auto numbers = type_.multiple ? integers_of_pictures(value_) : integers_of_picture(value_);
    return numbers ? scene_.make(field_.type, slot_, *numbers) : throw wrong();
  }

  Value text() const {
    if (!type_.multiple) return scene_.make(field_.type, slot_, bytes_of(value_));
    std::vector<std::string> texts;
    if (py::isinstance<py::str>(value_))
      texts.push_back(bytes_of(value_));
    else if (py::isinstance<py::iterable>(value_))
      for (auto item : value_) texts.push_back(bytes_of(item));
    else
      throw wrong();
    const std::vector<std::string_view> kept(texts.begin(), texts.end());
    return scene_.make(field_.type, slot_, kept);
  }

  Value nodes() const {
    if (!type_.multiple) return scene_.make(field_.type, slot_, node_of(node_, value_));
    if (py::isinstance<PyNode>(value_)) return scene_.make(field_.type, slot_, std::vector{node_of(node_, value_)});
    if (!py::isinstance<py::iterable>(value_) || py::isinstance<py::str>(value_)) throw wrong();
    std::vector<NodeId> ids;
    for (auto item : value_) ids.push_back(item.is_none() ? throw wrong() : node_of(node_, item));
    return scene_.make(field_.type, slot_, ids);
  }

  const PyNode& node_;
  const FieldDef& field_;
  std::uint16_t slot_;
  const py::object& value_;
  const FieldTypeInfo& type_;
  Scene& scene_;
};

std::uint16_t slot_of(const PyNode& node, const std::string& name) {
  auto slot = node.type().find(name, Dialect::vrml97);
  if (!slot) slot = node.type().find(name, Dialect::x3d);
  if (slot && node.type().fields[*slot].has_value()) return *slot;
  NearestName nearest(name);
  for (const auto& f : node.type().fields) nearest.consider(f.name);
  throw attribute_error(std::string(node.type().name) + " has no field '" + name + "'" + nearest.question());
}

}  // namespace

std::string shown_value(const py::object& value) {
  if (value.is_none()) return "None";
  if (py::isinstance<py::array>(value))
    return "an array of shape " + shown_bytes(py::str(value.attr("shape"))) + " of " +
           shown_bytes(py::str(value.attr("dtype")));
  constexpr std::size_t longest = 60;
  const std::string kind = shown_bytes(py::str(value.get_type().attr("__name__"))), text = shown_bytes(py::repr(value));
  return text.size() > longest || text.find(kind) != text.npos ? "a " + kind : kind + ' ' + text;
}

FixedNodes fixed_list(const py::object& values, const std::string& owner) {
  return py::reinterpret_borrow<FixedNodes>(
      py::module_::import("wrlkit.lists").attr("FixedList")(values, shown_text(owner)));
}

py::object get_field(const PyNode& node, const Text& name) {
  const auto slot = slot_of(node, name.bytes);
  return to_python(node, node.type().fields[slot], node.scene().value(node.id, slot));
}

void set_field(const PyNode& node, const Text& name, const py::object& value) {
  const auto slot = slot_of(node, name.bytes);
  const auto& field = node.type().fields[slot];
  const Value made = FromPython(node, field, slot, value).made();
  // What it holds may be wrong already: files are.
  if (info(field.type).element != Element::node && equal_plain(node.scene().value(node.id, slot), made)) return;
  require_valid(node, field, new_part(node, made));
  node.scene().set(node.id, made);
}

}  // namespace wrlkit::python
