#include "tools/cli/toml.h"

#include <algorithm>
#include <sstream>
#include <tuple>

#include <toml++/toml.h>

#include "base/math/digits.h"

namespace wrlkit {
namespace {

using Kind = TomlNode::Kind;

TomlPlace place_of(const toml::source_region& r) { return {r.begin.line, r.begin.column}; }

TomlNode node_of(const toml::node& from);

void members_of(const toml::table& from, TomlNode& to) {
  for (const auto& [key, value] : from) {
    auto& member = to.items.emplace_back(node_of(value));
    member.key = key.str();
    member.key_place = place_of(key.source());
  }
  // toml++ sorts by name.
  std::ranges::stable_sort(to.items, {},
                           [](const TomlNode& n) { return std::pair(n.key_place.line, n.key_place.column); });
}

TomlNode node_of(const toml::node& from) {
  TomlNode to;
  to.place = place_of(from.source());
  from.visit([&](const auto& value) {
    using T = std::remove_cvref_t<decltype(value)>;
    if constexpr (toml::is_table<T>) {
      members_of(value, to);
    } else if constexpr (toml::is_array<T>) {
      to.kind = Kind::list;
      for (const auto& item : value) to.items.push_back(node_of(item));
    } else if constexpr (toml::is_boolean<T>) {
      to.kind = Kind::boolean;
      to.text = *value ? "true" : "false";
    } else if constexpr (toml::is_integer<T> || toml::is_floating_point<T>) {
      to.kind = Kind::number;
      to.text = shortest_text(*value);
    } else if constexpr (toml::is_string<T>) {
      to.kind = Kind::text;
      to.text = *value;
    } else {
      std::ostringstream out;
      out << *value;
      to.kind = Kind::text;
      to.text = out.str();
    }
  });
  return to;
}

}  // namespace

const TomlNode* TomlNode::find(std::string_view name) const {
  auto i = std::ranges::find(items, name, &TomlNode::key);
  return i == items.end() ? nullptr : &*i;
}

std::string_view to_string(Kind k) {
  constexpr std::string_view names[] = {"true or false", "a number", "a text", "a list", "a table"};
  return names[static_cast<int>(k)];
}

std::optional<TomlNode> parse_toml(std::string_view text, std::string& why, TomlPlace& where) {
  try {
    TomlNode root;
    members_of(toml::parse(text), root);
    return root;
  } catch (const toml::parse_error& e) {
    why = e.description();
    if (why.find("could not determine value type") != why.npos) why = "texts need quotes: \"mm\"";
    where = place_of(e.source());
    return std::nullopt;
  }
}

std::string toml_value(std::string_view text) {
  double number = 0;
  if (text == "true" || text == "false" || read_number(text, number)) return std::string(text);
  std::ostringstream out;
  out << toml::value<std::string>(std::string(text));
  return out.str();
}

}  // namespace wrlkit
