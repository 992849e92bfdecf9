// wrlkit illuminate: global illumination of a world, as a patch file. What RenderX was to Lazanyi (3.1).
#include "passes/patches/illuminate.h"

#include <fmt/format.h>

#include <ctime>
#include <filesystem>

#include "tools/lengths.h"
#include "tools/session.h"
#include "writers/json.h"
#include "writers/output.h"
#include "writers/patches.h"

namespace wrlkit {
namespace {

light::Method method_of(const std::string& name) {
  if (name == "stochastic-iteration") return light::Method::stochastic_iteration;
  return name == "path" ? light::Method::path : light::Method::progressive_radiosity;
}

bool read_options(const Flags& f, light::IlluminateOptions& o) {
  o.method = method_of(f.method);
  o.sizes.max_area = f.max_area;
  o.gradient = f.gradient;
  o.how.samples = f.light_samples;
  o.how.seed = static_cast<std::uint64_t>(f.seed);
  if (f.max_edge.empty()) return true;
  o.sizes.max_edge = length_of(f.max_edge);
  if (o.sizes.max_edge > 0) return true;
  return fmt::print(stderr, "wrlkit illuminate: --max-edge: '{}' is no length\n", f.max_edge), false;
}

void print(const Session& s, const PatchSet& set, double seconds) {
  if (s.flags().json && s.flags().output != "-") {
    std::string text;
    JsonOut json(text);
    json.begin_object();
    json.member("file", s.flags().output);
    json.member("method", set.method);
    json.member("samples", set.samples);
    json.member("shapes", set.shapes.size());
    json.member("triangles", set.triangles.size());
    json.member("patches", set.patches.size());
    json.member("cpu_seconds", seconds);
    json.end_object();
    fmt::print("{}\n", text);
  } else if (s.flags().verbose) {
    fmt::print(stderr, "{}: {} patches of {} triangles in {} shapes, {:.1f} s of processor time\n", s.flags().output, set.patches.size(), set.triangles.size(), set.shapes.size(), seconds);
  }
}

}  // namespace

int run_illuminate(const Flags& flags) {
  Session s(flags);
  light::IlluminateOptions options;
  if (!s.good() || !read_options(flags, options) || !s.choose_pipeline("inline,expand-protos,inline,expand-protos,tessellate")) return usage;
  if (!s.read(flags.inputs[0])) return s.end(false);
  const auto meshes = s.pipeline().run_lazily(s.world().scene, s.context(), s.pipeline_options());
  if (!meshes) return s.end(false);
  const auto begin = std::clock();
  const light::LightWorld world(s.world().scene, meshes, &s.resources(), {.emission = flags.emission}, s.diag());
  constexpr int parts = 1000;
  s.progress().begin(flags.method, parts, "parts");
  options.how.done = [&](double share) { s.progress().set(static_cast<std::uint64_t>(share * parts)); };
  auto set = light::illuminate(s.world().scene, world, options, s.diag());
  if (set.patches.empty()) return s.diag().report(Diag::no_surface, {}), s.end(false);
  set.source = flags.inputs[0] == standard_input ? "" : std::filesystem::path(flags.inputs[0]).filename().string();
  set.method = flags.method;
  auto file = OutputFile::open(flags.output, {}, s.diag());
  if (!file) return s.end(false);
  write_patches(set, file->sink());
  if (!file->commit(s.diag())) return s.end(false);
  print(s, set, static_cast<double>(std::clock() - begin) / CLOCKS_PER_SEC);
  return s.end(true);
}

}  // namespace wrlkit
