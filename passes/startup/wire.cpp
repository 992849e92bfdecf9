#include "passes/startup/wire.h"

#include <cmath>
#include <limits>

namespace wrlkit {
namespace {

std::optional<std::int32_t> whole(double v) {
  if (!(std::abs(v) <= std::numeric_limits<std::int32_t>::max())) return std::nullopt;
  return static_cast<std::int32_t>(v);
}

std::optional<NodeId> node_of(const Scene& scene, Json v) {
  if (!v.is_number()) return NodeId{};
  const auto id = v.whole();
  if (!id || *id >= scene.node_count()) return std::nullopt;
  return NodeId{static_cast<std::uint32_t>(*id)};
}

std::optional<Value> read_integers(Scene& scene, FieldType type, std::uint16_t slot, Json v) {
  std::vector<std::int32_t> out;
  for (const Json element : v.elements()) {
    const auto number = whole(element.is_boolean() ? element.boolean() : element.number());
    if (!number) return std::nullopt;
    out.push_back(*number);
  }
  if (type == FieldType::SFImage) {  // width, height, components, and a number for each pixel
    if (out.size() < 3 || out[0] < 0 || out[1] < 0 || out[2] < 0 || out[2] > 4) return std::nullopt;
    if (static_cast<double>(out[0]) * out[1] != static_cast<double>(out.size() - 3)) return std::nullopt;
  }
  return scene.make(type, slot, out);
}

std::optional<Value> read_numbers(Scene& scene, FieldType type, std::uint16_t slot, Json v) {
  const auto numbers = v.numbers();
  const auto& about = info(type);
  if (numbers.size() != v.elements().size() || numbers.size() % about.arity != 0) return std::nullopt;
  if (!about.multiple && numbers.size() != about.arity) return std::nullopt;
  return scene.make(type, slot, numbers);
}

std::optional<Value> read_texts(Scene& scene, FieldType type, std::uint16_t slot, Json v) {
  std::vector<std::string_view> out;
  for (const Json element : v.elements()) out.push_back(element.text());
  return scene.make(type, slot, out);
}

std::optional<Value> read_nodes(Scene& scene, FieldType type, std::uint16_t slot, Json v) {
  std::vector<NodeId> out;
  for (const Json element : v.elements()) {
    const auto node = node_of(scene, element);
    if (!node) return std::nullopt;
    if (*node) out.push_back(*node);
  }
  return scene.make(type, slot, out);
}

std::optional<Value> read_list(Scene& scene, FieldType type, std::uint16_t slot, Json v) {
  if (!v.is_array()) return std::nullopt;
  switch (info(type).element) {
    case Element::number:
      return read_numbers(scene, type, slot, v);
    case Element::text:
      return read_texts(scene, type, slot, v);
    case Element::node:
      return read_nodes(scene, type, slot, v);
    default:
      return read_integers(scene, type, slot, v);
  }
}

template <class R>
void write_list(JsonOut& out, const R& list) {
  out.begin_array();
  for (const auto& v : list) out.value(v);
  out.end_array();
}

void write_node(JsonOut& out, NodeId n) { n ? out.value(n.value) : out.raw("null"); }

}  // namespace

bool is_script_type(FieldType type) {
  return type != FieldType::SFBitMask && type != FieldType::SFEnum && type != FieldType::SFMatrix &&
         type != FieldType::verbatim && type != FieldType::MFImage;
}

void write_value(JsonOut& out, const Value& v) {
  const auto& about = info(v.type);
  if (v.is) return out.raw("null");
  if (v.type == FieldType::SFBool) return out.value(v.integer != 0);
  if (v.type == FieldType::SFInt32) return out.value(v.integer);
  if (v.type == FieldType::SFNode) return write_node(out, v.node);
  if (about.element == Element::text && !about.multiple) return out.value(v.text());
  if (about.element == Element::text) return write_list(out, v.text_span());
  if (about.element == Element::number && !about.multiple && about.arity == 1) return out.value(v.number);
  if (about.element == Element::number) return write_list(out, v.number_span());
  if (about.element != Element::node) return write_list(out, v.integer_span());
  out.begin_array();
  for (const NodeId n : v.node_span()) write_node(out, n);
  out.end_array();
}

std::string value_text(const Value& v) {
  std::string text;
  JsonOut out(text);
  write_value(out, v);
  return text;
}

std::optional<Value> read_value(Scene& scene, FieldType type, std::uint16_t slot, Json v) {
  const auto& about = info(type);
  if (!is_script_type(type)) return std::nullopt;
  if (about.multiple || about.arity > 1 || type == FieldType::SFImage) return read_list(scene, type, slot, v);
  switch (about.element) {
    case Element::text:
      return v.is_text() ? std::optional(scene.make(type, slot, v.text())) : std::nullopt;
    case Element::number:
      return v.is_number() ? std::optional(scene.make(type, slot, v.number())) : std::nullopt;
    case Element::node: {
      const auto node = node_of(scene, v);
      return node ? std::optional(scene.make(type, slot, *node)) : std::nullopt;
    }
    default:
      break;
  }
  if (type == FieldType::SFBool) return scene.make(type, slot, v.is_number() ? v.number() != 0 : v.boolean());
  const auto number = v.is_number() ? whole(v.number()) : std::nullopt;
  return number ? std::optional(scene.make(type, slot, *number)) : std::nullopt;
}

}  // namespace wrlkit
