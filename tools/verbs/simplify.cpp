// wrlkit simplify: the world at falling numbers of triangles, one file each, and one file with all of them as levels of
// detail: the interaction points of Lazanyi, 2.3. Or one progressive file.
#include <fmt/format.h>

#include <algorithm>
#include <filesystem>
#include <optional>

#include "base/io/output.h"
#include "base/text/json.h"
#include "convert/writing.h"
#include "geometry/progressive/progressive_world.h"
#include "geometry/simplify/world.h"
#include "tools/cli/lengths.h"
#include "tools/cli/session.h"

namespace wrlkit {
namespace {

namespace fs = std::filesystem;

/// The name of the input without folder and endings: "plant" of "old/plant.wrl.gz".
std::string stem_of(const std::string& path) {
  auto name = fs::path(path).filename().string();
  name.resize(name.size() - ending_of(name, scene_endings()).size());
  return name == "-" ? "world" : name;
}

/// What the flags ask for; nothing when they make no sense, which was printed.
std::optional<WorldSimplifyOptions> options_of(const Flags& f) {
  WorldSimplifyOptions o;
  CriterionName criterion;
  if (!f.criterion.empty()) criterion.read(f.criterion);
  o.collapse.criterion = criterion.value;
  o.budget.pixels = f.pixels;
  if ((f.every > 0) + !f.counts.empty() + !f.ratios.empty() + !f.errors.empty() + f.progressive != 1) {
    fmt::print(stderr, "wrlkit simplify: one of --every, --counts, --ratios, --error and --progressive is needed\n");
    return std::nullopt;
  }
  if (f.progressive && !info(criterion.value).keeps_record) {
    fmt::print(stderr, "wrlkit simplify: --progressive: {} keeps no record of its steps\n", criterion.print());
    return std::nullopt;
  }
  for (const auto& text : f.errors) {
    const double e = length_of(text);
    if (!(e > 0)) {
      fmt::print(stderr, "wrlkit simplify: --error: '{}' is not a valid length\n", text);
      return std::nullopt;
    }
    o.errors.push_back(e);
  }
  o.every = static_cast<std::size_t>(f.every);
  o.counts = f.counts;
  o.ratios = f.ratios;
  return o;
}

bool write_world(Session& s, const std::string& path, const Scene& scene) {
  Saved saved;
  return write_vrml_file({scene, {}, s.context(), s.flags().save, *output_of(path), nullptr, saved});
}

/// The world as one progressive file in place of many.
int write_progressive_file(Session& s, Criterion criterion, const std::string& path) {
  const auto surfaces = progressive_surfaces(s.world().scene, criterion, s.context());
  auto file = OutputFile::open(path, {.gzip = s.flags().save.gzip, .inputs = &s.resources().files_read()}, s.diag());
  if (!file) return s.end(false);
  const auto bytes = write_progressive_world(surfaces);
  file->write(bytes);
  if (!file->commit(s.diag())) return s.end(false);
  s.progress().clear();
  if (s.flags().json) {
    std::string text;
    JsonOut json(text);
    json.begin_object();
    json.member("file", path);
    json.member("surfaces", surfaces.size());
    json.member("bytes", bytes.size());
    json.end_object();
    fmt::print("{}\n", text);
  } else {
    fmt::print("{}: {} surfaces, {} bytes\n", path, surfaces.size(), bytes.size());
  }
  return s.end(true);
}

struct Written {
  std::string file;
  InteractionPoint point;
};

void print(Session& s, std::size_t n_faces, const std::vector<Written>& files, const std::string& lod_file) {
  s.progress().clear();
  if (s.flags().json) {
    std::string text;
    JsonOut json(text);
    json.begin_object();
    json.member("triangles", n_faces);
    json.key("points");
    json.begin_array();
    for (const auto& [file, p] : files) {
      json.begin_object();
      json.member("file", file);
      json.member("triangles", p.n_faces);
      json.member("rms", p.rms);
      json.member("max", p.error);
      json.end_object();
    }
    json.end_array();
    json.member("lod", lod_file);
    json.end_object();
    fmt::print("{}\n", text);
  } else {
    fmt::print("{:>10}  {:>10}  {:>10}  file\n{:>10}  {:>10}  {:>10}\n", "triangles", "rms", "max", n_faces, 0, 0);
    for (const auto& [file, p] : files)
      fmt::print("{:>10}  {:>10.3g}  {:>10.3g}  {}\n", p.n_faces, p.rms, p.error, file);
    fmt::print("{:>46}\n", lod_file);
  }
}

/// Surfaces without loose faces; and baked light in the textures, where VRML is written for browsers.
std::string_view standard_pipeline(const Flags& flags) {
  if (flags.pipeline_given) return flags.progressive || flags.save.dump ? "lower-vrml1,lower-x3d{vrml97=true}" : "vrml";
  if (flags.progressive) return "lower-vrml1,expand,lower-x3d{vrml97=true},weld";
  return flags.save.dump ? "lower-vrml1,lower-x3d{vrml97=true},weld"
                         : "lower-vrml1,lower-x3d{vrml97=true},combine-lightmap,weld";
}

}  // namespace

int run_simplify(const Flags& flags) {
  Session s(flags);
  auto options = options_of(flags);
  if (!options || !s.good() || !s.choose_pipeline(standard_pipeline(flags))) return usage;
  if (flags.print_pipeline) {
    fmt::print("{}\n", s.pipeline().text());
    return done;
  }
  if (!s.read(flags.inputs[0]) || !s.pipeline().run(s.world().scene, s.context(), s.pipeline_options()))
    return s.end(false);

  std::error_code failed;
  fs::create_directories(flags.output, failed);
  const std::string base = (fs::path(flags.output) / stem_of(flags.inputs[0])).string(),
                    ending = flags.save.gzip ? ".wrl.gz" : ".wrl";
  if (flags.progressive)
    return write_progressive_file(s, options->collapse.criterion, base + (flags.save.gzip ? ".wpm.gz" : ".wpm"));

  const SimplifiedWorld world(s.world().scene, *options, s.context());
  if (world.n_faces() == 0) s.diag().report(Diag::not_simplified, {}, "there is no surface that may change");
  std::vector<Written> files;
  for (std::size_t i = 0; i < world.n_points(); ++i) {
    files.push_back({base + '_' + std::to_string(world.point(i).n_faces) + ending, world.point(i)});
    if (!write_world(s, files.back().file, world.scene_at(i))) return s.end(false);
  }
  const auto lod_file = base + "_lod" + ending;
  if (!write_world(s, lod_file, world.scene_with_levels())) return s.end(false);
  print(s, world.n_faces(), files, lod_file);
  return s.end(true);
}

}  // namespace wrlkit
