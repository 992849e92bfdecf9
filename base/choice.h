// Options that are one of a few values: an enumeration, and one row with the names of its values. Reading, printing,
// help and the pages of the documentation come from that row.
//
//   enum class Axis : std::uint8_t { x, y };
//   template <>
//   inline constexpr auto choices<Axis> = choice_row({{"x"}, {"y", "upwards"}});
#pragma once
#include <array>
#include <cstddef>
#include <string>
#include <string_view>
#include <type_traits>

namespace wrlkit {

struct ChoiceName {
  std::string_view name, help = {};  // help: what it means, where the name does not say it
};

template <std::size_t N>
consteval std::array<ChoiceName, N> choice_row(const ChoiceName (&row)[N]) {
  return std::to_array(row);
}

/// The values of E, from 0 on.
template <class E>
inline constexpr std::array<ChoiceName, 0> choices{};

template <class E>
concept Choice = std::is_enum_v<E> && !choices<E>.empty();

template <Choice E>
constexpr std::string_view name_of(E value) {
  return choices<E>[static_cast<std::size_t>(value)].name;
}

/// False when no value has that name.
template <Choice E>
constexpr bool read_choice(std::string_view text, E& value) {
  for (std::size_t i = 0; i < choices<E>.size(); ++i)
    if (choices<E>[i].name == text) {
      value = static_cast<E>(i);
      return true;
    }
  return false;
}

/// "x, y or z".
template <Choice E>
const std::string& choice_type() {
  static const std::string type = [] {
    std::string out;
    for (std::size_t i = 0; i < choices<E>.size(); ++i)
      out += (i == 0 ? "" : i + 1 < choices<E>.size() ? ", " : " or ") + std::string(choices<E>[i].name);
    return out;
  }();
  return type;
}

/// The help of an option, with what its values mean: "how: x, sideways; y, upwards".
template <Choice E>
std::string choice_help(std::string_view help) {
  std::string out(help), list;
  bool explained = false;
  for (const auto& c : choices<E>) {
    explained |= !c.help.empty();
    list += (list.empty() ? ": " : "; ") + std::string(c.name) + (c.help.empty() ? "" : ", " + std::string(c.help));
  }
  return explained ? out + list : out;
}

}  // namespace wrlkit
