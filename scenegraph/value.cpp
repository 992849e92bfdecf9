#include "scenegraph/value.h"

namespace wrlkit {

bool find_field_type(std::string_view name, FieldType& out) {
  for (std::size_t i = 0; i < std::size(field_type_infos); ++i)
    if (field_type_infos[i].name == name) {
      out = static_cast<FieldType>(i);
      return true;
    }
  return false;
}

std::span<const double> Value::number_span() const {
  const auto& t = info(type);
  if (t.element != Element::number || is) return {};
  if (!t.multiple && t.arity == 1) return {&number, 1};
  return {numbers, std::size_t{count} * t.arity};
}

std::span<const std::int32_t> Value::integer_span() const {
  const auto& t = info(type);
  if (is || (t.element != Element::integer && t.element != Element::image)) return {};
  if (t.element == Element::integer && !t.multiple) return {&integer, 1};
  return {integers, count};
}

std::span<const NodeId> Value::node_span() const {
  const auto& t = info(type);
  if (t.element != Element::node || is) return {};
  if (t.multiple) return {nodes, count};
  return {&node, node ? 1u : 0u};
}

}  // namespace wrlkit
