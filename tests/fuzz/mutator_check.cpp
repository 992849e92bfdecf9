// What the mutator of the fuzzers makes is what it says: files of the node table are read without a word about their
// grammar, nodes and fields; mutations of them keep most of their nodes known. Says what was not, and how often.
#include <cstdio>
#include <map>
#include <set>
#include <string>

#include "parsers/parsers.h"
#include "scenegraph/verify.h"
#include "scenegraph/walk.h"
#include "tests/fuzz/world_mutator.h"

using namespace wrlkit;

namespace {

constexpr int n_files = 300;

// Numbers may be out of range and names mean other nodes; nothing else may be said.
const std::set<Diag> wrong = {
    Diag::syntax,          Diag::unclosed,           Diag::bad_value,      Diag::unknown_node,
    Diag::unknown_field,   Diag::wrong_child,        Diag::misplaced_node, Diag::stray_token,
    Diag::route_types,     Diag::unknown_event,      Diag::unknown_word,   Diag::xml_syntax,
    Diag::unknown_element, Diag::container_repaired, Diag::unknown_is,     Diag::missing_values};

struct Kind {
  const char* name;
  Dialect dialect;
  Encoding encoding;
};
constexpr Kind kinds[] = {{"vrml97", Dialect::vrml97, Encoding::vrml},
                          {"vrml1", Dialect::vrml1, Encoding::vrml},
                          {"x3d classic", Dialect::x3d, Encoding::vrml},
                          {"x3d xml", Dialect::x3d, Encoding::xml}};

/// How much was wrong in the files of a kind.
int check(const Kind& kind) {
  std::mt19937 random(7);
  std::map<std::string, int> said;
  std::set<std::string> types;
  std::size_t n_routes = 0, n_protos = 0;
  for (int i = 0; i < n_files; ++i) {
    const auto text = WorldText(kind.dialect, kind.encoding, random).file();
    Diagnostics diag;
    const auto world = parse_world(text, "made", {}, diag);
    if (!world) return std::printf("%s: not read:\n%s\n", kind.name, text.c_str());
    check_values(world->scene, diag);
    for (const auto& m : diag.messages())
      if (wrong.contains(m.id)) ++said[m.text()];
    for (NodeId n : all_nodes(world->scene)) types.emplace(world->scene.type(n).name);
    n_routes += world->scene.main.routes.size();
    n_protos += world->scene.main.protos.size();
    Diagnostics unheard;
    parse_world(mutated_world(text, world->format, random), "mutated", {}, unheard);
  }
  std::printf("%s: %zu types of nodes, %zu prototypes, %zu ROUTEs, %zu faults\n", kind.name, types.size(), n_protos,
              n_routes, said.size());
  for (const auto& [what, n] : said) std::printf("  %d times: %s\n", n, what.c_str());
  const bool routes = kind.dialect == Dialect::vrml1 || (n_routes > 0 && n_protos > 0);
  return static_cast<int>(said.size()) + (types.size() < 40) + !routes;
}

}  // namespace

int main() {
  int n_faults = 0;
  for (const auto& kind : kinds) n_faults += check(kind);
  return n_faults ? 1 : 0;
}
