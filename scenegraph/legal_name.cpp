#include "scenegraph/legal_name.h"

#include <algorithm>

namespace wrlkit {
namespace {

bool ends_word(char c) {
  return static_cast<unsigned char>(c) <= ' ' || std::string_view("\"#,[]{}").find(c) != std::string_view::npos;
}

bool is_in_names(char c) { return !ends_word(c) && c != 0x7f && c != '\'' && c != '.' && c != '\\'; }

bool is_keyword(std::string_view s) {
  constexpr std::string_view words[] = {"DEF", "EXTERNPROTO", "FALSE", "IS",      "NULL",     "PROTO",        "ROUTE",
                                        "TO",  "TRUE",        "USE",   "eventIn", "eventOut", "exposedField", "field"};
  return std::ranges::find(words, s) != std::end(words);
}

}  // namespace

bool is_one_word(std::string_view name) { return std::ranges::none_of(name, ends_word); }

bool is_read_as_name(std::string_view name) { return is_one_word(name) && !is_keyword(name); }

std::string as_one_word(std::string_view name) {
  std::string out(name);
  std::ranges::replace_if(out, ends_word, '_');
  return out;
}

std::string legal_name(std::string_view name) {
  std::string out(name);
  std::ranges::replace_if(
      out, [](char c) { return !is_in_names(c); }, '_');
  if (!out.empty() && ((out[0] >= '0' && out[0] <= '9') || out[0] == '+' || out[0] == '-')) out.insert(0, "_");
  return is_keyword(out) ? out + "_" : out;
}

bool is_legal_name(std::string_view name) { return !name.empty() && legal_name(name) == name; }

}  // namespace wrlkit
