// wrlkit tiles: scenes of any size as 3D Tiles.
#include "convert/tiles.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <set>

#include "base/text/amounts.h"
#include "base/text/json.h"
#include "tools/cli/documents.h"
#include "tools/cli/inputs.h"
#include "tools/cli/print_diagnostics.h"
#include "tools/cli/recipe.h"
#include "tools/cli/session.h"
#include "tools/corpus/conversion.h"

namespace wrlkit {
namespace {

/// Nothing, which was printed, when there is no file. `code` becomes that of what was left out.
std::vector<TilesInput> inputs_of(const Flags& flags, int& code) {
  std::string why;
  const InputRules rules{.include = flags.include, .exclude = flags.exclude, .base = {}, .output = flags.output};
  const auto found = gather_inputs(flags.inputs, rules, why);
  if (!found) complain("tiles", why);
  std::vector<TilesInput> out;
  if (!found) return out;
  code = print_left_out("tiles", found->left_out, found->passed_over);
  std::set<std::string> inside;
  for (const auto& file : found->files) inside.insert(file.inside);
  const bool differ = inside.size() == found->files.size();
  for (const auto& file : found->files) out.push_back({file.path, differ ? file.inside : file.path});
  return out;
}

bool is_input(const Flags& flags, const std::string& folder) {
  std::error_code none;
  return std::ranges::any_of(flags.inputs, [&](const std::string& word) {
    return std::filesystem::is_directory(word, none) && std::filesystem::equivalent(word, folder, none);
  });
}

/// Nothing, which was printed, when --shard is not valid.
std::optional<Shard> shard_of(const Flags& flags) {
  std::string why;
  const auto out = flags.shard.empty() ? Shard{} : parse_shard(flags.shard, why);
  if (!out) fmt::print(stderr, "wrlkit tiles: --shard: {}\n", why);
  return out;
}

TilesOptions options_of(const Flags& flags, Shard shard) {
  TilesOptions out{.triangles = static_cast<std::size_t>(flags.tile_triangles),
                   .draws = static_cast<std::size_t>(flags.tile_draws),
                   .bytes = size_of(flags.tile_bytes),
                   .save = flags.save,
                   .program = program_identity(),
                   .shard = shard.index,
                   .shards = shard.count};
  out.update = flags.update;
  out.passes = flags.pipeline;
  if (!flags.memory.empty()) out.at_once = triangles_within(size_of(flags.memory));
  out.tiles_in_file = static_cast<std::size_t>(flags.tileset_tiles);
  if (!flags.is_given("compress")) out.save.compress = GltfCompression::Method::meshopt;
  if (!flags.is_given("gpu-instancing")) out.save.gpu_instancing = true;
  if (flags.at.size() < 3) return out;
  out.place = {flags.at[0], flags.at[1], flags.at[2], flags.at.size() > 3 ? flags.at[3] : 0};
  return out;
}

/// All tiles of one distance from the root.
struct Level {
  std::size_t n_tiles = 0, triangles = 0, draws = 0;  // draws: of one tile, at most
  std::size_t parts = 0;                              // that are shown, with the full tiles above
  std::uint64_t bytes = 0;
  double error = 0;

