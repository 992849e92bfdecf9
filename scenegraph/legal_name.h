// DEF names that VRML can have (ISO/IEC 14772-1, A.3), and what becomes of others.
#pragma once
#include <string>
#include <string_view>

namespace wrlkit {

/// Whether readers take the name as one word. Names such as `1pump` or `a.b` are not legal, but are read all the same.
bool is_one_word(std::string_view name);
/// The same, and it is no keyword either.
bool is_read_as_name(std::string_view name);
/// With '_' for blanks, brackets, quotes, commas and '#', which end a word.
std::string as_one_word(std::string_view name);

/// The name as it is if VRML97 allows it; otherwise with '_' for characters that it forbids, and '_' before a digit or
/// sign or behind a keyword.
std::string legal_name(std::string_view name);
bool is_legal_name(std::string_view name);

}  // namespace wrlkit
