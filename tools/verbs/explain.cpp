// wrlkit explain, passes, formats: what the tables say of node types, passes, messages and formats.
#include <fmt/format.h>

#include "base/diagnostics.h"
#include "base/text/nearest_name.h"
#include "convert/profiles.h"
#include "passes/pipeline/pipeline.h"
#include "scenegraph/node_table.h"
#include "tools/cli/flags.h"
#include "tools/cli/recipe.h"
#include "tools/verbs/documentation.h"

namespace wrlkit {
namespace {

std::string meant(std::string_view name) {
  NearestName nearest(name);
  for (auto& n : builtin_nodes()) nearest.consider(n.name);
  for (auto& p : passes()) nearest.consider(p.name);
  for (auto* p : added_passes()) nearest.consider(p->name);
  for (const auto& d : all_diags()) nearest.consider(d.name);
  return nearest.question();
}

}  // namespace

int run_explain(const Flags& flags) {
  TypeId type = find_builtin(flags.name, Dialect::vrml97);
  if (!type) type = find_builtin(flags.name, Dialect::x3d);
  const TypeId old = find_builtin(flags.name, Dialect::vrml1);
  if (type) fmt::print("{}", type_text(builtin_nodes()[type.value]));
  if (old) fmt::print("{}{}", type ? "\n" : "", type_text(builtin_nodes()[old.value]));
  if (type || old) return done;
  if (const BrowserNode* n = find_browser_node(flags.name)) {
    fmt::print("{}", browser_node_text(*n));
    return done;
  }
  if (auto* p = find_pass(flags.name)) {
    fmt::print("{}", pass_text(*p));
    return done;
  }
  if (Diag d; find_diag(flags.name, d)) {
    fmt::print("{}", diagnostic_text(d));
    return done;
  }
  fmt::print(stderr, "wrlkit: there is no node type, pass or message '{}'{}\n", flags.name, meant(flags.name));
  return usage;
}

int run_passes(const Flags& flags) {
  if (!flags.name.empty()) {
    if (auto* p = find_pass(flags.name)) {
      fmt::print("{}", pass_text(*p));
      return done;
    }
    fmt::print(stderr, "wrlkit: there is no pass '{}'{}\n", flags.name, pass_question(flags.name));
    return usage;
  }
  if (flags.json) {
    fmt::print("{}\n", passes_json());
    return done;
  }
  for (auto& p : passes()) fmt::print("{:<18}{}\n", p.name, p.summary);
  for (auto* p : added_passes()) fmt::print("{:<18}{}\n", p->name, p->summary);
  fmt::print("\nPipelines with a name:\n");
  for (auto& n : named_pipelines()) fmt::print("{:<18}{}\n                  {}\n", n.name, n.summary, n.text);
  return done;
}

int run_docs(const Flags& flags) {
  for (const auto& page : documentation_pages())
    if (flags.name.empty())
      fmt::print("{}\n", page.name);
    else if (flags.name == page.name)
      fmt::print("{}", page.text());
  return done;
}

int run_formats(const Flags& flags) {
  if (flags.json) {
    fmt::print("{}\n", formats_json());
    return done;
  }
  fmt::print("{}", formats_text());
  return done;
}

}  // namespace wrlkit
