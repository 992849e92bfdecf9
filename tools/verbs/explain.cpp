// wrlkit explain, passes, formats: what the tables say of node types, passes, messages and formats.
#include <fmt/format.h>

#include <span>
#include <vector>

#include "base/diagnostics.h"
#include "base/text/nearest_name.h"
#include "convert/profiles.h"
#include "passes/pipeline/pipeline.h"
#include "scenegraph/node_table.h"
#include "tools/cli/flags.h"
#include "tools/cli/recipe.h"
#include "tools/verbs/documentation_json.h"

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

/// What VRML97 or X3D, and what VRML 1.0 means by that name.
std::vector<const NodeType*> types_of(std::string_view name) {
  std::vector<const NodeType*> out;
  TypeId type = find_builtin(name, Dialect::vrml97);
  if (!type) type = find_builtin(name, Dialect::x3d);
  for (const TypeId id : {type, find_builtin(name, Dialect::vrml1)})
    if (id) out.push_back(&builtin_nodes()[id.value]);
  return out;
}

std::string types_text(std::span<const NodeType* const> types) {
  std::string out;
  for (const NodeType* t : types) out += (out.empty() ? "" : "\n") + type_text(*t);
  return out;
}

}  // namespace

int run_explain(const Flags& flags) {
  const auto print = [&](const auto& text, const auto& json) {
    fmt::print("{}", flags.json ? json() + '\n' : text());
    return done;
  };
  if (const auto types = types_of(flags.name); !types.empty())
    return print([&] { return types_text(types); }, [&] { return explained_nodes_json(types); });
  if (const BrowserNode* n = find_browser_node(flags.name))
    return print([&] { return browser_node_text(*n); }, [&] { return explained_json(*n); });
  if (const auto* p = find_pass(flags.name))
    return print([&] { return pass_text(*p); }, [&] { return explained_json(*p); });
  if (Diag d; find_diag(flags.name, d))
    return print([&] { return diagnostic_text(d); }, [&] { return explained_json(d); });
  fmt::print(stderr, "wrlkit: there is no node type, pass or message '{}'{}\n", flags.name, meant(flags.name));
  return usage;
}

int run_passes(const Flags& flags) {
  if (!flags.name.empty()) {
    if (const auto* p = find_pass(flags.name)) {
      fmt::print("{}", flags.json ? pass_json(*p) + '\n' : pass_text(*p));
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
  if (flags.name.empty() && flags.json) {
    fmt::print("{}\n", pages_json());
    return done;
  }
  for (const auto& page : documentation_pages())
    if (flags.name.empty())
      fmt::print("{}\n", page.name);
    else if (flags.name == page.name)
      fmt::print("{}", flags.json ? page_json(page) + '\n' : page.text());
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
