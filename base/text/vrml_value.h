// Text that is the value of a field in VRML, and nothing else: what is written as it is must not become nodes.
#pragma once
#include <string_view>

namespace wrlkit {

/// Numbers, strings, TRUE, FALSE and lists of these, all of them closed. Not an empty text.
bool is_vrml97_value(std::string_view);

/// That, or as VRML 1.0 has it, one word in capitals or words in parentheses.
bool is_vrml_value(std::string_view);

/// Whether it is several values without brackets around them, and one of these is a string.
bool is_bare_list_of_strings(std::string_view vrml_value);

}  // namespace wrlkit
