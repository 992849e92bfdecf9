// wrlkit optimize: share what is equal, write it small, and say what that did.
#include <fmt/format.h>

#include <algorithm>
#include <filesystem>
#include <fstream>
#include <set>
#include <utility>

#include "base/text/json.h"
#include "convert/profiles.h"
#include "parsers/gltf/names.h"
#include "passes/analysis/text_list.h"
#include "scenegraph/nodes.h"
#include "scenegraph/walk.h"
#include "tools/gltf_summary.h"
#include "tools/verbs/convert.h"

namespace wrlkit {
namespace {

/// All DEF names of the world, and those of what no Switch shows: glTF shows one of its children, and has no place for
/// the others.
struct Names {
  std::set<std::string> all, shown;
};

Names names_of(const Scene& scene) {
  Names out;
  std::vector<char> seen(scene.node_count());
  std::vector<NodeId> open = scene.main.roots;
  while (!open.empty()) {
    const NodeId n = open.back();
    open.pop_back();
    if (!n || std::exchange(seen[n.value], 1)) continue;
    if (!scene.name(n).empty()) out.shown.emplace(scene.name(n));
    const bool chooses = scene.is(n, nodes::Switch);
    const auto shown = chooses ? shown_children(scene, n) : std::vector<NodeId>();
    for_each_child(scene, n, [&](NodeId c) {
      if (!chooses || std::ranges::find(shown, c) != shown.end()) open.push_back(c);
    });
  }
  for (NodeId n : reachable(scene, scene.main))
    if (!scene.name(n).empty()) out.all.emplace(scene.name(n));
  return out;
}

struct Before {
  std::uint64_t bytes = 0;
  Names names;
};

/// Names that the file does not have.
struct Lost {
  std::vector<std::string> names;  // of what is shown
  std::vector<std::string> not_shown;
};

Lost lost_of(const Names& names, const std::string& path) {
  Lost out;
  std::ifstream file(path, std::ios::binary);
  const std::string bytes((std::istreambuf_iterator<char>(file)), {});
  Diagnostics diag;
  const auto kept = names_in_gltf(bytes, path, diag);
  for (const auto& name : names.all)
    if (!kept.contains(name)) (names.shown.contains(name) ? out.names : out.not_shown).push_back(name);
  return out;
}

std::string names_text(const Before& before, const Lost& lost) {
  std::string out =
      fmt::format("  names: {} of {} kept", before.names.all.size() - lost.names.size() - lost.not_shown.size(),
                  before.names.all.size());
  if (!lost.not_shown.empty()) out += fmt::format("; {} are only of nodes that no Switch shows", lost.not_shown.size());
  return out + '\n';
}

std::string text(const Session& s, const Before& before, const Lost& lost, const GltfSummary& made) {
  return fmt::format("{} ({} bytes) -> {} ({} bytes)\n{}{}", s.flags().inputs[0], before.bytes, s.flags().output,
                     made.bytes(), summary_text(made), names_text(before, lost));
}

std::string json_text(const Session& s, const Before& before, const Lost& lost, const GltfSummary& made) {
  std::string out;
  JsonOut json(out);
  json.begin_object();
  json.member("input", s.flags().inputs[0]);
  json.member("output", s.flags().output);
  json.member("profile", s.flags().profile);
  json.member("bytes_before", before.bytes);
  json.member("bytes_after", made.bytes());
  json.member("names_before", before.names.all.size());
  json.member("names_lost", std::span<const std::string>(lost.names));
  json.member("names_not_shown", std::span<const std::string>(lost.not_shown));
  json.key("gltf");
  json.raw(summary_json(made));
  json.end_object();
  return out + "\n";
}

}  // namespace

int run_optimize(const Flags& given) {
  Flags flags = given;
  const Profile* profile = find_profile(flags.profile.empty() ? "three" : flags.profile);
  flags.profile = profile->name;
  if (flags.print_profile) {
    fmt::print("{}", profile_text(*profile));
    return done;
  }
  if (flags.inputs.empty() || flags.output.empty()) {
    fmt::print(stderr, "wrlkit: optimize needs IN and OUT\n");
    return usage;
  }
  if (!flags.pipeline_given) {
    flags.pipeline = profile->pipeline;
    flags.pipeline_given = true;
  }
  Session s(flags);
  auto options = save_options(flags);
  if (!prepare_conversion(s)) return usage;
  if (!output_of(flags.output)->format->meshes) {
    fmt::print(stderr, "wrlkit: optimize writes .glb and .gltf, not '{}'\n", flags.output);
    return usage;
  }
  if (flags.print_pipeline) {
    fmt::print("{}\n", s.pipeline().text());
    return done;
  }
  if (!s.read(flags.inputs[0])) return s.end(false);
  std::error_code ec;
  const auto size = std::filesystem::file_size(flags.inputs[0], ec);
  const Before before{ec ? 0 : size, names_of(s.world().scene)};
  options.measure_gzip = !flags.quiet;
  const auto saved = write_world(s, options);
  if (!saved) return s.end(false);
  const GltfSummary& made = *saved.gltf;
  // Standard output cannot be read again.
  const Lost lost = flags.output == "-" ? Lost{} : lost_of(before.names, flags.output);
  if (!lost.names.empty()) {
    TextList list;
    for (const auto& name : lost.names) list.add(name);
    s.diag().report(Diag::names_lost, {}, "optimize", list.count(), list.text());
  }
  s.progress().clear();
  if (flags.json)
    fmt::print("{}", json_text(s, before, lost, made));
  else if (!flags.quiet)
    fmt::print(stderr, "{}", text(s, before, lost, made));
  return s.end(true);
}

}  // namespace wrlkit
