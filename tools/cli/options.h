// Options that several verbs have. This, verbs.cpp and cli.cpp are the files that know CLI11.
#pragma once
#include "tools/cli/flags.h"

namespace CLI {
class App;
class Option;
class Validator;
}  // namespace CLI

namespace wrlkit::cli {

/// The group of options that every verb has.
void common(CLI::App& verb, Flags&);
/// IN, the world.
void input(CLI::App& verb, Flags&);
CLI::Option* timeout(CLI::App& verb, Flags&, const char* help);
void placing(CLI::App& verb, Flags&);
/// One of those names.
CLI::Validator one_of(const std::vector<std::string>& names);
/// One of the names; of a criterion that this build does without, the reason.
CLI::Validator a_criterion();
/// A number from 0 to 1, or per cent: 0.5, 50%.
CLI::Validator a_share();
/// A finite number.
CLI::Validator a_number();
/// A number of a range, both ends included; NaN is in none.
CLI::Validator a_number_within(double least, double most);
/// A finite number above 0.
CLI::Validator a_number_above_0();
void python(CLI::App& verb, Flags&);
void pipeline(CLI::App& verb, Flags&);
void light(CLI::App& verb, Flags&);
void vrml_output(CLI::App& verb, Flags&);
/// What becomes of files that the output refers to.
void files(CLI::App& verb, Flags&);
void small_gltf(CLI::App& verb, Flags&);
/// OUT may be IN.
void in_place(CLI::App& verb, Flags&);
/// How illuminate works.
void method(CLI::App& verb, Flags&);
void level(CLI::App& verb, Flags&);
void pictures(CLI::App& verb, Flags&);
/// --format: an ending without its dot.
void format(CLI::App& verb, Flags&, const std::string& help);
/// Which files of folders are meant.
void globs(CLI::App& verb, Flags&);
/// How tiles are made.
void tiles(CLI::App& verb, Flags&);
void corpus_inputs(CLI::App& verb, Flags&);

}  // namespace wrlkit::cli
