// wrlkit simplify: the world at falling numbers of triangles, one file each, and one file with all of them as levels of
// detail: the interaction points of Lazanyi, 2.3. Or one file of any format; or one progressive file.
#include <fmt/format.h>

#include <algorithm>
#include <cctype>
#include <filesystem>
#include <iterator>
#include <optional>
#include <set>

#include "base/io/output.h"
#include "base/silent_task.h"
#include "base/text/json.h"
#include "convert/geometry_census.h"
#include "convert/missing_files.h"
#include "convert/placing.h"
#include "convert/save.h"
#include "convert/world_meshes.h"
#include "convert/writing.h"
#include "geometry/progressive/progressive_world.h"
#include "geometry/simplify/world_levels.h"
#include "passes/analysis/text_list.h"
#include "passes/expand/expand.h"
#include "passes/expand_protos/expand_protos.h"
#include "passes/lod/first_levels.h"
#include "scenegraph/walk.h"
#include "tools/cli/lengths.h"
#include "tools/cli/print_diagnostics.h"
#include "tools/cli/session.h"
#include "tools/verbs/convert.h"

namespace wrlkit {
namespace {

namespace fs = std::filesystem;

/// The name of the input without folder and endings: "plant" of "old/plant.wrl.gz".
std::string stem_of(const std::string& path) {
  auto name = fs::path(path).filename().string();
  name.resize(name.size() - ending_of(name, scene_endings()).size());
  return name == "-" ? "world" : name;
}

/// "pump.wpm", "pump.wpm.gz".
bool is_stream(const std::string& path) { return path.ends_with(".wpm") || path.ends_with(".wpm.gz"); }

/// The name of a file, as it seems, of a format that is not written: "levels.stl".
bool is_of_no_output(const std::string& path) {
  const auto ending = fs::path(path).extension().string();
  const bool is_like_one =
      !ending_of(path, scene_endings()).empty() ||
      (ending.size() >= 4 && ending.size() <= 5 && std::isalpha(static_cast<unsigned char>(ending[1])) != 0);
  return is_like_one && !output_of(path) && !fs::is_directory(path) && path.back() != '/';
}

/// What the flags ask for; nothing when they make no sense, which was printed.
std::optional<WorldSimplifyOptions> world_options_of(const Flags& f) {
  WorldSimplifyOptions o;
  CriterionName criterion;
  if (!f.criterion.empty()) criterion.read(f.criterion);
  o.collapse.criterion = criterion.value;
  o.budget.pixels = f.pixels;
  const int n = (f.every > 0) + !f.counts.empty() + !f.ratios.empty() + !f.errors.empty() + f.progressive;
  if (n != 1) {
    fmt::print(stderr, "wrlkit simplify: {} of --every, --counts, --ratios, --error and --progressive {}\n",
               n > 1 ? "only one" : "one", n > 1 ? "can be used" : "is needed");
    return std::nullopt;
  }
  if (f.progressive && !info(criterion.value).keeps_record) {
    fmt::print(stderr, "wrlkit simplify: --progressive: {} keeps no record of its steps\n", criterion.print());
    return std::nullopt;
  }
  if (f.progressive && output_of(f.output)) {
    fmt::print(stderr, "wrlkit simplify: --progressive writes a .wpm file, or one into a folder, not '{}'\n", f.output);
    return std::nullopt;
  }
  if (!(f.progressive && is_stream(f.output)) && is_of_no_output(f.output)) {
    fmt::print(stderr, "wrlkit simplify: -o: '{}': its name should end in {}, or be that of a folder\n", f.output,
               output_endings_text());
    return std::nullopt;
  }
  for (const auto& text : f.errors) {
    const double e = length_of(text);
    if (!(e > 0)) {
      fmt::print(stderr, "wrlkit simplify: --error: '{}' is not a length above 0, such as 2mm, 0.5in or 0.002\n", text);
      return std::nullopt;
    }
    o.errors.push_back(e);
  }
  o.every = static_cast<std::size_t>(f.every);
  o.counts = f.counts;
  o.ratios = f.ratios;
  return o;
}

/// `files_folder`: that all of the scenes refer to.
bool write_world(Session& s, const std::string& path, const Scene& scene, const std::string& files_folder) {
  Saved saved;
  SaveOptions options = s.flags().save;
  options.files_folder = files_folder;
  options.is_derived = true;
  return write_vrml_file({scene, {}, s.context(), options, *output_of(path), nullptr, saved});
}

/// The world as one progressive file in place of many.
int write_progressive_file(Session& s, Criterion criterion, const std::string& path) {
  const auto surfaces = progressive_surfaces(s.world().scene, criterion, s.context());
  if (surfaces.empty()) {
    s.diag().report(Diag::nothing_drawn, {}, "it has no surface, and a progressive stream holds nothing else");
    return s.end(false);
  }
  auto file = OutputFile::open(path, {.gzip = s.flags().save.gzip, .inputs = s.files_read(), .report_replaced = true},
                               s.diag());
  if (!file) return s.end(false);
  const auto bytes = write_progressive_world(surfaces);
  file->write(bytes);
  if (!file->commit(s.diag())) return s.end(false);
  s.progress().clear();
  if (s.flags().json) {
    s.print_json(wrlkit::json_of(json_object("file", path, "surfaces", surfaces.size(), "bytes", bytes.size())));
  } else {
    fmt::print("{}: {}, {} bytes\n", path, counted(surfaces.size(), "surface"), bytes.size());
  }
  return s.end(true);
}

struct Written {
  std::string file;
  std::size_t n_drawn = 0, n_faces = 0, n_gone = 0;
  double rms = 0, max = 0;
};

/// What was made: the scenes by falling numbers of triangles, and the one of all levels.
struct WrittenWorlds {
  std::size_t n_drawn = 0, n_faces = 0;
  std::vector<Written> points;
  std::string lod_file;
  bool is_opened = false;   // prototypes and LODs are replaced by what they show
  std::size_t n_texts = 0;  // that are faces in some of them
};

/// A number of triangles that was asked for, and that of the scene which was made for it.
struct Asked {
  std::size_t triangles = 0, reached = 0;

