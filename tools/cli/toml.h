// TOML files as trees of texts with places. The only door to toml++.
#pragma once
#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace wrlkit {

struct TomlPlace {
  std::size_t line = 0, column = 0;  // from 1
};

struct TomlNode {
  enum class Kind : std::uint8_t { boolean, number, text, list, table };

  Kind kind = Kind::table;
  std::string key;   // of a member of a table
  std::string text;  // of boolean, number and text; numbers as short as they can be
  TomlPlace place, key_place;
  std::vector<TomlNode> items;  // of a list, or the members of a table, in the order of the file

  /// The member of that name, or null.
  const TomlNode* find(std::string_view name) const;
};

std::string_view to_string(TomlNode::Kind);

/// The table that a text is; else why it is none, and where. Dates and times are texts.
std::optional<TomlNode> parse_toml(std::string_view text, std::string& why, TomlPlace& where);

/// A value as TOML has it: numbers, true and false as they are, all else in quotes.
std::string toml_value(std::string_view text);

}  // namespace wrlkit
