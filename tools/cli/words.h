// What the words of a command line mean before their options are read: help, verbs of two words, files without a verb.
#pragma once
#include <optional>
#include <string>
#include <vector>

namespace wrlkit {

/// Puts the verb in front: "help convert" is "convert --help", "plant.wrl" is "info plant.wrl", "plant.wrl plant.glb"
/// is "convert plant.wrl plant.glb". An exit code when that ends the command, which was printed.
std::optional<int> put_verb_first(std::vector<std::string>& words);

/// "corpus run" for "corpus-run", as users write it.
std::string spoken_verb(const std::string& verb);

/// What CLI11 says of numbers of values, and of ranges.
std::string in_our_words(const std::string& what);

/// The same of options without a verb: "wrlkit: there is no option '--versoin'; did you mean '--version'?"; empty when
/// nothing is wrong with them.
std::string program_option_fault(const std::vector<std::string>& words);

/// What was wrong with options, in a line: "wrlkit convert: there is no option '--ratio'; did you mean '--ratios'?".
/// `options`: all names of the verb without dashes, those of one letter too. `what`: the fault where all of them exist.
std::string option_fault(const std::string& verb, const std::vector<std::string>& words,
                         const std::vector<std::string>& options, bool takes_output, const std::string& what);

}  // namespace wrlkit
