#include "scenegraph/node_table.h"

#include <algorithm>
#include <unordered_map>

namespace wrlkit {

bool FieldDef::accepts(const NodeType& t) const {
  return std::ranges::any_of(kinds, [&](std::string_view k) { return t.is_named(k); });
}

bool NodeType::is_named(std::string_view name_or_base) const {
  return name == name_or_base || std::ranges::find(bases, name_or_base) != bases.end();
}

bool NodeType::takes_any_field() const {
  return kind == NodeKind::unknown || is_named("X3DShaderNode") || is_named("ShaderProgram");
}

std::optional<std::uint16_t> NodeType::find(std::string_view field, Dialect dialect, bool events) const {
  if (kind == NodeKind::builtin)
    for (const Dialect only : {Dialect::x3d, Dialect::vrml1})  // a node of that language in a file of another one
      if (dialects == static_cast<DialectSet>(only)) dialect = only;
  if (!by_name.empty()) {
    auto i = std::ranges::lower_bound(by_name, field, {}, [&](std::uint16_t slot) { return fields[slot].name; });
    if (i != by_name.end() && fields[*i].name == field) return *i;
  } else
    for (std::size_t i = 0; i < fields.size(); ++i)
      if (((fields[i].dialects & static_cast<DialectSet>(dialect)) || fields[i].is_own()) &&
          fields[i].name_in(dialect) == field)
        return static_cast<std::uint16_t>(i);
  // Files of X3D that were VRML97 once (Xj3D's, castle's) still have choice, level and collide.
  if (dialect == Dialect::x3d && (field == "choice" || field == "level" || field == "collide"))
    for (std::size_t i = 0; i < fields.size(); ++i)
      if (fields[i].vrml97_name == field) return static_cast<std::uint16_t>(i);
  if (!events) return std::nullopt;
  auto exposed = [&](std::string_view stem) -> std::optional<std::uint16_t> {
    auto i = find(stem, dialect, false);
    // Which initializeOnly fields became inputOutput depends on the version of X3D.
    bool events =
        i && (fields[*i].access == Access::inout || (dialect == Dialect::x3d && fields[*i].access == Access::init));
    return events ? i : std::nullopt;
  };
  if (field.starts_with("set_"))
    if (auto i = exposed(field.substr(4))) return i;
  if (field.ends_with("_changed"))
    if (auto i = exposed(field.substr(0, field.size() - 8))) return i;
  return std::nullopt;
}

TypeId find_builtin(std::string_view name, Dialect dialect) {
  static const auto by_name = [] {
    std::unordered_multimap<std::string_view, std::uint32_t> m;
    auto rows = builtin_nodes();
    m.reserve(rows.size());
    for (std::uint32_t i = 0; i < rows.size(); ++i) m.emplace(rows[i].name, i);
    return m;
  }();
  auto [b, e] = by_name.equal_range(name);
  for (; b != e; ++b)
    if (const auto& row = builtin_nodes()[b->second]; (row.dialects & static_cast<DialectSet>(dialect)) || row.is_own())
      return TypeId{b->second};
  return {};
}

}  // namespace wrlkit