  void fields(auto&& f) const {
    f("tiles", n_tiles);
    f("parts", parts);
    f("triangles", triangles);
    f("draws", draws);
    f("bytes", bytes);
    f("error", error);
  }
};

std::vector<Level> levels_of(const TilesMade& made) {
  std::vector<Level> out(made.depth + 1);
  for (std::size_t i = 0; i < out.size(); ++i) out[i].parts = made.shown[i];
  for (const auto& tile : made.tiles) {
    auto& level = out[tile.depth];
    ++level.n_tiles;
    level.triangles += tile.triangles;
    level.draws = std::max(level.draws, tile.draws);
    level.bytes += tile.bytes;
    level.error = std::max(level.error, tile.error);
  }
  return out;
}

std::string text_of(const TilesMade& made, const std::string& folder) {
  if (!made.whole)
    return fmt::format("{}: this shard has made its tiles; other shards make {}\n", folder,
                       counted(made.n_left, "tile"));
  auto out = fmt::format("{} -> {}: {}, {} bytes\n  {}, {}\n", counted(made.n_files, "file"),
                         (std::filesystem::path(folder) / "tileset.json").string(), counted(made.tiles.size(), "tile"),
                         made.bytes, counted(made.triangles, "triangle"), counted(made.parts, "part"));
  out += fmt::format("{:>7}  {:>6}  {:>8}  {:>11}  {:>13}  {:>11}  {:>11}\n", "level", "tiles", "parts", "triangles",
                     "draws, most", "bytes", "error (m)");
  const auto levels = levels_of(made);
  for (std::size_t i = 0; i < levels.size(); ++i) {
    const auto& level = levels[i];
    out += fmt::format("{:>7}  {:>6}  {:>8}  {:>11}  {:>13}  {:>11}  {:>11.4g}\n", i, level.n_tiles, level.parts,
                       level.triangles, level.draws, level.bytes, level.error);
  }
  if (made.n_kept > 0) out += fmt::format("  tiles that were made before: {} of {}\n", made.n_kept, made.tiles.size());
  out += fmt::format("  the root shows {} of {} parts\n", made.tiles[0].parts, made.parts);
  if (made.n_descriptions > 1) out += fmt::format("  files that describe tiles: {}\n", made.n_descriptions);
  if (made.n_over > 0) out += fmt::format("  tiles above the budget of draws or bytes: {}\n", made.n_over);
  if (made.n_failed > 0) out += fmt::format("  files that could not be read: {}\n", made.n_failed);
  if (!made.inlined.empty())
    out += fmt::format("  files that others inline, shown as those show them and not by themselves: {} ({}{})\n",
                       made.inlined.size(), made.inlined[0], made.inlined.size() > 1 ? ", ..." : "");
  if (made.n_cut > 0) out += fmt::format("  pieces of surfaces that are too large for a tile: {}\n", made.n_cut);
  if (made.lost.empty()) return out;
  out += "  lost, for tiles have no place for them:";
  for (const auto& [name, n] : made.lost) out += fmt::format("{} {} {}", out.back() == ':' ? "" : ",", n, name);
  out += '\n';
  return out;
}

void write_tile(JsonOut& json, const TileFigures& tile) {
  json.object("file", tile.file, "level", tile.depth, "error", tile.error, "triangles", tile.triangles, "draws",
              tile.draws, "parts", tile.parts, "bytes", tile.bytes);
}

std::string json_of(const TilesMade& made) {
  std::string out;
  JsonOut json(out);
  json.begin_object();
  json.members("files", made.n_files, "failed", made.n_failed, "inlined", made.inlined, "triangles", made.triangles,
               "parts", made.parts, "bytes", made.bytes, "depth", made.depth, "whole", made.whole, "kept", made.n_kept,
               "left", made.n_left, "descriptions", made.n_descriptions, "over", made.n_over, "cut", made.n_cut, "lost",
               made.lost, "levels", made.whole ? levels_of(made) : std::vector<Level>());
  json.list("tiles", made.tiles, [&](const auto& tile) { write_tile(json, tile); });
  json.end_object();
  return out;
}

/// False, which was printed, when -p is not a pipeline.
bool check_passes(const Flags& flags) {
  std::string why;
  if (flags.pipeline.empty() || Pipeline::parse(flags.pipeline, why)) return true;
  fmt::print(stderr, "wrlkit: -p: {}\n", why);
  return false;
}

/// False, which was printed, when it is not a place on the Earth.
bool check_place(const std::vector<double>& at) {
  if (!at.empty() && at.size() != 3 && at.size() != 4) {
    fmt::print(stderr, "wrlkit tiles: --at: three or four numbers are needed, LAT,LON,HEIGHT[,HEADING]\n");
    return false;
  }
  if (at.empty() || (std::abs(at[0]) <= 90 && std::abs(at[1]) <= 360)) return true;
  fmt::print(stderr, "wrlkit tiles: --at: {},{} is not a valid latitude and longitude\n", at[0], at[1]);
  return false;
}

}  // namespace

int run_tiles(const Flags& given) {
  Flags flags = given;
  flags.load.gltf_in_metres = true;  // among files in other units
  if (flags.output == "-") {
    fmt::print(stderr, "wrlkit tiles: -o: a folder is needed; standard output is none\n");
    return usage;
  }
  if (is_input(flags, flags.output)) {
    fmt::print(stderr, "wrlkit tiles: -o: '{}' is a folder of inputs; the tiles need one of their own\n", flags.output);
    return usage;
  }
  Session s(flags);
  if (!s.good() || !check_passes(flags) || !check_place(flags.at)) return usage;
  const auto shard = shard_of(flags);
  if (!shard) return usage;
  if (flags.is_given("draco-level") && flags.save.compress != GltfCompression::Method::draco && !flags.quiet)
    fmt::print(stderr, "wrlkit tiles: --draco-level has no effect without --compress draco\n");
  int code = done;
  const auto inputs = inputs_of(flags, code);
  if (inputs.empty()) return nothing;
  const auto made = make_tiles(inputs, flags.output, options_of(flags, *shard), s.document());
  s.progress().clear();
  if (!made) return s.end(false);
  s.fact("tiles", json_of(made));
  if (flags.json)
    s.print_json(json_of(made));
  else if (!flags.quiet)
    fmt::print(stderr, "{}", text_of(made, flags.output));
  return s.end(true, nothing, code);
}

}  // namespace wrlkit