  void fields(auto&& f) const {
    f("triangles", triangles);
    f("reached", reached);
  }
};

std::vector<Asked> asked_of(const WorldSimplifyOptions& options, const WrittenWorlds& all) {
  std::vector<Asked> out;
  const auto fewest = all.points.empty() ? all.n_drawn : all.points.back().n_drawn;
  for (const auto count : counts_of(options, all.n_drawn)) {
    const auto point = std::ranges::find_if(all.points, [&](const Written& p) { return p.n_drawn <= count; });
    out.push_back({count, point == all.points.end() ? fewest : point->n_drawn});
  }
  return out;
}

std::string json_of(const WorldSimplifyOptions& options, const WrittenWorlds& all) {
  return json_text([&](JsonOut& json) {
    json.object([&] {
      json.members("triangles", all.n_drawn, "unique", all.n_faces);
      json.list("points", all.points, [&](const auto& p) {
        json.object("file", p.file, "triangles", p.n_drawn, "unique", p.n_faces, "left_out", p.n_gone, "rms", p.rms,
                    "max", p.max);
      });
      json.member("asked", asked_of(options, all));
      if (!all.lod_file.empty()) json.member("lod", all.lod_file);
      json.members("expanded", all.is_opened, "texts_as_faces", all.n_texts);
    });
  });
}

/// Numbers of triangles that were missed by a twentieth of them and a fiftieth of all.
void print_missed(const WorldSimplifyOptions& options, const WrittenWorlds& all) {
  const auto share = [&](std::size_t n) {
    return fmt::format("{} ({:.3g} %)", n, 100 * static_cast<double>(n) / static_cast<double>(all.n_drawn));
  };
  for (const auto& [asked, reached] : asked_of(options, all)) {
    const bool fewer = reached < asked;
    const auto apart = fewer ? asked - reached : reached - asked;
    if (apart * 20 < asked || apart * 50 < all.n_drawn) continue;
    fmt::print("asked for {} triangles, reached {}: {}\n", share(asked), share(reached),
               fewer ? "the next finer choice of levels has more than were asked for"
                     : "no more can go without losing whole parts or what may not change");
  }
}

void print_table(const WorldSimplifyOptions& options, const WrittenWorlds& all) {
  fmt::print("{:>10}  {:>10}  {:>8}  {:>10}  {:>10}  file\n", "triangles", "unique", "left out", "rms", "max");
  fmt::print("{:>10}  {:>10}  {:>8}  {:>10}  {:>10}\n", all.n_drawn, all.n_faces, 0, 0, 0);
  for (const auto& p : all.points)
    fmt::print("{:>10}  {:>10}  {:>8}  {:>10.3g}  {:>10.3g}  {}\n", p.n_drawn, p.n_faces, p.n_gone, p.rms, p.max,
               p.file);
  if (!all.lod_file.empty()) fmt::print("{:>68}\n", all.lod_file);
  if (all.is_opened)
    fmt::print(
        "to have few enough triangles, prototypes and LODs were replaced by what they show (not with -p weld)\n");
  if (all.n_texts > 0) fmt::print("texts that became faces, and can no longer be searched: {}\n", all.n_texts);
  print_missed(options, all);
}

/// Triangles of a scene as `info` counts them.
struct TriangleCounts {
  std::size_t drawn = 0, unique = 0;
};

/// Nothing is reported, nor will it be when it is asked for again: for after the passes have run.
TriangleCounts counted_triangles(Document& from, Scene scene, const LoadOptions& load = {}) {
  Diagnostics unheard(from.diag().shared_sources());
  Statistics uncounted;
  Document silent({.scene = std::move(scene)}, PassContext{unheard, uncounted, from.resources()});
  if (load.show_all) expand(silent.scene(), {}, silent.context());
  if (load.show_all) show_all(silent.scene());
  if (load.run_startup) run_startup(silent.scene(), silent.context());
  const WorldMeshes meshes(silent);
  if (!meshes.good()) return {};
  const auto census = count_geometry(silent.scene(), meshes.triangles, meshes.triangles);
  return {census.triangles, census.unique};
}

void add_points(const WorldLevels& world, WrittenWorlds& all) {
  for (const auto& p : world.points()) all.points.push_back({{}, 0, 0, p.n_gone, p.rms, p.max});
  all.n_texts = world.n_texts_as_faces();
}

void add_points(const SimplifiedWorld& world, WrittenWorlds& all) {
  for (std::size_t i = 0; i < world.n_points(); ++i)
    all.points.push_back({{}, 0, 0, 0, world.point(i).rms, world.point(i).error});
}

/// Where the scenes go: NAME_TRIANGLES.wrl, and NAME_lod.wrl; or one file.
struct Names {
  std::string base, ending;
  std::string file = {};
};

/// Names that levels do not have: those of the geometry of parts that were left out.
class LostNames {
 public:
  explicit LostNames(const Scene& scene) : all_(names_of(scene)) {}
  void look_at(const Scene& level) {
    const auto there = names_of(level);
    std::ranges::set_difference(all_, there, std::inserter(lost_, lost_.end()));
  }
  void report(Diagnostics& diag) const {
    TextList list;
    for (const auto& name : lost_) list.add(name);
    if (!list.empty()) diag.report(Diag::names_lost, {}, "simplify", list.count(), list.text());
  }

