// What the command line can express, as data. cli.cpp fills these from the arguments; the verbs read them.
#pragma once
#include <algorithm>
#include <cstdint>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "convert/options.h"
#include "light/patches/methods.h"
#include "light/render/render.h"

namespace wrlkit {

enum class Headlight : std::uint8_t { automatic, on, off };
template <>
inline constexpr auto choices<Headlight> = choice_row({{"auto", "as NavigationInfo says"}, {"on"}, {"off"}});

struct Flags {
  // every verb
  bool quiet = false, verbose = false, json = false;
  LoadOptions load;
  bool strict_paths = false;          // nothing above the input's folder is read
  std::string report;                 // file for a JSON report
  std::vector<std::string> warnings;  // -Werror=NAME, -Wno-NAME, -Werror
  int jobs = 0;
  std::string memory;  // "8G"

  // what the verb works on
  std::vector<std::string> inputs;
  std::string output;
  std::string name;  // explain, passes

  // convert, cat, render
  std::string pipeline;  // -p; empty: what the format needs
  bool pipeline_given = false;
  bool print_pipeline = false, verify_each = false, time_passes = false, stats = false;
  std::string print_after;
  std::vector<std::string> python;  // files with passes
  SaveOptions save;                 // without the pipeline
  std::string recipe;
  bool print_recipe = false;
  bool can_replace = false;                                             // the verb has --in-place
  std::vector<std::pair<std::string, std::vector<std::string>>> given;  // every option that was given, by name
  bool is_given(std::string_view option) const { return std::ranges::find(given, option, given_name) != given.end(); }
  static constexpr auto given_name = &decltype(given)::value_type::first;
  std::string profile;
  bool print_profile = false;
  bool recognise = false;  // optimize, info

  bool parse_only = false, quick = false;  // check

  // corpus
  std::string format = "glb";  // ending of the outputs
  std::vector<std::string> include, exclude;
  std::string timeout = "10m", shard, base, joblog;
  int bundle = 0;  // 0: as many as are worth it
  bool retry = false, overwrite = false;
  std::vector<std::string> outputs;  // report
  std::string compare;               // and of render: a scene
  int looks = 2000;

  // render
  int width = 1280, height = 960, samples = 4;
  RenderOptions::Mode mode = RenderOptions::Mode::preview;
  LampFall lamps = LampFall::as_written;
  std::string exposure = "1";  // auto or a factor
  std::string viewpoint, level = "0";
  std::vector<double> look_at;  // eye, target, up
  bool fit = false;
  std::vector<double> background;  // r, g, b; empty: the world's
  Headlight headlight = Headlight::automatic;
  int turntable = 0;         // pictures around the world
  double field_of_view = 0;  // degrees; 0: the Viewpoint's

  // simplify, compare-lod
  int every = 0;
  std::vector<std::size_t> counts;
  std::vector<double> ratios;
  std::vector<std::string> errors;  // lengths: 2mm
  std::string criterion;
  double pixels = 1;
  bool progressive = false;

  // illuminate
  light::Method method = light::Method::path;
  std::string max_edge;  // a length: 5cm
  double max_area = 0;   // square metres
  double gradient = 0;
  int light_samples = 256, seed = 1, max_patches = 10'000'000;
  std::string pictures;  // folder
  bool smooth = false;
  double emission = 1;
  std::string sky = "background";

  // tiles
  int tile_triangles = 50'000, tile_draws = 32, tileset_tiles = 500;
  std::string tile_bytes = "4M";
  bool update = false;     // keep what was made, for the next run
  std::vector<double> at;  // latitude, longitude, height, heading

  bool serve = false;  // view
  int limit = 500;     // scenes in a gallery

  std::vector<std::string> criteria;  // compare-lod, view
  bool bare = false;
  int picture_size = 300;
};

/// Exit codes of the product: 0 done, 1 done but something of the input could not be used, 2 wrong usage, 3 nothing
/// made.
enum ExitCode : int { done = 0, partly = 1, usage = 2, nothing = 3 };

int run_convert(const Flags&);
int run_optimize(const Flags&);
int run_info(const Flags&);
int run_check(const Flags&);
int run_cat(const Flags&);
int run_diff(const Flags&);
int run_render(const Flags&);
int run_simplify(const Flags&);
int run_compare_lod(const Flags&);
int run_illuminate(const Flags&);
int run_tiles(const Flags&);
int run_view(const Flags&);
int run_passes(const Flags&);
int run_formats(const Flags&);
int run_explain(const Flags&);
int run_docs(const Flags&);
int run_completion(const Flags&);
int run_manual(const Flags&);
int run_corpus_run(const Flags&);
int run_corpus_plan(const Flags&);
int run_corpus_report(const Flags&);

}  // namespace wrlkit
