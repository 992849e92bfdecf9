// Names of files in tables and logs that shells and people read.
#pragma once
#include <string>

namespace wrlkit {

/// As a shell reads it, on one line whatever is in it.
std::string shell_word(const std::string& word);
/// A name in a table: as a shell reads it, where it would break the line or the column.
std::string in_one_field(const std::string& name);

}  // namespace wrlkit
