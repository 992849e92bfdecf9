// Every verb and flag with its help. The only file that knows CLI11.
#include "tools/cli/cli.h"

#include <sys/resource.h>

#include <CLI/CLI.hpp>
#include <cstdio>
#include <memory>

#include "convert/formats.h"
#include "convert/profiles.h"
#include "geometry/simplify/levels.h"
#include "tools/cli/outputs.h"
#include "tools/cli/python_passes.h"
#include "tools/cli/recipe.h"

#ifndef WRLKIT_VERSION
#define WRLKIT_VERSION "unknown"
#endif

namespace wrlkit {
namespace {

// -Werror=NAME and -Wno-NAME look like bundled short flags to CLI11; they are taken out before.
std::vector<std::string> take_warning_flags(std::vector<std::string>& words) {
  std::vector<std::string> out;
  std::erase_if(words, [&](const std::string& w) {
    const bool is_one = w.starts_with("-W") && w.size() > 2;
    if (is_one) out.push_back(w.substr(2));
    return is_one;
  });
  return out;
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
      return length.read(text) && length.metres > 0 ? "" : "'" + text + "' is no length";
    };
    verb.add_option_function<std::string>("--" + std::string(name), read, std::string(help))
        ->type_name(std::string(note.type))
        ->check(fault, "", "");
  }
  template <Choice E>
  void operator()(std::string_view name, E& field, std::string_view help) const {
    choice("--" + std::string(name), field, help)->default_str(std::string(name_of(field)));
  }
  template <Choice E>
  CLI::Option* choice(const std::string& name, E& field, std::string_view help) const {
    const auto read = [&field](const std::string& text) { read_choice(text, field); };
    std::vector<std::string> names;
    for (const auto& c : choices<E>) names.emplace_back(c.name);
    return verb.add_option_function<std::string>(name, read, choice_help<E>(help))->check(CLI::IsMember(names));
  }
};

void common(CLI::App& verb, Flags& f) {
  auto* g = verb.add_option_group("every verb");
  g->add_flag("-q,--quiet", f.quiet, "print no warnings and no progress, only errors");
  g->add_flag("-v,--verbose", f.verbose, "print what is done");
  g->add_flag("--json", f.json, "print for machines");
  g->add_flag("--strict", f.load.strict, "every repair is an error");
  g->add_option("--report", f.report, "write what happened to this file, as JSON")->type_name("FILE");
  g->add_option("--allow-path", f.load.allow_paths, "files below this folder may be read, too (Inline, textures)")
      ->type_name("DIR")
      ->allow_extra_args(false);
  g->add_option("--jobs", f.jobs, "threads; 0: all cores")->check(CLI::Range(0, 1024));
  g->add_option("--memory", f.memory, "give up beyond that much memory: 800M, 8G")
      ->type_name("SIZE")
      ->check([](const std::string& s) { return size_of(s) ? "" : "'" + s + "' is no size"; }, "", "");
}

void input(CLI::App& verb, Flags& f) {
  verb.add_option_function<std::string>(
          "IN", [&f](const std::string& path) { f.inputs = {path}; }, "the world; - is standard input")
      ->required();
}

void placing(CLI::App& verb, Flags& f) { f.load.placing_fields(AddOption{verb}); }

/// One of the names; of a criterion that this build does without, the reason.
CLI::Validator a_criterion() {
  const CLI::Validator member = CLI::IsMember(criterion_names());
  return {[member](std::string& text) {
            const auto missing = CriterionName::missing(text);
            return missing.empty() ? member(text) : missing;
          },
          member.get_description()};
}

void python(CLI::App& verb, Flags& f) {
  verb.add_option("--python", f.python,
                  "a file with passes in Python, which then have a name like all others; see docs/python.md")
      ->type_name("FILE")
      ->allow_extra_args(false);
}

