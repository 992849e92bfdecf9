// wrlkit explain, passes, formats: what the tables say of node types, passes, messages and formats.
#include <fmt/format.h>

#include <algorithm>
#include <utility>
#include <vector>

#include "passes/pipeline.h"
#include "scenegraph/diagnostics.h"
#include "scenegraph/node_table.h"
#include "tools/documentation.h"
#include "tools/flags.h"

namespace wrlkit {
namespace {

/// Letters that must be changed, at the most, to count as meant.
constexpr std::size_t near = 3;

std::size_t distance(std::string_view a, std::string_view b) {
  std::vector<std::size_t> row(b.size() + 1);
  for (std::size_t j = 0; j <= b.size(); ++j) row[j] = j;
  for (std::size_t i = 1; i <= a.size(); ++i) {
    std::size_t diagonal = row[0]++;
    for (std::size_t j = 1; j <= b.size(); ++j) diagonal = std::exchange(row[j], std::min({row[j] + 1, row[j - 1] + 1, diagonal + (std::tolower(a[i - 1]) != std::tolower(b[j - 1]))}));
  }
  return row.back();
}

std::string nearest(std::string_view name) {
  std::string best;
  std::size_t least = near + 1;
  auto consider = [&](std::string_view candidate) {
    if (auto d = distance(name, candidate); d < least) least = d, best = candidate;
  };
  for (auto& n : builtin_nodes()) consider(n.name);
  for (auto& p : passes()) consider(p.name);
  for (std::size_t i = 0; i < static_cast<std::size_t>(Diag::count_); ++i) consider(info(static_cast<Diag>(i)).name);
  return best;
}

}  // namespace

int run_explain(const Flags& flags) {
  TypeId type = find_builtin(flags.name, Dialect::vrml97);
  if (!type) type = find_builtin(flags.name, Dialect::x3d);
  const TypeId old = find_builtin(flags.name, Dialect::vrml1);
  if (type) fmt::print("{}", type_text(builtin_nodes()[type.value]));
  if (old) fmt::print("{}{}", type ? "\n" : "", type_text(builtin_nodes()[old.value]));
  if (type || old) return done;
  if (auto* p = find_pass(flags.name)) return fmt::print("{}", pass_text(*p)), done;
  if (Diag d; find_diag(flags.name, d)) return fmt::print("{}", diagnostic_text(d)), done;
  fmt::print(stderr, "wrlkit: there is no node type, pass or message '{}'", flags.name);
  auto meant = nearest(flags.name);
  fmt::print(stderr, "{}\n", meant.empty() ? "" : fmt::format("; did you mean '{}'?", meant));
  return usage;
}

int run_passes(const Flags& flags) {
  if (!flags.name.empty()) {
    if (auto* p = find_pass(flags.name)) return fmt::print("{}", pass_text(*p)), done;
    return fmt::print(stderr, "wrlkit: there is no pass '{}'\n", flags.name), usage;
  }
  if (flags.json) return fmt::print("{}\n", passes_json()), done;
  for (auto& p : passes()) fmt::print("{:<16}{}\n", p.name, p.summary);
  fmt::print("\nPipelines with a name:\n");
  for (auto& n : named_pipelines()) fmt::print("{:<16}{}\n                {}\n", n.name, n.summary, n.text);
  return done;
}

int run_docs(const Flags& flags) {
  fmt::print("{}", flags.name == "nodes" ? nodes_page() : flags.name == "passes" ? passes_page() : diagnostics_page());
  return done;
}

int run_formats(const Flags& flags) {
  if (flags.json) return fmt::print("{}\n", formats_json()), done;
  fmt::print("{}", formats_text());
  return done;
}

}  // namespace wrlkit
