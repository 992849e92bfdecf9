#include "tools/cli/verbs.h"

#include <CLI/CLI.hpp>
#include <algorithm>
#include <limits>

#include "base/text/amounts.h"
#include "convert/formats.h"
#include "tools/cli/options.h"
#include "tools/verbs/documentation.h"

namespace wrlkit::cli {
namespace {

constexpr Verb all_verbs[] = {
    {"convert", "convert a scene; the ending of OUT selects the format",
     "wrlkit convert plant.wrl plant.glb\n  wrlkit convert plant.wrl small.glb --compress meshopt --tolerance 1mm\n  "
     "wrlkit convert old.wrl.gz new.wrl -p inline,expand-protos --gzip",
     [](CLI::App& v, Flags& f) {
       input(v, f);
       v.add_option("OUT", f.output, "the output file: " + output_endings_text() + "; - is standard output")
           ->required();
       format(v, f, "format of standard output, or of a file name without an ending");
       pipeline(v, f);
       v.add_option("--recipe", f.recipe,
                    "take passes and options from a recipe; the command line overrides them; see docs/recipes.md")
           ->type_name("FILE");
       v.add_flag("--print-recipe", f.print_recipe,
                  "print the complete pipeline and all options as a recipe, and exit");
       light(v, f);
       small_gltf(v, f);
       placing(v, f);
       vrml_output(v, f);
       files(v, f);
       in_place(v, f);
     },
     run_convert},
    {"optimize",
     "write a small glTF file: equal parts are shared, vertices quantized and compressed; names and parts are kept",
     "wrlkit optimize plant.wrl plant.glb\n  wrlkit optimize plant.wrl plant.glb --profile cesium --tolerance 2mm "
     "--json\n  wrlkit optimize --profile unity --print-profile",
     [](CLI::App& v, Flags& f) {
       input(v, f);
       v.get_option("IN")->required(false);
       v.add_option("OUT", f.output, "the output file: .glb or .gltf");
       v.add_flag("--print-profile", f.print_profile, "print what the profile sets, and exit");
       v.add_flag(
           "--recognise", f.recognise,
           "store cylinders, boxes, elbows and the like once, at unit size, for all their sizes; round walls get "
           "smooth normals; see wrlkit passes recognise");
       pipeline(v, f);
       small_gltf(v, f);
       for (const char* name : {"--compress", "--extras", "--texture-format", "--names"})
         v.get_option(name)->default_str("set by the profile");
       v.get_option("--profile")->default_str("three");
       files(v, f);
       placing(v, f);
       in_place(v, f);
     },
     run_optimize},
    {"info", "show what a file contains: nodes, triangles, bounds, textures, lights",
     "wrlkit info plant.wrl --json\n  wrlkit info plant.wrl --recognise\n  wrlkit info plant/",
     [](CLI::App& v, Flags& f) {
       v.add_option("IN", f.inputs, "scenes, folders, globs, @FILE (a list of scenes); - is standard input")
           ->required();
       v.add_flag("--recognise", f.recognise,
                  "also count cylinders, boxes, elbows and the like, with their share of the triangles; see wrlkit "
                  "passes recognise");
       placing(v, f);
     },
     run_info},
    {"check", "report errors and suspicious values", "wrlkit check *.wrl\n  wrlkit check old/ --quick",
     [](CLI::App& v, Flags& f) {
       v.add_option("IN", f.inputs, "scenes, folders, globs, @FILE (a list of scenes); - is standard input")
           ->required();
       v.add_flag("--quick", f.quick, "skip geometry and pictures");
       v.add_flag("--parse-only", f.parse_only, "only parse: check no values, follow no Inlines");
     },
     run_check},
    {"cat", "print a scene as canonical VRML", "wrlkit cat plant.wrl.gz | less",
     [](CLI::App& v, Flags& f) {
       input(v, f);
       v.add_option("-o,--output", f.output, "write to this file instead of standard output");
       pipeline(v, f);
       vrml_output(v, f);
       files(v, f);
     },
     run_cat, ".wrl .wrz .wrl.gz .vrml", "",
     "it prints the scene itself; write that to a file with -o, or use wrlkit info --json"},
    {"diff",
     "compare two scenes: structure, names, the distance between their surfaces, colours and pictures, and what nodes "
     "say (ROUTEs, animations, Viewpoints, lights and others); the places of pictures and points within lines are "
     "not compared; the exit code is 0 even if they differ",
     "wrlkit diff plant.wrl simpler.wrl\n  wrlkit diff plant.wrl simpler.wrl --json",
     [](CLI::App& v, Flags& f) {
       for (const char* name : {"A", "B"})
         v.add_option_function<std::string>(
              name, [&f](const std::string& path) { f.inputs.push_back(path); }, "a scene; - is standard input")
             ->required();
       placing(v, f);
     },
     run_diff},
    {"render", "draw a picture without a display; compare two scenes; make a contact sheet of many",
     "wrlkit render plant.wrl plant.png --viewpoint Overview\n  wrlkit render plant.wrl apart.png --compare "
     "simpler.wrl\n  wrlkit render valve.wrl valve.webp --turntable 36\n  wrlkit render old/ new/pump.wrl sheet.png",
     [](CLI::App& v, Flags& f) {
       v.add_option_function<std::vector<std::string>>(
            "IN",
            [&f](const std::vector<std::string>& files) {
              f.inputs.assign(files.begin(), files.end() - 1);
              f.output = files.back();
            },
            "the scene, and the picture: .png, .jpg or .webp; several scenes, folders, globs or @FILE (a list of "
            "scenes) make a contact sheet")
           ->required()
           ->expected(2, 1'000'000)
           ->type_name("... OUT");
       v.add_option("--compare", f.compare,
                    "another scene: draw both from the viewpoint of the first, and their difference, amplified")
           ->type_name("FILE");
       v.add_option("--turntable", f.turntable,
                    "N pictures from around the scene: OUT_000.png, OUT_001.png, ...; OUT.webp is one animation")
           ->check(CLI::Range(1, 3600))
           ->type_name("N");
       v.add_option("--width", f.width, "width in pixels; default in a contact sheet: 320")
           ->check(CLI::Range(1, 16384))
           ->capture_default_str();
       v.add_option("--height", f.height, "height in pixels; default in a contact sheet: 240")
           ->check(CLI::Range(1, 16384))
           ->capture_default_str();
       v.add_option("--samples", f.samples, "samples along each side of a pixel; more than 16 only for --mode path")
           ->check(CLI::Range(1, 64))
           ->capture_default_str();
       level(v, f);
       pictures(v, f);
       pipeline(v, f);
       placing(v, f);
     },
     run_render},
    {"simplify",
     "reduce the number of triangles: a file for each level, and one file with all of them as levels of detail",
     "wrlkit simplify valve.wrl --every 1000 -o out/\n  wrlkit simplify valve.wrl --ratios 0.5,0.25 -o out/\n  wrlkit "
     "simplify valve.wrl --ratios 0.1 -o valve.glb\n  wrlkit simplify valve.wrl --error 1mm,5mm -o out/\n  wrlkit "
     "simplify valve.wrl --progressive -o out/",
     [](CLI::App& v, Flags& f) {
       input(v, f);
       v.add_option("-o,--output", f.output,
                    "folder for the files; or one .glb, .gltf, .wrl or .x3d file: the simplified scene or, for several "
                    "levels, a scene with levels of detail")
           ->required()
           ->type_name("DIR|FILE");
       v.add_option("--every", f.every, "a level at each multiple of N triangles")
           ->check(CLI::Range(1, 1'000'000'000))
           ->type_name("N");
       v.add_option("--counts", f.counts, "levels with these numbers of triangles")
           ->delimiter(',')
           ->check(CLI::Range(std::size_t{1}, std::size_t{1'000'000'000}));
       v.add_option("--ratios", f.ratios, "levels with these shares of the triangles: 0.5,0.1 or 50%,10%")
           ->delimiter(',')
           ->transform(a_share());
       v.add_option("--error", f.errors,
                    "levels within these distances of the original: 2mm, 0.5in; plain numbers are metres")
           ->delimiter(',')
           ->type_name("LENGTH");
       v.add_flag("--progressive", f.progressive,
                  "write one .wpm file instead, which refines from coarse to exactly the original while it loads");
       v.add_option("--criterion", f.criterion, "order in which edges collapse")->check(a_criterion());
       v.add_option("--pixels", f.pixels,
                    "error in pixels, on a screen 1080 pixels high, that sets the ranges of LOD nodes")
           ->check(a_number_above_0())
           ->capture_default_str();
       pipeline(v, f);
       vrml_output(v, f);
       files(v, f);
       placing(v, f);
     },
     run_simplify},
    {"compare-lod", "compare simplification criteria: a page with errors, times and pictures, or one picture",
     "wrlkit compare-lod valve.wrl -o report.html\n  wrlkit compare-lod valve.wrl -o valve.png --counts 2000,500 "
     "--criteria melax,quadric --mode wireframe",
     [](CLI::App& v, Flags& f) {
       input(v, f);
       v.add_option("-o,--output", f.output,
                    "the output file: .html; .png has only the pictures, a row for each criterion")
           ->required()
           ->type_name("FILE");
       v.add_option("--counts", f.counts, "numbers of triangles to compare at")
           ->delimiter(',')
           ->check(CLI::Range(std::size_t{1}, std::size_t{1'000'000'000}));
       v.add_option("--ratios", f.ratios, "shares of the triangles to compare at; default: 0.5,0.25,0.1,0.05,0.02,0.01")
           ->delimiter(',')
           ->transform(a_share());
       v.add_option("--criteria", f.criteria, "criteria to compare; default: all")
           ->delimiter(',')
           ->check(a_criterion());
       v.add_flag("--bare", f.bare, "use the criterion alone: creases and borders are not protected");
       v.add_option("--size", f.picture_size, "width and height of each picture in pixels")
           ->check(CLI::Range(16, 2048))
           ->capture_default_str();
       level(v, f);
       pictures(v, f);
       pipeline(v, f);
     },
     run_compare_lod, ".html .png"},
    {"illuminate", "compute global illumination, written as patches with a colour each",
     "wrlkit illuminate room.wrl patches.xml\n  wrlkit illuminate room.wrl patches.xml --method stochastic-iteration "
     "--max-edge 5cm --samples 64\n  wrlkit illuminate room.wrl.gz patches.xml.gz --gradient 0.2\n  wrlkit illuminate "
     "room.wrl patches.xml --pictures textures/ --smooth",
     [](CLI::App& v, Flags& f) {
       input(v, f);
       v.add_option("OUT", f.output, "the output file: .xml or .xml.gz; - is standard output")->required();
       method(v, f);
       v.add_option("--samples", f.light_samples, "rays per patch; the error falls with their square root or faster")
           ->check(CLI::Range(1, 1'000'000))
           ->capture_default_str();
       v.add_option("--max-edge", f.max_edge,
                    "longest edge of a patch: 5cm, 0.05; default: chosen for about 20,000 patches")
           ->type_name("LENGTH");
       v.add_option("--max-area", f.max_area, "largest area of a patch, in square metres")->check(a_number_above_0());
       v.add_option("--gradient", f.gradient,
                    "halve patches, down to an eighth, where neighbours differ by more than this share of the mean "
                    "radiance: 0.2")
           ->check(a_number_above_0());
       v.add_option("--max-patches", f.max_patches,
                    "maximum number of patches; larger ones are used if necessary; a patch takes about 260 bytes")
           ->check(CLI::Range(1, 100'000'000))
           ->capture_default_str();
       auto* pictures = v.add_option("--pictures", f.pictures,
                                     "also write textures to this folder: a .png for each Shape with its lit polygons")
                            ->type_name("DIR");
       v.add_flag("--smooth", f.smooth,
                  "interpolate three colours per patch in the textures, which hides the edges of patches")
           ->needs(pictures);
       v.add_option("--sky", f.sky, "light from the sky: that of the Background, none, or a radiance such as 0.5:0.5:1")
           ->type_name("background|none|R:G:B")
           ->capture_default_str();
       v.add_option("--emission", f.emission, "factor for the light of emissiveColor")
           ->check(a_number_within(0, std::numeric_limits<double>::max()))
           ->capture_default_str();
       v.add_option("--seed", f.seed, "seed of the random numbers; the same seed gives the same file")
           ->capture_default_str();
       placing(v, f);
     },
     run_illuminate, ".xml .xml.gz"},
    {"tiles",
     "write 3D Tiles of scenes of any size: levels of detail with measured errors; parts keep their names at every "
     "level",
     "wrlkit tiles plant.wrl -o tiles/\n  wrlkit tiles plant/ -o tiles/ --compress draco\n  wrlkit tiles @units.txt -o "
     "tiles/ --at 50.1,8.6,112,30",
     [](CLI::App& v, Flags& f) {
       v.add_option("IN", f.inputs,
                    "scenes, folders, globs, @FILE (a list of scenes); - is such a list on standard input")
           ->required();
       v.add_option("-o,--output", f.output, "folder for tileset.json and its tiles")->required()->type_name("DIR");
       globs(v, f);
       tiles(v, f);
       placing(v, f);
     },
     run_tiles, "", "tileset.json"},
    {"view",
     "make a viewer page: one HTML file that needs no other file and no network, for a scene, two scenes to compare, "
     "or a gallery of many; or a page next to tiles",
     "wrlkit view plant.wrl -o plant.html\n  wrlkit view plant.wrl simpler.wrl -o compared.html\n  wrlkit view "
     "archive/ -o gallery.html\n  wrlkit view valve.wrl -o valve.html --criteria length-normal,melax\n  wrlkit view "
     "plant.wrl --serve\n  wrlkit view tiles/ --serve\n  wrlkit view tiles/ -o tiles/index.html",
     [](CLI::App& v, Flags& f) {
       v.add_option(
            "IN", f.inputs,
            "a scene, two scenes to compare, or a folder with a tileset.json; for a gallery: more scenes, folders, "
            "globs, @FILE (a list of scenes)")
           ->required();
       v.add_option("-o,--output", f.output, "the output file: .html; - is standard output")->type_name("FILE");
       v.add_flag("--serve", f.serve, "serve the page on this machine only, until interrupted");
       v.add_option("--limit", f.limit, "maximum number of scenes in a gallery; the rest is only counted")
           ->check(CLI::Range(1, 100'000))
           ->capture_default_str();
       v.add_option("--criteria", f.criteria,
                    "criteria whose edge collapses can be stepped through; default: three, for one scene of up to "
                    "300,000 triangles")
           ->delimiter(',')
           ->check(a_criterion());
       pipeline(v, f);
       placing(v, f);
     },
     run_view, ".html"},
    {"corpus-run",
     "apply one recipe to many files, in worker processes: a file that breaks its worker harms no other; files that "
     "are "
     "done are skipped",
     "wrlkit corpus run recipes/plant-web.toml plant/ -o web/\n  wrlkit corpus run recipes/archive.toml 'old/**/*.wrl' "
     "@more.txt -o new/ --jobs 8 --memory 32G --timeout 5m\n  wrlkit corpus run recipe.toml plant/ -o web/ --shard 2/8",
     [](CLI::App& v, Flags& f) {
       corpus_inputs(v, f);
       timeout(v, f, "maximum time for a file: 90s, 10m, 2h")->capture_default_str();
       v.add_option("--joblog", f.joblog, "append a line for each file, in the format of GNU parallel")
           ->type_name("FILE");
       v.add_option("--bundle", f.bundle,
                    "number of small files that share a process; default: 16, with passes in Python 1")
           ->check(CLI::Range(1, 1000));
       v.add_flag("--retry", f.retry, "try failed files again");
       v.add_flag("--overwrite", f.overwrite, "replace files in the output folder that no corpus run has made");
     },
     run_corpus_run},
    {"corpus-plan", "show what corpus run would do: each file with its output, shard and estimated cost",
     "wrlkit corpus plan recipes/plant-web.toml plant/ -o web/ --shard 1/8\n  wrlkit corpus plan "
     "recipes/plant-web.toml plant/ -o web/ --json",
     [](CLI::App& v, Flags& f) { corpus_inputs(v, f); }, run_corpus_plan},
    {"corpus-report", "report on a corpus run: a page or tables; with --compare, exit code 1 if something became worse",
     "wrlkit corpus report web/\n  wrlkit corpus report web/ -o report.html -o files.csv --compare web_before/\n  "
     "wrlkit corpus report web/ --looks 0 --json",
     [](CLI::App& v, Flags& f) {
       v.add_option_function<std::string>(
            "OUT", [&f](const std::string& path) { f.inputs = {path}; }, "the output folder of the run")
           ->required();
       v.add_option("-o,--output", f.outputs,
                    "the output file: .html, .csv or .json; can be repeated; default: OUT/report.html")
           ->type_name("FILE");
       v.add_option("--compare", f.compare, "the output folder of an earlier run")->type_name("DIR");
       v.add_option("--looks", f.looks, "maximum number of scenes whose surfaces are compared and drawn")
           ->check(CLI::Range(0, 1'000'000))
           ->capture_default_str();
     },
     run_corpus_report, ".html .csv .json"},
    {"passes", "list all passes, or describe one", "wrlkit passes tessellate",
     [](CLI::App& v, Flags& f) {
       v.add_option("NAME", f.name, "name of a pass");
       python(v, f);
     },
     run_passes},
    {"formats", "list the formats that are read and written", "wrlkit formats", [](CLI::App&, Flags&) {}, run_formats},
    {"explain", "explain a node type, a pass or a message", "wrlkit explain Cone\n  wrlkit explain undefined-use",
     [](CLI::App& v, Flags& f) { v.add_option("NAME", f.name, "node type, pass or message")->required(); },
     run_explain},
    {"docs", "print a page of the reference; without PAGE, list the pages", "wrlkit docs nodes",
     [](CLI::App& v, Flags& f) {
       std::vector<std::string> names;
       for (const auto& page : documentation_pages()) names.emplace_back(page.name);
       v.add_option("PAGE", f.name, "name of a page")->check(one_of(names));
     },
     run_docs},
    {"completion", "print the script that completes commands in a shell", "source <(wrlkit completion bash)",
     [](CLI::App& v, Flags& f) {
       v.add_option("SHELL", f.name, "bash, zsh or fish")->required()->check(one_of({"bash", "zsh", "fish"}));
     },
     run_completion, "", "", "it prints a script for a shell"},
    {"manual", "print the manual page", "wrlkit manual | man -l -", [](CLI::App&, Flags&) {}, run_manual, "", "",
     "it prints a page for man"},
};

}  // namespace

std::span<const Verb> verbs() { return all_verbs; }

const Verb* find_verb(std::string_view name) {
  const auto i = std::ranges::find(all_verbs, name, &Verb::name);
  return i == std::end(all_verbs) ? nullptr : &*i;
}

}  // namespace wrlkit::cli