void pipeline(CLI::App& verb, Flags& f) {
  verb.add_option("-p,--pipeline", f.pipeline, "passes to run, or the name of a pipeline; see wrlkit passes")
      ->type_name("PASSES");
  python(verb, f);
  verb.add_flag("--print-pipeline", f.print_pipeline, "print the whole pipeline with all options, and end");
  verb.add_flag("--verify-each", f.verify_each, "check the scene after each pass");
  verb.add_option("--print-after", f.print_after, "print the scene as VRML after this pass, or after all")
      ->type_name("PASS");
  verb.add_flag("--time-passes", f.time_passes, "print how long each pass took");
  verb.add_flag("--stats", f.stats, "print what the passes counted");
}

void vrml_output(CLI::App& verb, Flags& f) { f.save.text_fields(AddOption{verb}); }

std::vector<std::string> profile_names() {
  std::vector<std::string> out;
  for (const Profile& p : profiles()) out.emplace_back(p.name);
  return out;
}

void small_gltf(CLI::App& verb, Flags& f) {
  f.save.size_fields(AddOption{verb});
  verb.get_option("--position-bits")->excludes(verb.get_option("--tolerance"));
  verb.add_option("--profile", f.profile, "who is to open it decides what is not said otherwise")
      ->check(CLI::IsMember(profile_names()));
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

void pictures(CLI::App& verb, Flags& f) {
  verb.add_option("--viewpoint", f.viewpoint, "description or DEF name of a Viewpoint");
  verb.add_flag("--fit", f.fit, "look at the whole world, not from a Viewpoint");
  verb.add_option("--look-at", f.look_at, "eye, target and up: nine numbers")->expected(9)->delimiter(',');
  verb.add_option("--background", f.background, "colour instead of the world's background: three numbers from 0 to 1")
      ->expected(3)
      ->delimiter(',');
  AddOption{verb}("headlight", f.headlight, "a light where the viewer is");
  verb.add_option("--field-of-view", f.field_of_view, "of the shorter side of the picture, in degrees")
      ->check(CLI::Range(0.0, 179.0));
  AddOption{verb}("mode", f.mode, "how it is drawn");
}

void corpus_inputs(CLI::App& verb, Flags& f) {
  verb.add_option("RECIPE", f.recipe, "a recipe; see docs/recipes.md")->required();
  verb.add_option("IN", f.inputs, "folders, globs, worlds, @FILE: a list of worlds; -: such a list on standard input")
      ->required();
  verb.add_option("-o,--output", f.output, "folder for the outputs, which stand in it as the inputs in theirs")
      ->required()
      ->type_name("DIR");
  verb.add_option("--format", f.format, "ending of the outputs")
      ->check(CLI::IsMember(output_kinds()))
      ->capture_default_str();
  verb.add_option("--include", f.include, "of folders, only files like these: '*.wrl', 'unit_1/**'")->type_name("GLOB");
  verb.add_option("--exclude", f.exclude, "of folders, no files like these")->type_name("GLOB");
  verb.add_option("--base", f.base,
                  "files of lists stand in the output as below this folder; else as below the current one")
      ->type_name("DIR");
  verb.add_option(
          "--shard", f.shard,
          "only a part of the files: 2/8, the second of eight; auto, auto/8: by the environment of Slurm or Kubernetes")
      ->type_name("I/N");
}

void in_place(CLI::App& verb, Flags& f) {
  verb.add_flag("--in-place", f.load.in_place, "OUT may be IN, which is then kept as IN.bak");
}

struct Verb {
  const char *name, *help, *example;
  void (*flags)(CLI::App&, Flags&);
  int (*run)(const Flags&);
  const char* endings = "";  // of outputs that have one format only, with blanks between them
};

const Verb verbs[] = {
    {"convert", "convert a world; the name of OUT decides the format",
     "wrlkit convert plant.wrl plant.glb\n  wrlkit convert plant.wrl small.glb --compress meshopt --tolerance 1mm\n  "
     "wrlkit convert old.wrl.gz new.wrl -p inline,expand-protos --gzip",
     [](CLI::App& v, Flags& f) {
       input(v, f);
       v.add_option("OUT", f.output, "the output; its name ends in " + output_endings_text())->required();
       pipeline(v, f);
       v.add_option("--recipe", f.recipe,
                    "passes and options from a recipe, as far as they are not given here; see docs/recipes.md")
           ->type_name("FILE");
       v.add_flag("--print-recipe", f.print_recipe, "print the whole pipeline and all options as a recipe, and end");
       f.save.light_fields(AddOption{v});
       small_gltf(v, f);
       placing(v, f);
       vrml_output(v, f);
       in_place(v, f);
     },
     run_convert},
    {"optimize",
     "a small glTF file: equal parts shared, vertices in as few bits as a tolerance allows, packed; names and parts "
     "stay",
     "wrlkit optimize plant.wrl plant.glb\n  wrlkit optimize plant.wrl plant.glb --profile cesium --tolerance 2mm "
     "--json\n  wrlkit optimize --profile unity --print-profile",
     [](CLI::App& v, Flags& f) {
       input(v, f);
       v.get_option("IN")->required(false);
       v.add_option("OUT", f.output, "file.glb or .gltf");
       v.add_flag("--print-profile", f.print_profile, "print what the profile chooses, and end");
       pipeline(v, f);
       small_gltf(v, f);
       placing(v, f);
       in_place(v, f);
     },
     run_optimize},
    {"info", "what is inside: nodes, triangles, bounds, textures, lights", "wrlkit info plant.wrl --json",
     [](CLI::App& v, Flags& f) {
       input(v, f);
       placing(v, f);
     },
     run_info},
    {"check", "faults and doubtful places of worlds", "wrlkit check *.wrl",
     [](CLI::App& v, Flags& f) {
       v.add_option("IN", f.inputs, "worlds")->required();
       v.add_flag("--parse-only", f.parse_only, "only read them: no values checked, no Inlines followed");
     },
     run_check},
    {"cat", "the world as canonical VRML text", "wrlkit cat plant.wrl.gz | less",
     [](CLI::App& v, Flags& f) {
       input(v, f);
       v.add_option("-o,--output", f.output, "file instead of standard output");
       pipeline(v, f);
       vrml_output(v, f);
     },
     run_cat, ".wrl .wrz .wrl.gz .vrml"},
    {"diff",
     "how two worlds differ: structure, names, materials, and the distance of their surfaces; exit code 0 when they "
     "do, too",
     "wrlkit diff plant.wrl simpler.wrl\n  wrlkit diff plant.wrl simpler.wrl --json",
     [](CLI::App& v, Flags& f) {
       for (const char* name : {"A", "B"})
         v.add_option_function<std::string>(
              name, [&f](const std::string& path) { f.inputs.push_back(path); }, "a world; - is standard input")
             ->required();
       placing(v, f);
     },
     run_diff},
    {"render", "a picture of the world, without a display; of two worlds and how they differ; of many worlds",
     "wrlkit render plant.wrl plant.png --viewpoint Overview\n  wrlkit render plant.wrl apart.png --compare "
     "simpler.wrl\n  wrlkit render valve.wrl valve.webp --turntable 36\n  wrlkit render old/ new/pump.wrl sheet.png",
     [](CLI::App& v, Flags& f) {
       v.add_option_function<std::vector<std::string>>(
            "IN",
            [&f](const std::vector<std::string>& files) {
              f.inputs.assign(files.begin(), files.end() - 1);
              f.output = files.back();
            },
            "the world, and the picture: file.png, .jpg or .webp; of several worlds, folders of worlds, globs or "
            "@FILE, a list of worlds, it is a contact sheet with a picture each")
           ->required()
           ->expected(2, 1'000'000)
           ->type_name("... OUT");
       v.add_option(
            "--compare", f.compare,
            "another world: both from where the first is seen, and how the pictures differ, brighter than it is")
           ->type_name("FILE");
       v.add_option("--turntable", f.turntable,
                    "so many pictures around the middle of the world: OUT_000.png, OUT_001.png, ..., or of OUT.webp "
                    "one animation")
           ->check(CLI::Range(1, 3600))
           ->type_name("N");
       v.add_option("--width", f.width, "pixels; in a contact sheet 320 when it is not said")
           ->check(CLI::Range(1, 16384))
           ->capture_default_str();
       v.add_option("--height", f.height, "pixels; in a contact sheet 240 when it is not said")
           ->check(CLI::Range(1, 16384))
           ->capture_default_str();
       v.add_option("--samples", f.samples, "samples a pixel, along each side; beyond 16 for --mode path only")
           ->check(CLI::Range(1, 64))
           ->capture_default_str();
       v.add_option("--level", f.level,
                    "of each LOD: that level, from 0, or its last; auto, by the distance, as browsers choose")
           ->check(
               [](const std::string& s) {
                 return is_level(s) ? "" : "'" + s + "' is neither a number from 0 to 999 nor auto";
               },
               "", "")
           ->type_name("N|auto")
           ->capture_default_str();
       pictures(v, f);
       pipeline(v, f);
       placing(v, f);
     },
     run_render},
    {"simplify",
     "the world at falling numbers of triangles, a file each, and all of them as levels of detail in one file",
     "wrlkit simplify valve.wrl --every 1000 -o out/\n  wrlkit simplify valve.wrl --ratios 0.5,0.25 -o out/\n  wrlkit "
     "simplify valve.wrl --error 1mm,5mm -o out/\n  wrlkit simplify valve.wrl --progressive -o out/",
     [](CLI::App& v, Flags& f) {
       input(v, f);
       v.add_option("-o,--output", f.output, "folder for the files; made when it is not there")
           ->required()
           ->type_name("DIR");
       v.add_option("--every", f.every, "a file each time that so many triangles have gone: at the multiples of N")
           ->check(CLI::Range(1, 1'000'000'000))
           ->type_name("N");
       v.add_option("--counts", f.counts, "a file at each of these numbers of triangles")->delimiter(',');
       v.add_option("--ratios", f.ratios, "a file at each of these shares of the triangles")
           ->delimiter(',')
           ->check(CLI::Range(0.0, 1.0));
       v.add_option(
            "--error", f.errors,
            "a file with each surface as simple as it can be within this distance: 2mm, 0.5in; a number is in metres")
           ->delimiter(',')
           ->type_name("LENGTH");
       v.add_flag("--progressive", f.progressive,
                  "instead of worlds, one .wpm file: from coarse to exactly the original, for viewers that show what "
                  "has come in");
       v.add_option("--criterion", f.criterion, "which edges collapse first")->check(a_criterion());
       v.add_option("--pixels", f.pixels,
                    "error that may be seen on a screen of 1080 pixels, for the ranges of the LOD nodes")
           ->check(CLI::PositiveNumber)
           ->capture_default_str();
       pipeline(v, f);
       vrml_output(v, f);
     },
     run_simplify},
    {"compare-lod", "what each criterion makes of a world: a page of errors, times and pictures, or one picture of all",
     "wrlkit compare-lod valve.wrl -o report.html\n  wrlkit compare-lod valve.wrl -o valve.png --counts 2000,500 "
     "--criteria melax,quadric --mode wireframe",
     [](CLI::App& v, Flags& f) {
       input(v, f);
       v.add_option("-o,--output", f.output,
                    "file.html; or file.png: the pictures alone, four in a row, a row for each criterion")
           ->required()
           ->type_name("FILE");
       v.add_option("--counts", f.counts, "numbers of triangles to compare at")->delimiter(',');
       v.add_option("--ratios", f.ratios,
                    "instead of that, shares of the triangles; as a rule 0.5,0.25,0.1,0.05,0.02,0.01")
           ->delimiter(',')
           ->check(CLI::Range(0.0, 1.0));
       v.add_option("--criteria", f.criteria, "which; as a rule all")->delimiter(',')->check(a_criterion());
       v.add_flag("--bare", f.bare, "the criterion alone decides: creases and borders are edges like others");
       v.add_option("--size", f.picture_size, "pixels along each side of a picture")
           ->check(CLI::Range(16, 2048))
           ->capture_default_str();
       v.add_option("--level", f.level,
                    "of each LOD: that level, from 0, or its last; auto, by the distance, as browsers choose")
           ->check(
               [](const std::string& s) {
                 return is_level(s) ? "" : "'" + s + "' is neither a number from 0 to 999 nor auto";
               },
               "", "")
           ->type_name("N|auto")
           ->capture_default_str();
       pictures(v, f);
       pipeline(v, f);
     },
     run_compare_lod, ".html .png"},
    {"illuminate", "the light of a world by global illumination, as patches with a colour each",
     "wrlkit illuminate room.wrl patches.xml\n  wrlkit illuminate room.wrl patches.xml --method stochastic-iteration "
     "--max-edge 5cm --samples 64\n  wrlkit illuminate room.wrl.gz patches.xml.gz --gradient 0.2\n  wrlkit illuminate "
     "room.wrl patches.xml --pictures textures/ --smooth",
     [](CLI::App& v, Flags& f) {
       input(v, f);
       v.add_option("OUT", f.output, "file.xml or file.xml.gz; - is standard output")->required();
       AddOption{v}("method", f.method, "how the light is found");
       v.add_option("--samples", f.light_samples, "rays a patch: the error falls with their square root or faster")
           ->check(CLI::Range(1, 1'000'000))
           ->capture_default_str();
       v.add_option("--max-edge", f.max_edge,
                    "longest edge of a patch: 5cm, 0.05; as a rule what makes some twenty thousand patches")
           ->type_name("LENGTH");
       v.add_option("--max-area", f.max_area, "largest area of a patch, in square metres")->check(CLI::PositiveNumber);
       v.add_option("--gradient", f.gradient,
                    "smaller patches, down to an eighth, where neighbours differ by more than this share of the "
                    "world's mean radiance: 0.2")
           ->check(CLI::PositiveNumber);
       v.add_option("--max-patches", f.max_patches,
                    "when there would be more, all are made larger, and --gradient ends; a patch takes some 260 bytes")
           ->check(CLI::Range(1, 100'000'000))
           ->capture_default_str();
       auto* pictures =
           v.add_option("--pictures", f.pictures,
                        "folder for the textures as well: a .png for each Shape with its flat polygons as they are lit")
               ->type_name("DIR");
       v.add_flag("--smooth", f.smooth, "the textures with three colours a patch, so that its edges are not seen")
           ->needs(pictures);
       v.add_option("--sky", f.sky,
                    "what shines from beyond the world: its Background, none, or one radiance, as 0.5:0.5:1")
           ->type_name("background|none|R:G:B")
           ->capture_default_str();
       v.add_option("--emission", f.emission, "emissiveColor shines so many times as bright as it looks")
           ->check(CLI::NonNegativeNumber)
           ->capture_default_str();
       v.add_option("--seed", f.seed, "of the random numbers: the same seed gives the same file")
           ->capture_default_str();
       placing(v, f);
     },
     run_illuminate, ".xml .xml.gz"},
    {"view", "a page to look at the world, or to compare two: one HTML file that needs no other and no network",
     "wrlkit view plant.wrl -o plant.html\n  wrlkit view plant.wrl simpler.wrl -o compared.html\n  wrlkit view "
     "valve.wrl -o valve.html --criteria length-normal,melax\n  wrlkit view plant.wrl --serve",
     [](CLI::App& v, Flags& f) {
       v.add_option("IN", f.inputs, "the world, or two worlds to be compared")->required()->expected(1, 2);
       v.add_option("-o,--output", f.output, "file.html; - is standard output")->type_name("FILE");
       v.add_flag("--serve", f.serve,
                  "show the page at an address of this machine, which nobody else can reach, until it is interrupted");
       v.add_option("--criteria", f.criteria,
                    "criteria whose collapses are shown step by step; as a rule three of a single world of up to "
                    "300,000 triangles")
           ->delimiter(',')
           ->check(a_criterion());
       pipeline(v, f);
       placing(v, f);
     },
     run_view, ".html"},
    {"corpus-run", "one recipe over many files, each in a process of its own; what was done before is not done again",
     "wrlkit corpus run recipes/plant-web.toml plant/ -o web/\n  wrlkit corpus run recipes/archive.toml 'old/**/*.wrl' "
     "@more.txt -o new/ --jobs 8 --memory 32G --timeout 5m\n  wrlkit corpus run recipe.toml plant/ -o web/ --shard 2/8",
     [](CLI::App& v, Flags& f) {
       corpus_inputs(v, f);
       v.add_option("--timeout", f.timeout, "a file that takes longer is given up: 90s, 10m, 2h")
           ->type_name("TIME")
           ->capture_default_str()
           ->check([](const std::string& s) { return seconds_of(s) > 0 ? "" : "'" + s + "' is no time; 90s, 10m, 2h"; },
                   "", "");
       v.add_option("--joblog", f.joblog, "a line for each file as GNU parallel writes them, behind what is there")
           ->type_name("FILE");
       v.add_option("--bundle", f.bundle,
                    "so many small files share a worker, one after the other, which takes a third of the time; 1: each "
                    "has one of its own")
           ->check(CLI::Range(1, 1000));
       v.add_flag("--retry", f.retry, "files of which nothing could be made are tried again");
     },
     run_corpus_run},
    {"corpus-plan", "what corpus run would do: each file with its output, its shard and what it is likely to cost",
     "wrlkit corpus plan recipes/plant-web.toml plant/ -o web/ --shard 1/8\n  wrlkit corpus plan "
     "recipes/plant-web.toml plant/ -o web/ --json",
     [](CLI::App& v, Flags& f) { corpus_inputs(v, f); }, run_corpus_plan},
    {"corpus-report",
     "what a corpus run has come to: a page, tables, or what became worse since another run; exit code 1 when "
     "something did",
     "wrlkit corpus report web/\n  wrlkit corpus report web/ -o report.html -o files.csv --compare web_before/\n  "
     "wrlkit corpus report web/ --looks 0 --json",
     [](CLI::App& v, Flags& f) {
       v.add_option_function<std::string>(
            "OUT", [&f](const std::string& path) { f.inputs = {path}; }, "the folder of the run")
           ->required();
       v.add_option("-o,--output", f.outputs, "file.html, .csv or .json; several times; OUT/report.html as a rule")
           ->type_name("FILE");
       v.add_option("--compare", f.compare, "the folder of another run, before this one")->type_name("DIR");
       v.add_option("--looks", f.looks, "of how many worlds, at the most, surfaces are compared and pictures drawn")
           ->check(CLI::Range(0, 1'000'000))
           ->capture_default_str();
     },
     run_corpus_report},
    {"passes", "every pass, or one with its options", "wrlkit passes tessellate",
     [](CLI::App& v, Flags& f) {
       v.add_option("NAME", f.name, "a pass");
       python(v, f);
     },
     run_passes},
    {"formats", "what can be read and written", "wrlkit formats", [](CLI::App&, Flags&) {}, run_formats},
    {"explain", "a node type, a pass or a message", "wrlkit explain Cone\n  wrlkit explain undefined-use",
     [](CLI::App& v, Flags& f) { v.add_option("NAME", f.name, "node type, pass or message")->required(); },
     run_explain},
    {"docs", "a page of the documentation that is made from the tables", "wrlkit docs nodes",
     [](CLI::App& v, Flags& f) { AddOption{v}.choice("PAGE", f.page, "which page")->required(); }, run_docs},
};

void limit_memory(const Flags& f) {
  if (f.memory.empty()) return;
  const rlim_t bytes = size_of(f.memory);
  const rlimit limit{bytes, bytes};
  setrlimit(RLIMIT_AS, &limit);
}

}  // namespace

namespace {

constexpr std::string_view program_help = "wrlkit: legacy virtual worlds (VRML97) to glTF, and back to better VRML";

const Verb* find_verb(std::string_view name) {
  auto i = std::ranges::find(verbs, name, &Verb::name);
  return i == std::end(verbs) ? nullptr : &*i;
}

/// The options of one verb, as an application of their own.
std::unique_ptr<CLI::App> app_of(const Verb& verb, Flags& flags) {
  auto app = std::make_unique<CLI::App>(verb.help, verb.name);
  verb.flags(*app, flags);
  common(*app, flags);
  return app;
}

std::vector<CLI::Option*> long_options(const CLI::App& app) {
  std::vector<CLI::Option*> out;
  for (auto* o : app.get_options([](const CLI::Option* o) { return !o->get_lnames().empty(); }))
    out.push_back(const_cast<CLI::Option*>(o));
  for (auto* group : app.get_subcommands([](const CLI::App* a) { return a->get_name().empty(); }))
    for (auto* o : long_options(*group)) out.push_back(o);
  return out;
}

bool is_flag(const CLI::Option& o) { return o.get_expected_min() == 0; }

/// What was given on the command line.
GivenOptions given_options(const CLI::App& verb) {
  GivenOptions out;
  for (auto* o : long_options(verb))
    if (o->count() > 0) out.emplace_back(o->get_lnames()[0], o->results());
  return out;
}

/// One parse. Flags that CLI11 cannot set are set by the caller.
int parse(std::vector<std::string> words, Flags& flags, const Verb*& chosen) {
  std::ranges::reverse(words);
  CLI::App app(std::string(program_help), "wrlkit");
  app.set_version_flag("--version", std::string("wrlkit ") + WRLKIT_VERSION);
  app.require_subcommand(1);
  app.failure_message(CLI::FailureMessage::simple);
  for (const Verb& v : verbs) {
    auto* sub = app.add_subcommand(v.name, v.help);
    v.flags(*sub, flags);
    common(*sub, flags);
    sub->footer(std::string("-Werror=NAME and -Wno-NAME set the severity of one message (wrlkit explain NAME), -Werror "
                            "that of all warnings.\n\nExample:\n  ") +
                v.example);
    sub->callback([&] { chosen = &v; });
  }
  try {
    app.parse(words);
  } catch (const CLI::ParseError& e) {
    chosen = nullptr;
    return app.exit(e) == 0 ? done : usage;
  }
  for (auto* sub : app.get_subcommands()) {
    flags.given = given_options(*sub);
    flags.can_replace = sub->get_option_no_throw("--in-place") != nullptr;
    if (auto* p = sub->get_option_no_throw("--pipeline")) flags.pipeline_given = p->count() > 0;
  }
  return done;
}

std::vector<std::string> words_of(const GivenOptions& options) {
  std::vector<std::string> words;
  for (const auto& [name, values] : options)
    for (const auto& v : values)
      if (v.empty())
        words.insert(words.end(), {"--" + name, ""});  // behind "=" CLI11 takes no value for a missing one
      else
        words.push_back("--" + name + "=" + v);
  return words;
}

/// The command line with what its recipe says, as far as it does not say that itself. False, with a message, when the
/// recipe is none.
bool add_recipe(const Flags& flags, const Verb& verb, std::vector<std::string>& words,
                std::vector<std::string>& warnings) {
  std::string why;
  auto recipe = read_recipe(flags.recipe, why);
  if (!recipe) {
    std::fputs(why.c_str(), stderr);
    return false;
  }
  if (!recipe->python.empty()) recipe->options.emplace_back("python", recipe->python);
  if (recipe->pipeline) recipe->options.emplace_back("pipeline", std::vector{*recipe->pipeline});
  Flags unused;
  const auto app = app_of(verb, unused);
  std::erase_if(recipe->options, [&](const auto& o) {
    return !app->get_option_no_throw("--" + o.first) ||
           std::ranges::find(flags.given, o.first, &GivenOptions::value_type::first) != flags.given.end();
  });
  const auto added = words_of(recipe->options);
  words.insert(std::ranges::find(words, verb.name) + 1, added.begin(), added.end());
  warnings.insert(warnings.begin(), recipe->warnings.begin(), recipe->warnings.end());
  return true;
}

}  // namespace

std::string_view program_version() { return WRLKIT_VERSION; }

std::uint64_t size_of(const std::string& s) {
  char* end = nullptr;
  double v = std::strtod(s.c_str(), &end);
  std::string unit = end;
  if (!unit.empty() && (unit.back() == 'B' || unit.back() == 'b')) unit.pop_back();
  if (unit.ends_with('i')) unit.pop_back();
  double factor = unit == "G" || unit == "g"   ? 1 << 30
                  : unit == "M" || unit == "m" ? 1 << 20
                  : unit == "K" || unit == "k" ? 1 << 10
                  : unit.empty()               ? 1
                                               : 0;
  return v > 0 ? static_cast<std::uint64_t>(v * factor) : 0;
}

double seconds_of(const std::string& text) {
  char* end = nullptr;
  const double v = std::strtod(text.c_str(), &end);
  const std::string unit = end;
  const double factor = unit == "h" ? 3600 : unit == "m" || unit == "min" ? 60 : unit == "s" || unit.empty() ? 1 : 0;
  return v > 0 ? v * factor : 0;
}

std::vector<OptionHelp> options_of(std::string_view verb) {
  Flags unused;
  const auto app = app_of(*find_verb(verb), unused);
  std::vector<OptionHelp> out;
  for (auto* o : long_options(*app))
    out.push_back(
        {o->get_lnames()[0], is_flag(*o) ? std::string(flag_type) : o->get_type_name(), o->get_description()});
  return out;
}

bool check_option(std::string_view verb, std::string_view option, const std::vector<std::string>& values,
                  std::string& why) {
  Flags unused;
  const auto app = app_of(*find_verb(verb), unused);
  auto* o = app->get_option("--" + std::string(option));
  try {
    for (const auto& v : values) o->add_result(v);
    o->run_callback();
    return true;
  } catch (const CLI::Error& e) {
    why = e.what();
    return false;
  }
}

Flags conversion_flags(const Recipe& recipe) {
  const Verb& convert = *find_verb("convert");
  Flags flags;
  const auto app = app_of(convert, flags);
  auto options = recipe.options;
  std::erase_if(options, [&](const auto& o) { return !app->get_option_no_throw("--" + o.first); });
  if (recipe.pipeline) options.emplace_back("pipeline", std::vector{*recipe.pipeline});
  if (!recipe.python.empty()) options.emplace_back("python", recipe.python);
  auto words = words_of(options);
  for (const char* word : {"--", "IN", "OUT"}) words.emplace_back(word);
  std::ranges::reverse(words);
  app->parse(words);
  flags.given = given_options(*app);
  flags.pipeline_given = recipe.pipeline.has_value();
  flags.warnings = recipe.warnings;
  return flags;
}

/// The verbs of `wrlkit corpus`; what it asks for without one of them.
static int corpus_help(const std::vector<std::string>& words) {
  const bool asked = words.size() > 1 && (words[1] == "--help" || words[1] == "-h");
  std::string text = "wrlkit corpus: many files at once\n\n";
  for (const Verb& v : verbs)
    if (std::string_view(v.name).starts_with("corpus-"))
      text += "  wrlkit corpus " + std::string(v.name).substr(7) + "\n      " + v.help + "\n";
  text += "\n'wrlkit corpus run --help' lists the options of one.\n";
  std::fputs(text.c_str(), asked ? stdout : stderr);
  return asked ? done : usage;
}

int run_command_line(int argc, char** argv) {
  std::vector<std::string> words(argv + 1, argv + argc);
  const auto warnings = take_warning_flags(words);
  if (words.size() > 1 && words[0] == "corpus" && !words[1].starts_with('-')) {
    words[0] += "-" + words[1];
    words.erase(words.begin() + 1);
  }
  if (!words.empty() && words[0] == "corpus") return corpus_help(words);
  if (!words.empty() && !words[0].starts_with('-') && !find_verb(words[0])) {
    std::fprintf(stderr, "wrlkit: there is no verb '%s'; see wrlkit --help\n", words[0].c_str());
    return usage;
  }
  Flags flags;
  const Verb* chosen = nullptr;
  int code = parse(words, flags, chosen);
  std::vector<std::string> of_recipe;
  std::string why;
  if (chosen && !load_python_passes(flags.python, why)) {
    std::fprintf(stderr, "wrlkit: --python: %s\n", why.c_str());
    return usage;
  }
  if (chosen && !flags.recipe.empty()) {
    if (!add_recipe(flags, *chosen, words, of_recipe)) return usage;
    flags = {};
    code = parse(words, flags, chosen);
  }
  if (!chosen) return code;
  flags.warnings = of_recipe;
  flags.warnings.insert(flags.warnings.end(), warnings.begin(), warnings.end());
  if (!check_outputs(flags, chosen->endings)) return usage;
  // A corpus run divides the memory among its workers.
  if (!std::string_view(chosen->name).starts_with("corpus")) limit_memory(flags);
  return chosen->run(flags);
}

}  // namespace wrlkit
