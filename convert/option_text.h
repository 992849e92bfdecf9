// Options by their names, with values as texts: for recipes, and for languages that have no types.
#pragma once
#include <string>
#include <string_view>
#include <vector>

#include "base/math/digits.h"
#include "base/text/length_unit.h"
#include "base/text/letter_case.h"
#include "base/text/nearest_name.h"
#include "convert/options.h"

namespace wrlkit {
namespace option_value {

inline bool read(const std::string& text, bool& field, const OptionNote&) {
  field = text == "true";
  return field || text == "false";
}
inline bool read(const std::string& text, int& field, const OptionNote& note) {
  int v = 0;
  if (!read_number(text, v) || !note.range.contains(v)) return false;
  field = v;
  return true;
}
inline bool read(const std::string& text, LengthOption& field, const OptionNote&) {
  return field.read(text) && field.metres > 0;
}
inline bool read(const std::string& text, LightmapSize& field, const OptionNote&) { return field.read(text); }
inline bool read(const std::string& text, GltfOrigin& field, const OptionNote&) { return field.read(text); }
/// The name of a value as it should have been written: in any case, and units by their other names.
template <Choice E>
std::string forgiven(const std::string& text) {
  const std::string lower = lower_case(text);
  for (const auto& c : choices<E>) {
    if (c.name == text || c.name == lower) return std::string(c.name);
    if constexpr (std::is_same_v<E, Unit>)
      if (metres_in(text) && metres_in(text) == metres_in(c.name)) return std::string(c.name);
  }
  return text;
}
template <Choice E>
bool read(const std::string& text, E& field, const OptionNote&) {
  return read_choice(forgiven<E>(text), field);
}
template <class T>
std::string help(const T&, std::string_view text) {
  return std::string(text);
}
template <Choice E>
std::string help(const E&, std::string_view text) {
  const auto explained = choice_help<E>(text);
  return explained == text ? explained + ": " + choice_type<E>() : explained;
}
inline bool read(const std::string& text, std::vector<std::string>& field, const OptionNote&) {
  field.push_back(text);
  return true;
}

}  // namespace option_value

/// Whether there is an option of that name; `nearest` is given the names of all.
template <class Options>
bool has_option(std::string_view name, NearestName& nearest) {
  bool found = false;
  Options options;
  options.fields([&](std::string_view known, auto&, std::string_view, OptionNote = {}) {
    nearest.consider(known);
    found |= known == name;
  });
  return found;
}

/// Sets an option of that name, if there is one. False when one of the values is not valid for it; `why` says so.
template <class Options>
bool set_option(Options& options, std::string_view name, const std::vector<std::string>& values, std::string& why) {
  bool good = true;
  options.fields([&](std::string_view known, auto& field, std::string_view help, OptionNote note = {}) {
    if (known != name) return;
    for (const auto& value : values)
      if (good && !option_value::read(value, field, note)) {
        why = std::string(name) + ": '" + value + "' is not a valid value (" + option_value::help(field, help) + ")";
        good = false;
      }
  });
  return good;
}

}  // namespace wrlkit
