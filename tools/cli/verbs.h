// The table of verbs.
#pragma once
#include <span>

#include "tools/cli/flags.h"

namespace CLI {
class App;
}

namespace wrlkit::cli {

struct Verb {
  const char *name, *help, *example;
  void (*flags)(CLI::App&, Flags&);
  int (*run)(const Flags&);
  const char* endings = "";  // of outputs that have one format only, with blanks between them
  const char* makes = "";    // the file that it makes in the folder of its output
  const char* no_json = "";  // why there is no JSON where it prints to standard output; empty: there is
};

/// In the order of the help.
std::span<const Verb> verbs();
/// Null when there is none of that name.
const Verb* find_verb(std::string_view name);

}  // namespace wrlkit::cli
