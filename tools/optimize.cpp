// wrlkit optimize: share what is equal, write it small, and say what that did.
#include <fmt/format.h>

#include <filesystem>
#include <set>

#include "scenegraph/nodes.h"
#include "scenegraph/walk.h"
#include "tools/gltf_output.h"
#include "tools/profiles.h"
#include "tools/session.h"
#include "writers/json.h"

namespace wrlkit {
namespace {

/// DEF names of what is drawn or holds it: those that a plant's tags are.
std::set<std::string> names_of(const Scene& scene) {
  std::set<std::string> out;
  for (NodeId n : reachable(scene, scene.main))
    if (!scene.name(n).empty() && (scene.is(n, nodes::Shape) || scene.type(n).is_a("X3DGroupingNode"))) out.emplace(scene.name(n));
  return out;
}

struct Before {
  std::uint64_t bytes = 0;
  std::set<std::string> names;
};

std::string text(const Session& s, const Before& before, const std::set<std::string>& lost, const GltfSummary& made) {
  return fmt::format("{} ({} bytes) -> {} ({} bytes)\n{}  names: {} of {} kept\n", s.flags().inputs[0], before.bytes, s.flags().output, made.bytes(), summary_text(made),
                     before.names.size() - lost.size(), before.names.size());
}

std::string json_text(const Session& s, const Before& before, const std::set<std::string>& lost, const GltfSummary& made) {
  std::string out;
  JsonOut json(out);
  json.begin_object();
  json.member("input", s.flags().inputs[0]);
  json.member("output", s.flags().output);
  json.member("profile", s.flags().profile);
  json.member("bytes_before", before.bytes);
  json.member("bytes_after", made.bytes());
  json.member("names_before", before.names.size());
  json.key("names_lost");
  json.begin_array();
  for (const auto& name : lost) json.value(name);
  json.end_array();
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
  apply_profile(flags);
  if (flags.print_profile) return fmt::print("{}", profile_text(*profile)), done;
  if (flags.inputs.empty() || flags.output.empty()) return fmt::print(stderr, "wrlkit: optimize needs IN and OUT\n"), usage;
  if (!flags.pipeline_given) flags.pipeline = profile->pipeline, flags.pipeline_given = true;
  Session s(flags);
  auto options = gltf_options(flags);
  if (!s.good() || !options || !s.choose_pipeline(gltf_pipeline(flags))) return usage;
  if (flags.print_pipeline) return fmt::print("{}\n", s.pipeline().text()), done;
  if (!s.read(flags.inputs[0])) return s.end(false);
  std::error_code ec;
  const auto size = std::filesystem::file_size(flags.inputs[0], ec);
  const Before before{ec ? 0 : size, names_of(s.world().scene)};
  options->measure_gzip = !flags.quiet;
  GltfSummary made;
  if (!write_gltf_file(s, *options, made)) return s.end(false);
  const auto after = names_of(s.world().scene);
  std::set<std::string> lost;
  std::ranges::set_difference(before.names, after, std::inserter(lost, lost.end()));
  if (flags.json) fmt::print("{}", json_text(s, before, lost, made));
  else if (!flags.quiet) fmt::print(stderr, "{}", text(s, before, lost, made));
  return s.end(true);
}

}  // namespace wrlkit