 private:
  using Names = std::set<std::string>;
  static Names names_of(const Scene& scene) {
    Names out;
    for (const NodeId n : reachable(scene, scene.main))
      if (!scene.name(n).empty()) out.emplace(scene.name(n));
    return out;
  }
  Names all_, lost_;
};

/// The scene of a point, whose triangles are counted.
template <class World>
Scene level_of(Session& s, const World& world, std::size_t point, WrittenWorlds& all) {
  Scene level = world.scene_at(point);
  const auto counted = counted_triangles(s.document(), level);
  all.points[point].n_drawn = counted.drawn;
  all.points[point].n_faces = counted.unique;
  return level;
}

/// One point is the scene itself, several are levels of detail, of which the first has all names. The format is that
/// of the file's name.
template <class World>
bool write_one_file(Session& s, const World& world, const std::string& file, WrittenWorlds& all) {
  Document document({.scene = {}}, s.context());
  for (std::size_t i = 0; i < all.points.size(); ++i) document.scene() = level_of(s, world, i, all);
  if (all.points.size() == 1) {
    all.points[0].file = file;
    LostNames lost(s.world().scene);
    lost.look_at(document.scene());
    lost.report(s.diag());
  } else {
    all.lod_file = file;
    document.scene() = world.scene_with_levels();
  }
  return bool(save(std::move(document), file, s.flags().save));
}

template <class World>
bool write_worlds(Session& s, const World& world, const Names& names, WrittenWorlds& all) {
  add_points(world, all);
  if (!names.file.empty()) return write_one_file(s, world, names.file, all);
  const auto folder = std::filesystem::path(names.base).filename().string() + "_files";
  LostNames lost(s.world().scene);
  for (std::size_t i = 0; i < all.points.size(); ++i) {
    const Scene level = level_of(s, world, i, all);
    lost.look_at(level);
    auto& p = all.points[i];
    p.file = names.base + '_' + std::to_string(p.n_drawn) + names.ending;
    if (!write_world(s, p.file, level, folder)) return false;
  }
  lost.report(s.diag());
  all.lod_file = names.base + "_lod" + names.ending;
  return write_world(s, all.lod_file, world.scene_with_levels(), folder);
}

/// Instances of prototypes replaced by their bodies; nothing when there are none, or too many.
std::optional<Scene> expanded_scene(Session& s) {
  Scene out = s.world().scene;
  Statistics uncounted;
  PassContext ctx(s.diag(), uncounted, &s.resources());
  if (expand_protos(out, {}, ctx) == Outcome::unchanged || s.diag().count(Diag::expansion_limit) > 0)
    return std::nullopt;
  return out;
}

/// Replaces instances of prototypes by their bodies, which `expanded` has, and LODs by their first levels: they are
/// Shapes as others then. False when there are none.
bool open_up(Session& s, std::optional<Scene>& expanded) {
  Scene opened = expanded ? std::move(*expanded) : s.world().scene;
  if (keep_first_levels(opened) == 0 && !expanded) return false;
  s.world().scene = std::move(opened);
  std::string why;
  Diagnostics unheard(s.diag().shared_sources());  // the same was welded before
  PassContext ctx(unheard, s.context().stats, &s.resources());
  return Pipeline::parse("weld", why)->run(s.world().scene, ctx, {});
}

/// Whether the last world has as few triangles as were asked for.
bool is_reached(const SimplifiedWorld& world, const WorldSimplifyOptions& options) {
  const auto counts = counts_of(options, options.drawn > 0 ? options.drawn : world.n_faces());
  return counts.empty() || (world.n_points() > 0 && world.point(world.n_points() - 1).n_faces <= counts.back());
}

/// Numbers of triangles that the world has no more of.
void warn_of_idle_counts(const Flags& flags, const WrittenWorlds& all) {
  for (const auto count : flags.counts)
    if (count >= all.n_drawn)
      fmt::print(stderr, "wrlkit simplify: --counts {} has no effect: the world has {} triangles\n", count,
                 all.n_drawn);
  if (!all.points.empty() || all.n_drawn == 0) return;
  if (static_cast<std::size_t>(flags.every) >= all.n_drawn)
    fmt::print(stderr, "wrlkit simplify: --every {} has no effect: the world has {} triangles\n", flags.every,
               all.n_drawn);
  if (!flags.ratios.empty() && std::ranges::all_of(flags.ratios, [](double r) { return r >= 1; }))
    fmt::print(stderr, "wrlkit simplify: --ratios has no effect: levels of all triangles are the world itself\n");
}

/// As one scene with one budget where there are several parts and the triangles are counted; otherwise each
/// surface for itself, unless the criterion does not go as far as was asked.
bool simplify_world(Session& s, WorldSimplifyOptions& options, const Names& names, WrittenWorlds& all) {
  const Scene& scene = s.world().scene;
  SilentTask silent(s.context());
  std::optional<Scene> expanded = expanded_scene(s);
  options.expanded = expanded ? &*expanded : nullptr;
  bool is_missed = false;
  std::size_t n_drawn_once = 0;  // triangles, where all surfaces are drawn, each in one place
  if (options.errors.empty()) {
    options.text = OfText::take;
    options.drawn = all.n_drawn;
    const WorldLevels world(scene, options, silent);
    if (world.n_drawn() > WorldLevels::most_drawn)
      s.diag().report(Diag::not_simplified, {},
                      fmt::format("a world of more than {} triangles as a whole, but each surface by itself",
                                  WorldLevels::most_drawn));
    is_missed = world.missed().has_value();
    n_drawn_once = world.is_drawn_once() ? world.n_faces() : 0;
    if (is_missed && !s.flags().pipeline_given && open_up(s, expanded)) {
      all.is_opened = true;
      return simplify_world(s, options, names, all);
    }
    if (world.n_parts() > 1) {
      world.report_missed(s.diag());  // first: of many messages of a kind the first ones are shown
      surfaces_of(scene, report_not_simplified(scene, s.diag()), BelowLod::leave_levels, OfText::take);
      return write_worlds(s, world, names, all);
    }
  }
  auto of_surfaces = options;
  if (n_drawn_once == 0) of_surfaces.drawn = 0;
  const SimplifiedWorld world(scene, of_surfaces, s.context());
  if (world.n_faces() == 0 && !options.errors.empty() && !s.flags().pipeline_given && open_up(s, expanded)) {
    all.is_opened = true;
    return simplify_world(s, options, names, all);
  }
  if (world.n_faces() == 0) s.diag().report(Diag::not_simplified, {}, "there is no surface that may change");
  if (options.errors.empty() && world.n_faces() > 0 &&
      (is_missed || !is_reached(world, of_surfaces) || n_drawn_once != world.n_faces())) {
    options.one_part = true;
    const WorldLevels farther(scene, options, silent);
    farther.report_missed(s.diag());
    if (!farther.points().empty()) return write_worlds(s, farther, names, all);
  }
  return write_worlds(s, world, names, all);
}

/// What Inlines show, surfaces without loose faces; and baked light in the textures, where VRML is written for
/// browsers.
std::string_view standard_pipeline(const Flags& flags) {
  if (flags.pipeline_given) return flags.progressive || flags.save.dump ? "lower-vrml1,lower-x3d{vrml97=true}" : "vrml";
  if (flags.progressive) return "lower-vrml1,expand,lower-x3d{vrml97=true},weld";
  if (const auto to = output_of(flags.output); to && to->format->parsed != Format::vrml97)
    return "lower-vrml1,inline,lower-x3d,join{loose=true},weld";  // the format keeps more than VRML97 does
  return flags.save.dump ? "lower-vrml1,inline,lower-x3d{vrml97=true},join{loose=true},weld"
                         : "lower-vrml1,inline,lower-x3d{vrml97=true},combine-lightmap,join{loose=true},weld";
}

/// The names that --output asks for; makes its folder when it is one.
Names names_of(const Flags& flags) {
  if (output_of(flags.output)) return {{}, {}, flags.output};
  if (flags.progressive && is_stream(flags.output)) return {flags.output, {}};
  std::error_code failed;  // the first file that is written there says why
  fs::create_directories(flags.output, failed);
  const std::string ending = flags.progressive ? ".wpm" : ".wrl";
  const auto base = fs::path(flags.output) / stem_of(flags.inputs[0]);
  return {base.string(), flags.save.gzip ? ending + ".gz" : ending};
}

}  // namespace

int run_simplify(const Flags& flags) {
  Session s(flags);
  auto options = world_options_of(flags);
  if (!options || !s.good() || !s.choose_pipeline(standard_pipeline(flags))) return usage;
  if (s.printed_pipeline()) return done;
  if (output_of(flags.output)) warn_of_idle_options(flags);
  if (!s.read(flags.inputs[0])) return s.end(false);
  Document as_read(s.document().copy());
  if (!s.pipeline().run(s.world().scene, s.context(), s.pipeline_options())) return s.end(false);

  const Names names = names_of(flags);
  if (flags.progressive) return write_progressive_file(s, options->collapse.criterion, names.base + names.ending);
  if (names.file.empty()) report_missing_parts(s.world().scene, s.resources(), s.diag());  // as save() does
  WrittenWorlds all;
  const auto first = counted_triangles(as_read, as_read.scene(), s.flags().load);
  all.n_drawn = first.drawn;
  all.n_faces = first.unique;
  s.progress().begin("simplifying", 0, "");
  if (!simplify_world(s, *options, names, all)) return s.end(false);
  if (all.n_drawn == 0) s.diag().report(Diag::nothing_drawn, {}, "it has no surface to simplify");
  s.progress().clear();
  warn_of_idle_counts(flags, all);
  if (flags.json)
    s.print_json(json_of(*options, all));
  else if (names.file != "-")
    print_table(*options, all);
  return s.end(true, nothing, all.n_drawn == 0 ? partly : done);
}

}  // namespace wrlkit
