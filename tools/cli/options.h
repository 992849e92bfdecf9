// Options that several verbs have. This, verbs.cpp and cli.cpp are the files that know CLI11.
#pragma once
#include <CLI/CLI.hpp>

#include "convert/options.h"
#include "tools/cli/flags.h"

namespace wrlkit::cli {

/// Adds options that describe themselves (convert/options.h) to a verb. A number that is 0 is not set.
struct AddOption {
  CLI::App& verb;

  void operator()(std::string_view name, bool& field, std::string_view help) const {
    verb.add_flag("--" + std::string(name), field, std::string(help));
  }
  void operator()(std::string_view name, int& field, std::string_view help, OptionNote note) const {
    auto* option = verb.add_option("--" + std::string(name), field, std::string(help));
    option->check(CLI::Range(static_cast<int>(note.range.least), static_cast<int>(note.range.most)));
    if (!note.type.empty()) option->type_name(std::string(note.type));
    if (field != 0) option->capture_default_str();
  }
  void operator()(std::string_view name, LengthOption& field, std::string_view help, OptionNote note) const {
    const auto read = [&field](const std::string& text) { field.read(text); };
    const auto fault = [](const std::string& text) {
      LengthOption length;
      return length.read(text) && length.metres > 0 ? "" : "'" + text + "' is not a valid length";
    };
    verb.add_option_function<std::string>("--" + std::string(name), read, std::string(help))
        ->type_name(std::string(note.type))
        ->check(fault, "", "");
  }
  template <class E>
  requires std::is_enum_v<E>
  void operator()(std::string_view name, E& field, std::string_view help) const {
    const auto read = [&field](const std::string& text) { read_value(text, field); };
    verb.add_option_function<std::string>("--" + std::string(name), read, std::string(help))
        ->check(CLI::IsMember(std::vector<std::string>(value_names<E>.begin(), value_names<E>.end())))
        ->default_str(std::string(name_of(field)));
  }
};

/// The group of options that every verb has.
void common(CLI::App& verb, Flags&);
/// IN, the world.
void input(CLI::App& verb, Flags&);
void placing(CLI::App& verb, Flags&);
/// One of the names; of a criterion that this build does without, the reason.
CLI::Validator a_criterion();
void python(CLI::App& verb, Flags&);
void pipeline(CLI::App& verb, Flags&);
void vrml_output(CLI::App& verb, Flags&);
void small_gltf(CLI::App& verb, Flags&);
void level(CLI::App& verb, Flags&);
void pictures(CLI::App& verb, Flags&);
void corpus_inputs(CLI::App& verb, Flags&);

}  // namespace wrlkit::cli
