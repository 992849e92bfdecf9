#include "tools/cli/options.h"

#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <cmath>
#include <limits>

#include "base/math/digits.h"
#include "base/text/amounts.h"
#include "base/text/letter_case.h"
#include "base/text/nearest_name.h"
#include "convert/formats.h"
#include "convert/option_text.h"
#include "convert/profiles.h"
#include "geometry/simplify/levels.h"

namespace wrlkit::cli {
namespace {

template <Choice E>
std::string choice_fault(const std::string& text) {
  E value{};
  if (read_choice(text, value)) return "";
  NearestName nearest(text);
  for (const auto& c : choices<E>) nearest.consider(c.name);
  return "'" + text + "' is not a valid value: " + choice_type<E>() + nearest.question();
}

/// Adds options that describe themselves (convert/options.h) to a verb. A number that is 0 is not set.
struct AddOption {
  CLI::App& verb;

  void operator()(std::string_view name, bool& field, std::string_view help) const {
    verb.add_flag("--" + std::string(name), field, std::string(help));
  }
  void operator()(std::string_view name, int& field, std::string_view help, OptionNote note) const {
    auto* option = verb.add_option("--" + std::string(name), field, std::string(help));
    option->check(CLI::Range(static_cast<int>(note.range.least), static_cast<int>(note.range.most)));
    if (!note.type.empty()) option->type_name(std::string(note.type));
    if (field != 0) option->capture_default_str();
  }
  void operator()(std::string_view name, LengthOption& field, std::string_view help, OptionNote note) const {
    const auto read = [&field](const std::string& text) { field.read(text); };
    const auto fault = [](const std::string& text) {
      LengthOption length;
      return length.read(text) && length.metres > 0
                 ? ""
                 : "'" + text + "' is not a valid length: " + std::string(length_examples);
    };
    verb.add_option_function<std::string>("--" + std::string(name), read, std::string(help))
        ->type_name(std::string(note.type))
        ->check(fault, "", "");
  }
  void operator()(std::string_view name, LightmapSize& field, std::string_view help, OptionNote note) const {
    const auto read = [&field](const std::string& text) { field.read(text); };
    const auto fault = [](const std::string& text) {
      return LightmapSize().read(text) ? "" : "'" + text + "' is neither a size nor texels: 300k, 2MB, 512x512";
    };
    verb.add_option_function<std::string>("--" + std::string(name), read, std::string(help))
        ->type_name(std::string(note.type))
        ->check(fault, "", "");
  }
  void operator()(std::string_view name, GltfOrigin& field, std::string_view help, OptionNote note) const {
    const auto read = [&field](const std::string& text) { field.read(text); };
    const auto fault = [](const std::string& text) {
      return GltfOrigin().read(text) ? "" : "'" + text + "' is neither auto nor none nor three numbers: 500000,0,-20";
    };
    verb.add_option_function<std::string>("--" + std::string(name), read, std::string(help))
        ->type_name(std::string(note.type))
        ->default_str(field.print())
        ->check(fault, "", "");
  }
  template <Choice E>
  void operator()(std::string_view name, E& field, std::string_view help) const {
    const auto read = [&field](const std::string& text) { read_choice(text, field); };
    std::vector<std::string> names;
    for (const auto& c : choices<E>) names.emplace_back(c.name);
    verb.add_option_function<std::string>("--" + std::string(name), read, choice_help<E>(help))
        ->transform(CLI::Validator(
            [](std::string& text) {
              text = option_value::forgiven<E>(text);
              return choice_fault<E>(text);
            },
            "{" + CLI::detail::join(names, ",") + "}"))
        ->default_str(std::string(name_of(field)));
  }
};

std::vector<std::string> profile_names() {
  std::vector<std::string> out;
  for (const Profile& p : profiles()) out.emplace_back(p.name);
  return out;
}

/// Endings of outputs without their dots, the usual one first.
std::vector<std::string> output_kinds() {
  std::vector<std::string> out{"glb"};
  for (auto ending : output_endings())
    if (ending != ".glb") out.emplace_back(ending.substr(1));
  return out;
}

bool is_level(const std::string& s) {
  return s == "auto" || (!s.empty() && s.size() <= 3 && s.find_first_not_of("0123456789") == std::string::npos);
}

std::string memory_fault(const std::string& text) {
  constexpr std::uint64_t least = 1 << 20;
  const auto bytes = size_of(text);
  if (bytes >= least) return "";
  const bool is_number = bytes > 0 && text.find_first_not_of("0123456789.") == text.npos;
  return "'" + text + "' is not a valid size: 800M, 8G" + (is_number ? "; did you mean " + text + "G?" : "");
}

std::string tile_size_fault(const std::string& text) {
  constexpr std::uint64_t least = 1 << 10;
  return size_of(text) >= least ? "" : "'" + text + "' is not a valid size of a tile: 500K, 4M";
}

}  // namespace

void common(CLI::App& verb, Flags& f) {
  auto* g = verb.add_option_group("every verb");
  g->add_flag("-q,--quiet", f.quiet, "print only errors: no warnings, no progress");
  g->add_flag("-v,--verbose", f.verbose, "print what is being done");
  g->add_flag("--json", f.json, "print JSON");
  g->add_flag("--strict", f.load.strict, "treat every repair as an error");
  g->add_option("--report", f.report, "write all messages and figures to this file, as JSON")->type_name("FILE");
  g->add_option("--allow-path", f.load.allow_paths,
                "allow files below this folder to be read (Inlines, textures); can be repeated")
      ->type_name("DIR")
      ->allow_extra_args(false);
  g->add_flag("--strict-paths", f.strict_paths,
              "read nothing above the folder of the input except what --allow-path allows");
  g->add_option("--jobs", f.jobs, "number of threads; 0: one for each core")->check(CLI::Range(0, 1024));
  if (!verb.get_option_no_throw("--timeout")) timeout(*g, f, "stop after this time: 90s, 10m, 2h");
  g->add_option("--memory", f.memory, "stop beyond this amount of memory: 800M, 8G")
      ->type_name("SIZE")
      ->check(memory_fault, "", "");
}

CLI::Option* timeout(CLI::App& verb, Flags& f, const char* help) {
  auto fault = [](const std::string& s) {
    return seconds_of(s) > 0 ? "" : "'" + s + "' is not a valid time; 90s, 10m, 2h";
  };
  return verb.add_option("--timeout", f.timeout, help)->type_name("TIME")->check(fault, "", "");
}

void input(CLI::App& verb, Flags& f) {
  verb.add_option_function<std::string>(
          "IN", [&f](const std::string& path) { f.inputs = {path}; }, "the input file; - is standard input")
      ->required();
}

void placing(CLI::App& verb, Flags& f) { f.load.placing_fields(AddOption{verb}); }

CLI::Validator one_of(const std::vector<std::string>& names) {
  const auto fault = [names](const std::string& text) {
    if (std::ranges::find(names, text) != names.end()) return std::string();
    NearestName nearest(text);
    for (const auto& name : names) nearest.consider(name);
    return fmt::format("'{}' is not one of {}{}", text, fmt::join(names, ", "), nearest.question());
  };
  return {fault, fmt::format("{{{}}}", fmt::join(names, ","))};
}

CLI::Validator a_criterion() {
  return {[](const std::string& text) { return CriterionName::fault(text); },
          one_of(criterion_names()).get_description()};
}

CLI::Validator a_number() {
  const auto fault = [](const std::string& text) {
    double v = 0;
    return read_number(std::string_view(text), v) && std::isfinite(v) ? "" : "'" + text + "' is not a number";
  };
  return {fault, ""};
}

CLI::Validator a_number_within(double least, double most) {
  const auto fault = [=](const std::string& text) {
    double v = 0;
    if (read_number(std::string_view(text), v) && v >= least && v <= most) return std::string();
    const bool is_open = most == std::numeric_limits<double>::max();
    return fmt::format("'{}' is not a number {}", text,
                       is_open ? fmt::format("of at least {}", least) : fmt::format("from {} to {}", least, most));
  };
  const bool is_open = most == std::numeric_limits<double>::max();
  return {fault, is_open ? fmt::format("at least {}", least) : fmt::format("{} to {}", least, most)};
}

CLI::Validator a_number_above_0() {
  const auto fault = [](const std::string& text) {
    double v = 0;
    return read_number(std::string_view(text), v) && v > 0 && std::isfinite(v)
               ? ""
               : "'" + text + "' is not a number above 0";
  };
  return {fault, "above 0"};
}

CLI::Validator a_share() {
  const auto read = [](std::string& text) {
    const std::string given = text;
    const bool percent = text.ends_with('%');
    if (percent) text.pop_back();
    double v = 0;
    if (!read_number(std::string_view(text), v) || !(v > 0) || v > (percent ? 100 : 1))
      return "'" + given + "' is not a share above 0, up to 1: 0.5, 50%";
    if (percent) text = shortest_text(v / 100);
    return std::string();
  };
  return {read, "SHARE"};
}

void python(CLI::App& verb, Flags& f) {
  verb.add_option("--python", f.python,
                  "load passes written in Python from this file; can be repeated; see docs/python.md")
      ->type_name("FILE")
      ->allow_extra_args(false);
}

void pipeline(CLI::App& verb, Flags& f) {
  verb.add_option("-p,--pipeline", f.pipeline, "passes to run, or the name of a pipeline; see wrlkit passes")
      ->type_name("PASSES");
  python(verb, f);
  verb.add_flag("--print-pipeline", f.print_pipeline, "print the complete pipeline with all options, and exit");
  verb.add_flag("--verify-each", f.verify_each, "check the scene after each pass");
  verb.add_option("--print-after", f.print_after, "print the scene as VRML after this pass; all: after each pass")
      ->type_name("PASS");
  verb.add_flag("--time-passes", f.time_passes, "print how long each pass took");
  verb.add_flag("--stats", f.stats, "print the statistics of the passes");
}

void light(CLI::App& verb, Flags& f) {
  f.save.light_fields(AddOption{verb});
  f.save.baked_fields(AddOption{verb});
}

void vrml_output(CLI::App& verb, Flags& f) { f.save.text_fields(AddOption{verb}); }

void files(CLI::App& verb, Flags& f) {
  f.save.file_fields(AddOption{verb});
  verb.get_option("--link")->excludes(verb.get_option("--embed"));
}

void small_gltf(CLI::App& verb, Flags& f) {
  f.save.size_fields(AddOption{verb});
  verb.get_option("--position-bits")->excludes(verb.get_option("--tolerance"));
  const auto names = one_of(profile_names());
  verb.add_option("--profile", f.profile, "set defaults for the program that will load the file")
      ->transform(CLI::Validator(
          [names](std::string& name) {
            name = lower_case(name);
            return names(name);
          },
          names.get_description()));
}

void in_place(CLI::App& verb, Flags& f) {
  verb.add_flag("--in-place", f.load.in_place, "allow OUT to be IN, which is kept as IN.bak");
  verb.add_flag("--overwrite", f.overwrite,
                "replace files that belong to something else: buffers, pictures and copies that the OUT which is there "
                "does not refer to");
}

void method(CLI::App& verb, Flags& f) { AddOption{verb}("method", f.method, "method"); }

void level(CLI::App& verb, Flags& f) {
  verb.add_option("--level", f.level,
                  "level of each LOD, from 0 (the last, if it has fewer); auto: by distance, as browsers choose")
      ->check(
          [](const std::string& s) {
            return is_level(s) ? "" : "'" + s + "' is neither a number from 0 to 999 nor auto";
          },
          "", "")
      ->type_name("N|auto")
      ->capture_default_str();
}

void pictures(CLI::App& verb, Flags& f) {
  verb.add_option("--viewpoint", f.viewpoint, "description or DEF name of a Viewpoint")
      ->check([](const std::string& s) { return s.empty() ? "the name of a Viewpoint is missing" : ""; }, "", "");
  verb.add_flag("--fit", f.fit, "show the whole scene instead of using a Viewpoint");
  verb.add_option("--look-at", f.look_at, "eye, target and up vector: nine numbers")
      ->expected(9)
      ->delimiter(',')
      ->check(a_number());
  verb.add_option("--background", f.background, "background colour: three numbers from 0 to 1")
      ->expected(3)
      ->delimiter(',')
      ->check(a_number_within(0, 1));
  AddOption{verb}("headlight", f.headlight, "light at the camera");
  verb.add_option("--field-of-view", f.field_of_view, "field of view along the shorter side of the picture, in degrees")
      ->check(a_number_within(0.1, 179));
  AddOption{verb}("mode", f.mode, "what is drawn");
  AddOption{verb}("lamps", f.lamps, "--mode path: how the light of PointLights and SpotLights decreases with distance");
  verb.add_option("--exposure", f.exposure,
                  "--mode path: factor for the light; auto: a factor that gives middle grey, which is reported")
      ->check(
          [](const std::string& text) {
            return Exposure().read(text) ? "" : "'" + text + "' is neither auto nor a factor above 0";
          },
          "", "")
      ->type_name("auto|FACTOR")
      ->capture_default_str();
}

void format(CLI::App& verb, Flags& f, const std::string& help) {
  verb.add_option("--format", f.format, help)->check(one_of(output_kinds()))->capture_default_str();
}

void globs(CLI::App& verb, Flags& f) {
  verb.add_option("--include", f.include, "read only matching files of folders: '*.wrl', 'unit_1/**'")
      ->type_name("GLOB");
  verb.add_option("--exclude", f.exclude, "skip matching files of folders")->type_name("GLOB");
}

void tiles(CLI::App& verb, Flags& f) {
  verb.add_option(
          "-p,--pipeline", f.pipeline,
          "passes that each file goes through before it is cut, by itself: lightmap bakes its light; see wrlkit "
          "passes")
      ->type_name("PASSES");
  python(verb, f);
  verb.add_option(
          "--shard", f.shard,
          "share of one of several processes that make a set together in one folder: 2/8 is the second of eight; "
          "auto, auto/8: from the environment of Slurm or Kubernetes; the last process writes tileset.json")
      ->type_name("I/N");
  verb.add_flag("--update", f.update,
                "make only tiles whose parts have changed since the last run with --update, which keeps its results in "
                "DIR/.wrlkit; the bytes are those of a new run");
  verb.add_option("--tile-triangles,--triangles", f.tile_triangles, "maximum number of triangles in a tile")
      ->check(CLI::Range(100, 10'000'000))
      ->capture_default_str();
  verb.add_option(
          "--tile-draws", f.tile_draws,
          "maximum number of draw calls of a tile: if it has more materials, those that differ only in colour become "
          "vertex colours")
      ->check(CLI::Range(1, 100'000))
      ->capture_default_str();
  verb.add_option("--tile-bytes", f.tile_bytes,
                  "maximum size of a tile: 500K, 4M; coarse tiles get smaller pictures if necessary")
      ->type_name("SIZE")
      ->check(tile_size_fault, "", "")
      ->capture_default_str();
  verb.add_option("--tileset-tiles", f.tileset_tiles,
                  "maximum number of tiles in tileset.json; the rest is in files next to the tiles, loaded on demand")
      ->check(CLI::Range(1, 1'000'000'000))
      ->capture_default_str();
  verb.add_option("--at", f.at,
                  "position of the origin on the Earth: latitude and longitude in degrees, metres above the ellipsoid, "
                  "and optionally the heading of -z, in degrees from north towards east")
      ->delimiter(',')
      ->check(a_number())
      ->type_name("LAT,LON,HEIGHT[,HEADING]");
  constexpr std::string_view of_content[] = {"compress",       "tolerance",       "draco-level",
                                             "texture-format", "texture-quality", "texture-size"};
  f.save.size_fields([&](std::string_view name, auto& field, auto&&... about) {
    if (std::ranges::find(of_content, name) != std::end(of_content)) AddOption{verb}(name, field, about...);
  });
  verb.get_option("--compress")->default_str("meshopt");
  verb.add_flag("--gpu-instancing,!--no-gpu-instancing", f.save.gpu_instancing,
                "store a surface that occurs several times in a tile once, with a table of places "
                "(EXT_mesh_gpu_instancing), where that saves bytes within the draw calls; the default");
}

void corpus_inputs(CLI::App& verb, Flags& f) {
  verb.add_option("RECIPE", f.recipe, "the recipe; see docs/recipes.md")->required();
  verb.add_option("IN", f.inputs,
                  "scenes, folders, globs, @FILE (a list of scenes); - is such a list on standard input")
      ->required();
  verb.add_option("-o,--output", f.output, "output folder, with the same tree as the input")
      ->required()
      ->type_name("DIR");
  format(verb, f, "format of the outputs");
  globs(verb, f);
  verb.add_option("--base", f.base,
                  "folder below which the outputs of lists keep their paths; default: the current one")
      ->type_name("DIR");
  verb.add_option("--shard", f.shard,
                  "process only a share of the files: 2/8 is the second of eight; auto, auto/8: from the environment "
                  "of Slurm or "
                  "Kubernetes")
      ->type_name("I/N");
}

}  // namespace wrlkit::cli
