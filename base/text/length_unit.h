// Units of length, as options and files name them.
#pragma once
#include <optional>
#include <string_view>

namespace wrlkit {

/// How people write a length; part of messages about what is not one.
inline constexpr std::string_view length_examples = "20mm, 2cm, 0.5in, or 0.02 in metres";

/// Metres in one m, cm, mm, in or ft, by these names or whole ones, whatever their case; nothing for other text.
std::optional<double> metres_in(std::string_view unit);

}  // namespace wrlkit
