#include "tools/cli/verbs.h"

#include <CLI/CLI.hpp>
#include <algorithm>

#include "base/text/amounts.h"
#include "convert/formats.h"
#include "tools/cli/options.h"
#include "tools/verbs/documentation.h"

namespace wrlkit::cli {
namespace {

constexpr Verb all_verbs[] = {
    {"convert", "convert a world; the name of OUT decides the format",
     "wrlkit convert plant.wrl plant.glb\n  wrlkit convert plant.wrl small.glb --compress meshopt --tolerance 1mm\n  "
     "wrlkit convert old.wrl.gz new.wrl -p inline,expand-protos --gzip",
     [](CLI::App& v, Flags& f) {
       input(v, f);
       v.add_option("OUT", f.output, "the output; its name ends in " + output_endings_text() + "; - is standard output")
           ->required();
       format(v, f, "format of standard output, and of an output whose name has no ending");
       pipeline(v, f);
       v.add_option("--recipe", f.recipe,
                    "passes and options from a recipe, as far as they are not given here; see docs/recipes.md")
           ->type_name("FILE");
       v.add_flag("--print-recipe", f.print_recipe, "print the whole pipeline and all options as a recipe, and end");
       light(v, f);
       small_gltf(v, f);
       placing(v, f);
       vrml_output(v, f);
       files(v, f);
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
       v.add_flag("--recognise", f.recognise,
                  "parts that are cylinders, boxes, elbows and the like share one of unit size; round walls become "
                  "smooth; see wrlkit passes recognise");
       pipeline(v, f);
       small_gltf(v, f);
       for (const char* name : {"--compress", "--extras", "--texture-format", "--names"})
         v.get_option(name)->default_str("as the profile");
       v.get_option("--profile")->default_str("three");
       files(v, f);
       placing(v, f);
       in_place(v, f);
     },
     run_optimize},
    {"info", "what is inside: nodes, triangles, bounds, textures, lights",
     "wrlkit info plant.wrl --json\n  wrlkit info plant.wrl --recognise\n  wrlkit info plant/",
     [](CLI::App& v, Flags& f) {
       v.add_option("IN", f.inputs, "worlds, folders, globs, @FILE: a list of worlds; - is standard input")->required();
       v.add_flag("--recognise", f.recognise,
                  "what the parts are, too: how many cylinders, boxes, elbows and the like, and their share of the "
                  "triangles; see wrlkit passes recognise");
       placing(v, f);
     },
     run_info},
    {"check", "faults and doubtful places of worlds", "wrlkit check *.wrl\n  wrlkit check old/ --quick",
     [](CLI::App& v, Flags& f) {
       v.add_option("IN", f.inputs, "worlds, folders, globs, @FILE: a list of worlds; - is standard input")->required();
       v.add_flag("--quick", f.quick, "without geometry and pictures");
       v.add_flag("--parse-only", f.parse_only, "only read them: no values checked, no Inlines followed");
     },
     run_check},
    {"cat", "the world as canonical VRML text", "wrlkit cat plant.wrl.gz | less",
     [](CLI::App& v, Flags& f) {
       input(v, f);
       v.add_option("-o,--output", f.output, "file instead of standard output");
       pipeline(v, f);
       vrml_output(v, f);
       files(v, f);
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
                    "N pictures around the middle of the world: OUT_000.png, OUT_001.png, ..., or of OUT.webp "
                    "one animation")
           ->check(CLI::Range(1, 3600))
           ->type_name("N");
       v.add_option("--width", f.width, "pixels; in a contact sheet 320 by default")
           ->check(CLI::Range(1, 16384))
           ->capture_default_str();
       v.add_option("--height", f.height, "pixels; in a contact sheet 240 by default")
           ->check(CLI::Range(1, 16384))
           ->capture_default_str();
       v.add_option("--samples", f.samples, "samples a pixel, along each side; beyond 16 for --mode path only")
           ->check(CLI::Range(1, 64))
           ->capture_default_str();
       level(v, f);
       pictures(v, f);
       pipeline(v, f);
       placing(v, f);
     },
     run_render},
    {"simplify",
     "the world at falling numbers of triangles, a file each, and all of them as levels of detail in one file",
     "wrlkit simplify valve.wrl --every 1000 -o out/\n  wrlkit simplify valve.wrl --ratios 0.5,0.25 -o out/\n  wrlkit "
     "simplify valve.wrl --ratios 0.1 -o valve.glb\n  wrlkit simplify valve.wrl --error 1mm,5mm -o out/\n  wrlkit "
     "simplify valve.wrl --progressive -o out/",
     [](CLI::App& v, Flags& f) {
       input(v, f);
       v.add_option("-o,--output", f.output,
                    "folder for the files; or one .glb, .gltf, .wrl or .x3d file: the simplified world or, for several "
                    "numbers of "
                    "triangles, one world with levels of detail")
           ->required()
           ->type_name("DIR|FILE");
       v.add_option("--every", f.every, "a file for every N triangles removed: at the multiples of N")
           ->check(CLI::Range(1, 1'000'000'000))
           ->type_name("N");
       v.add_option("--counts", f.counts, "a file at each of these numbers of triangles")
           ->delimiter(',')
           ->check(CLI::Range(std::size_t{1}, std::size_t{1'000'000'000}));
       v.add_option("--ratios", f.ratios, "a file at each of these shares of the triangles")
           ->delimiter(',')
           ->transform(a_share());
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
       files(v, f);
       placing(v, f);
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
       v.add_option("--counts", f.counts, "numbers of triangles to compare at")
           ->delimiter(',')
           ->check(CLI::Range(std::size_t{1}, std::size_t{1'000'000'000}));
       v.add_option("--ratios", f.ratios, "instead, shares of the triangles; default 0.5,0.25,0.1,0.05,0.02,0.01")
           ->delimiter(',')
           ->transform(a_share());
       v.add_option("--criteria", f.criteria, "criteria to compare; default: all")
           ->delimiter(',')
           ->check(a_criterion());
       v.add_flag("--bare", f.bare, "the criterion alone decides: creases and borders are edges like others");
       v.add_option("--size", f.picture_size, "pixels along each side of a picture")
           ->check(CLI::Range(16, 2048))
           ->capture_default_str();
       level(v, f);
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
       method(v, f);
       v.add_option("--samples", f.light_samples, "rays a patch: the error falls with their square root or faster")
           ->check(CLI::Range(1, 1'000'000))
           ->capture_default_str();
       v.add_option("--max-edge", f.max_edge,
                    "longest edge of a patch: 5cm, 0.05; default: what gives about twenty thousand patches")
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
       v.add_option("--emission", f.emission, "factor for the light that emissiveColor gives off")
           ->check(CLI::NonNegativeNumber)
           ->capture_default_str();
       v.add_option("--seed", f.seed, "of the random numbers: the same seed gives the same file")
           ->capture_default_str();
       placing(v, f);
     },
     run_illuminate, ".xml .xml.gz"},
    {"tiles",
     "worlds of any size as 3D Tiles, with levels of detail whose errors are measured; parts are found by their names "
     "at every level",
     "wrlkit tiles plant.wrl -o tiles/\n  wrlkit tiles plant/ -o tiles/ --compress draco\n  wrlkit tiles @units.txt -o "
     "tiles/ --at 50.1,8.6,112,30",
     [](CLI::App& v, Flags& f) {
       v.add_option("IN", f.inputs, "worlds, folders, globs, @FILE: a list of worlds; -: such a list on standard input")
           ->required();
       v.add_option("-o,--output", f.output, "folder for tileset.json and the tiles")->required()->type_name("DIR");
       globs(v, f);
       tiles(v, f);
       placing(v, f);
     },
     run_tiles, "", "tileset.json"},
    {"view",
     "a page to look at the world, to compare two, or a gallery of many: one HTML file that needs no other and no "
     "network; or at tiles, which it loads from next to it",
     "wrlkit view plant.wrl -o plant.html\n  wrlkit view plant.wrl simpler.wrl -o compared.html\n  wrlkit view "
     "archive/ -o gallery.html\n  wrlkit view valve.wrl -o valve.html --criteria length-normal,melax\n  wrlkit view "
     "plant.wrl --serve\n  wrlkit view tiles/ --serve\n  wrlkit view tiles/ -o tiles/index.html",
     [](CLI::App& v, Flags& f) {
       v.add_option("IN", f.inputs,
                    "the world, or two worlds to be compared; a folder with a tileset.json; for a gallery more worlds, "
                    "folders, globs, @FILE: a list of worlds")
           ->required();
       v.add_option("-o,--output", f.output, "file.html; - is standard output")->type_name("FILE");
       v.add_flag("--serve", f.serve,
                  "show the page at an address of this machine, which nobody else can reach, until it is interrupted");
       v.add_option("--limit", f.limit, "most worlds of a gallery; the rest is counted")
           ->check(CLI::Range(1, 100'000))
           ->capture_default_str();
       v.add_option("--criteria", f.criteria,
                    "criteria whose collapses are shown step by step; default: three for a single world of up to "
                    "300,000 triangles")
           ->delimiter(',')
           ->check(a_criterion());
       pipeline(v, f);
       placing(v, f);
     },
     run_view, ".html"},
    {"corpus-run",
     "one recipe over many files, in worker processes: what breaks one file harms no other; what was done before is "
     "not "
     "done again",
     "wrlkit corpus run recipes/plant-web.toml plant/ -o web/\n  wrlkit corpus run recipes/archive.toml 'old/**/*.wrl' "
     "@more.txt -o new/ --jobs 8 --memory 32G --timeout 5m\n  wrlkit corpus run recipe.toml plant/ -o web/ --shard 2/8",
     [](CLI::App& v, Flags& f) {
       corpus_inputs(v, f);
       timeout(v, f, "a file that takes longer is given up: 90s, 10m, 2h")->capture_default_str();
       v.add_option("--joblog", f.joblog, "a line for each file as GNU parallel writes them, behind what is there")
           ->type_name("FILE");
       v.add_option(
            "--bundle", f.bundle,
            "number of small files that share a worker, one after the other; 16 by default, 1 (each has its own) with "
            "passes in Python")
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
       v.add_option("-o,--output", f.outputs, "file.html, .csv or .json; several times; default OUT/report.html")
           ->type_name("FILE");
       v.add_option("--compare", f.compare, "the folder of another run, before this one")->type_name("DIR");
       v.add_option("--looks", f.looks, "of how many worlds, at the most, surfaces are compared and pictures drawn")
           ->check(CLI::Range(0, 1'000'000))
           ->capture_default_str();
     },
     run_corpus_report, ".html .csv .json"},
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
    {"docs", "a page of the documentation that is made from the tables; without PAGE their names", "wrlkit docs nodes",
     [](CLI::App& v, Flags& f) {
       std::vector<std::string> names;
       for (const auto& page : documentation_pages()) names.emplace_back(page.name);
       v.add_option("PAGE", f.name, "one of the pages")->check(one_of(names));
     },
     run_docs},
    {"completion", "what completes commands of wrlkit in a shell", "source <(wrlkit completion bash)",
     [](CLI::App& v, Flags& f) {
       v.add_option("SHELL", f.name, "bash, zsh or fish")->required()->check(one_of({"bash", "zsh", "fish"}));
     },
     run_completion},
    {"manual", "the manual, for man", "wrlkit manual | man -l -", [](CLI::App&, Flags&) {}, run_manual},
};

}  // namespace

std::span<const Verb> verbs() { return all_verbs; }

const Verb* find_verb(std::string_view name) {
  const auto i = std::ranges::find(all_verbs, name, &Verb::name);
  return i == std::end(all_verbs) ? nullptr : &*i;
}

}  // namespace wrlkit::cli
