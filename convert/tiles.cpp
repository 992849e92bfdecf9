#include "convert/tiles.h"

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <functional>
#include <iterator>
#include <mutex>
#include <set>
#include <unordered_map>

#include "base/hashing.h"
#include "base/parallel.h"
#include "base/stop.h"
#include "convert/tiles/cell_keys.h"
#include "convert/tiles/coarser.h"
#include "convert/tiles/content.h"
#include "convert/tiles/input_pieces.h"
#include "convert/tiles/kept_tiles.h"
#include "convert/tiles/option_key.h"
#include "convert/tiles/plan.h"
#include "convert/tiles/staging.h"
#include "convert/tiles/surface_error.h"
#include "convert/tiles/tree.h"
#include "geometry/space_cells.h"
#include "writers/gltf/tolerance.h"

namespace wrlkit {
namespace tiles {
namespace {

namespace fs = std::filesystem;

constexpr std::size_t tiles_at_once = 16;
// Distances are taken at points, and the largest may lie between them.
constexpr double between_points = 1.05;
// Of a coarse tile that is off by so much anyway, vertices may be moved by a share of that; but a tile has some steps.
constexpr double share_of_error = 1. / 8, least_steps = 2048;

class Making {
 public:
  Making(const std::string& folder, const TilesOptions& options, Document& reader)
      : folder_(folder), options_(options), reader_(reader), ctx_(reader.context()) {
    gltf_ = gltf_options(options.save, true);
    gltf_.names = GltfOptions::Names::table;
    gltf_.extras = gltf_.facts_only = false;
    gltf_.lights = gltf_.cameras = gltf_.animations = false;
  }

  TilesMade run(std::span<const TilesInput> inputs) {
    bool made = false;
    try {
      const StopScope scope(ctx_.stop);
      made = open() && input_.read(inputs, out_) && make_all();
    } catch (const Stopped&) {
    }
    out_.ending = reader_.ending(made);
    return std::move(out_);
  }

 private:
  bool open() {
    if (!staging_.open(folder_, ctx_.diag)) return false;
    if (!kept_.open((fs::path(folder_) / ".wrlkit").string(), {options_.shard, options_.shards}, ctx_.diag))
      return false;
    return input_.open(staging_.path());
  }

  bool make_all();
  void plan();
  void take_kept();
  bool is_mine(std::uint32_t cell) const;
  bool is_whole() const;
  bool make_levels();
  /// Cells of which all coarse tiles are made at once.
  struct Group {
    std::vector<Piece> pieces;  // of what they are made from; in the end without meshes
    std::size_t n_drawn = 0;
    std::vector<std::vector<std::uint32_t>> levels;        // cells, those that are deepest first
    std::unordered_map<std::uint32_t, PieceRange> ranges;  // of each cell, in the pieces
  };
  bool make_group(std::uint32_t top);
  Group gather_group(std::uint32_t top);
  static std::vector<Piece> pieces_within(const Group& group, std::span<const Coarse> level, PieceRange range);
  bool make_coarse(std::uint32_t cell, std::vector<Piece> pieces, Task& task);
  bool write_tile(std::uint32_t cell, std::span<const Piece> pieces, Task& task);
  bool save(std::uint32_t cell, Task& task);
  std::vector<Piece> pieces_of_cell(std::uint32_t cell) const;
  bool measure(std::uint32_t cell, Task& task);
  bool measure_rest();
  double tolerance_of(const Tile& tile, double extent) const;
  double measured_error(std::uint32_t cell) const;
  std::vector<std::size_t> shown_parts() const;
  bool publish();
  /// Calls f(i, task) for some of them at a time; false when one has failed.
  bool for_each(std::span<const std::uint32_t> cells, const std::function<bool(std::uint32_t, Task&)>& f);

  const std::string& folder_;
  const TilesOptions& options_;
  Document& reader_;
  PassContext& ctx_;
  GltfOptions gltf_;
  Staging staging_;
  KeptTiles kept_;
  std::mutex keeping_;  // kept_
  InputPieces input_{reader_, options_.triangles, options_.passes, folder_};
  Cells cells_;
  std::vector<Tile> made_;  // by cell
  Plan plan_{cells_, made_, options_};
  std::vector<std::uint32_t> turns_;  // by cell: leaves are counted, and of the others the largest that fit
  bool is_last_ = false;              // of the shards
  TilesMade out_;
};

bool Making::for_each(std::span<const std::uint32_t> cells, const std::function<bool(std::uint32_t, Task&)>& f) {
  std::mutex mutex;
  bool good = true;
  for (std::size_t begin = 0; begin < cells.size() && good; begin += tiles_at_once) {
    const auto some = cells.subspan(begin, std::min(tiles_at_once, cells.size() - begin));
    std::vector<Diagnostics> said(some.size());
    parallel_for(some.size(), [&](std::size_t i) {
      Statistics counts;
      Task task{said[i], counts, nullptr, ctx_.stop};
      const bool done = f(some[i], task);
      const std::scoped_lock lock(mutex);
      good &= done;
      if (ctx_.monitor) ctx_.monitor->step();
    });
    for (const auto& diag : said) say(said_in(diag), ctx_.diag);
  }
  return good;
}

bool Making::make_all() {
  plan();
  take_kept();
  for (const auto& tile : made_) out_.n_kept += tile.is_made;
  if (!make_levels() || !measure_rest()) return false;
  if (options_.shards > 1) {
    is_last_ = kept_.become_last();
    take_kept();
    is_last_ = is_last_ && is_whole();
    for (const auto& tile : made_) out_.n_left += !tile.is_made;
    if (!is_last_) return true;
    if (!make_levels() || !measure_rest()) return false;
  }
  out_.whole = publish();
  return out_.whole;
}

/// What there is to be made.
void Making::plan() {
  cells_ = planned_cells(input_.entries(), input_.looks(), options_);
  made_.resize(cells_.cells.size());
  for (std::uint32_t i = 0; i < made_.size(); ++i) {
    const Cell& c = cells_.cells[i];
    for (auto k = c.begin; k < c.end; ++k) {
      const auto& entry = input_.entries()[cells_.order[k]];
      made_[i].n_full += entry.n_drawn;
      made_[i].n_stored += entry.bytes;
      if (c.children.empty()) made_[i].full_box.unite(entry.box);
    }
  }
  const auto top = [this](std::uint32_t i) { return plan_.top_of(i); };
  const auto keys = keys_of_cells(cells_, input_.entries(), input_.looks(), option_key(options_), top);
  std::uint32_t n_leaves = 0, n_tops = 0;
  for (std::uint32_t i = 0; i < made_.size(); ++i) {
    made_[i].key = keys[i];
    const bool is_leaf = plan_.is_leaf(i);
    turns_.push_back(is_leaf ? n_leaves++ : plan_.top_of(i) == i ? n_tops++ : turns_[plan_.top_of(i)]);
  }
}

/// What was made before, by whomever.
void Making::take_kept() {
  if (options_.program.empty() && !is_last_) return;
  for (auto& tile : made_) {
    if (!tile.error) tile.error = kept_.error(tile.key);
    const MadeTile* found = tile.is_made ? nullptr : kept_.find(tile.key);
    if (!found) continue;
    tile.made = *found;
    tile.is_made = true;
    say(tile.made.said, ctx_.diag);
  }
}

/// Whether this process makes a tile when it is not there.
bool Making::is_mine(std::uint32_t cell) const {
  if (options_.shards <= 1 || is_last_) return true;
  const bool is_leaf = plan_.is_leaf(cell);
  return (is_leaf || plan_.fits(cell)) && turns_[cell] % options_.shards == options_.shard;
}

/// Whether all is there that shards make apart from one another.
bool Making::is_whole() const {
  for (std::uint32_t i = 0; i < made_.size(); ++i)
    if (!made_[i].is_made && (plan_.is_leaf(i) || plan_.fits(i))) return false;
  return true;
}

bool Making::make_levels() {
  std::vector<std::uint32_t> leaves, tops;
  std::size_t n_tiles = 0;
  for (auto i = static_cast<std::uint32_t>(made_.size()); i-- > 0;) {
    if (made_[i].is_made || !is_mine(i)) continue;
    ++n_tiles;
    if (plan_.is_leaf(i))
      leaves.push_back(i);
    else
      tops.push_back(plan_.top_of(i));
  }
  if (ctx_.monitor && n_tiles > 0) ctx_.monitor->begin("making tiles", n_tiles, "tiles");
  const auto make_leaf = [&](std::uint32_t i, Task& task) {
    return write_tile(i, pieces_of_cell(i), task) && save(i, task);
  };
  if (!for_each(leaves, make_leaf)) return false;
  // From the last level on, cells come before those that they are in.
  std::ranges::sort(tops, std::greater{});
  tops.erase(std::unique(tops.begin(), tops.end()), tops.end());
  return std::ranges::all_of(tops, [&](std::uint32_t i) { return make_group(i); });
}

/// The coarse tiles from a cell downwards, as far as they are not made: all levels of one that fits, from the full
/// pieces; of a larger one itself, from its children.
bool Making::make_group(std::uint32_t top) {
  Group group = gather_group(top);
  std::vector<CoarseLevel> levels;
  for (const auto& cells : group.levels) {
    const auto count = plan_.fits(top) ? plan_.count_of(cells, group.n_drawn) : plan_.target(top);
    auto& level = levels.emplace_back(CoarseLevel{count, {}});
    for (const auto i : cells) level.cells.push_back(group.ranges.at(i));
  }
  auto coarse = coarser(group.pieces, levels, options_.triangles, input_.looks(), ctx_);
  for (auto k = group.levels.size(); k-- > 0;) {
    const auto make = [&](std::uint32_t i, Task& task) {
      return make_coarse(i, pieces_within(group, coarse[k], group.ranges.at(i)), task);
    };
    std::vector<std::uint32_t> open;
    for (const auto i : group.levels[k])
      if (!made_[i].is_made) open.push_back(i);
    if (!for_each(open, make)) return false;
    coarse[k].clear();
  }
  return true;
}

Making::Group Making::gather_group(std::uint32_t top) {
  Group out;
  const auto depth_of = [&](std::uint32_t i) { return cells_.cells[i].depth - cells_.cells[top].depth; };
  const bool all = plan_.fits(top);
  for (const auto i : plan_.cells_below(top)) {
    const Cell& c = cells_.cells[i];
    const bool is_source = all ? c.children.empty() : c.parent == top && i != top;
    if (is_source) {
      const auto begin = static_cast<std::uint32_t>(out.pieces.size());
      std::ranges::move(pieces_of_cell(i), std::back_inserter(out.pieces));
      // All cells that it is in.
      for (auto above = c.parent;; above = cells_.cells[above].parent) {
        auto& range = out.ranges.try_emplace(above, begin, begin).first->second;
        range.second = static_cast<std::uint32_t>(out.pieces.size());
        if (above == top) break;
      }
    } else if (!c.children.empty() && (all || i == top)) {
      out.levels.resize(std::max<std::size_t>(out.levels.size(), depth_of(i) + 1));
      out.levels[depth_of(i)].push_back(i);
    }
  }
  // The finest level first: counts fall.
  std::ranges::reverse(out.levels);
  for (const auto& p : out.pieces) out.n_drawn += n_drawn(p.mesh);
  return out;
}

/// Of a full tile in the order of the files, so that pieces of a part stand together.
std::vector<Piece> Making::pieces_of_cell(std::uint32_t cell) const {
  const Cell& c = cells_.cells[cell];
  if (!c.children.empty()) return read_pieces(kept_.pieces_path(made_[cell].key));
  std::vector<std::uint32_t> order(cells_.order.begin() + c.begin, cells_.order.begin() + c.end);
  std::ranges::sort(order);
  std::vector<Piece> out;
  for (const auto i : order) out.push_back(input_.piece(i));
  return out;
}

std::vector<Piece> Making::pieces_within(const Group& group, std::span<const Coarse> level, PieceRange range) {
  std::vector<Piece> out;
  const auto first = std::ranges::lower_bound(level, range.first, {}, &Coarse::from);
  for (auto i = first; i != level.end() && i->from < range.second; ++i) {
    const Piece& from = group.pieces[i->from];
    out.push_back({from.name, from.look, from.source_size, i->mesh});
  }
  return out;
}

bool Making::make_coarse(std::uint32_t cell, std::vector<Piece> pieces, Task& task) {
  std::size_t drawn = 0;
  for (const auto& p : pieces) drawn += n_drawn(p.mesh);
  if (const auto most = options_.triangles; drawn > most) {
    const CoarseLevel level{most, {{0, static_cast<std::uint32_t>(pieces.size())}}};
    auto coarse = coarser(pieces, {&level, 1}, most, input_.looks(), task);
    std::vector<Piece> fewer;
    for (auto& c : coarse[0]) {
      const Piece& from = pieces[c.from];
      fewer.push_back({from.name, from.look, from.source_size, std::move(c.mesh)});
    }
    pieces = std::move(fewer);
  }
  auto& stored = made_[cell].made.pieces_bytes;
  stored = write_pieces(kept_.pieces_path(made_[cell].key), pieces);
  if (!stored) task.diag.report(Diag::cannot_write, {}, folder_, "the disk is full");
  return stored && measure(cell, task) && write_tile(cell, pieces, task) && save(cell, task);
}

/// How far a coarse tile is from the full ones, which is written down.
bool Making::measure(std::uint32_t cell, Task& task) {
  Tile& tile = made_[cell];
  if (tile.error) return true;
  tile.error = measured_error(cell);
  const std::scoped_lock lock(keeping_);
  const bool saved = kept_.save_error(tile.key, *tile.error);
  if (!saved) task.diag.report(Diag::cannot_write, {}, folder_, "the disk is full");
  return saved;
}

/// Writes down that a tile is made.
bool Making::save(std::uint32_t cell, Task& task) {
  Tile& tile = made_[cell];
  tile.made.said = said_in(task.diag);
  tile.is_made = true;
  const std::scoped_lock lock(keeping_);
  const bool saved = kept_.save(tile.key, tile.made);
  if (!saved) task.diag.report(Diag::cannot_write, {}, folder_, "the disk is full");
  return saved;
}

bool Making::write_tile(std::uint32_t cell, std::span<const Piece> pieces, Task& task) {
  Tile& tile = made_[cell];
  MadeTile& made = tile.made;
  std::set<std::string_view> names;
  for (const auto& p : pieces) {
    made.box.unite(box_of_corners(p.mesh));
    names.insert(p.name);
  }
  if (pieces.empty()) return true;
  auto gltf = gltf_;
  gltf.compression.tolerance = tolerance_of(tile, diagonal(made.box));
  // A fifth of what quantisation may move a vertex by, which has the rest.
  const double tolerance = gltf.compression.tolerance / 5;
  auto repeats = gltf_.gpu_instancing ? repeats_of(pieces, tolerance) : std::vector<Repeat>();
  GltfSummary summary;
  const auto path = kept_.tile_path(tile.key);
  // What is seen from afar can do with smaller pictures; full tiles have them as they are.
  const ContentBudget budget{options_.draws, plan_.is_leaf(cell) ? ~std::uint64_t{0} : options_.bytes};
  if (!write_content(pieces, std::move(repeats), origin_of(made.box), input_.looks(), gltf, budget, input_.pictures(),
                     path, task.diag, summary))
    return false;
  std::error_code fault;
  made.bytes = fs::file_size(path, fault);
  made.rounding = summary.quantization.position + summary.quantization.rounding;
  if (summary.instances > 0) made.rounding += summary.quantization.placement + tolerance;
  made.hash = hash_of_file(path).value_or(ContentHash{}).low;
  made.triangles = summary.triangles;
  made.draws = summary.draws;
  made.parts = names.size();
  return true;
}

/// How far quantisation may move a vertex of a tile that is that large: of a coarse one by a share of what it is off.
double Making::tolerance_of(const Tile& tile, double extent) const {
  const auto& given = gltf_.compression;
  const double full = gltf::tolerance_for(given, extent);
  if (given.tolerance > 0 || given.method == GltfCompression::Method::none) return full;
  return std::max(full, std::min(share_of_error * tile.error.value_or(0), extent / least_steps));
}

/// The errors of coarse tiles that are this process's matter, and that were not written down before it was killed.
bool Making::measure_rest() {
  std::vector<std::uint32_t> open;
  for (std::uint32_t i = 0; i < made_.size(); ++i)
    if (!plan_.is_leaf(i) && made_[i].is_made && !made_[i].error && is_mine(i)) open.push_back(i);
  if (ctx_.monitor && !open.empty()) ctx_.monitor->begin("measuring tiles", open.size(), "tiles");
  return for_each(open, [&](std::uint32_t i, Task& task) { return measure(i, task); });
}

double Making::measured_error(std::uint32_t cell) const {
  std::vector<FullTile> full;
  Box whole;
  std::vector<std::uint32_t> open{cell};
  while (!open.empty()) {
    const auto i = open.back();
    open.pop_back();
    const auto& children = cells_.cells[i].children;
    open.insert(open.end(), children.rbegin(), children.rend());
    whole.unite(made_[i].full_box);
    if (children.empty()) full.push_back({made_[i].full_box, [this, i] { return pieces_of_cell(i); }});
  }
  const double error = surface_error(pieces_of_cell(cell), full);
  return std::isfinite(error) ? between_points * error : diagonal(whole);
}

/// How many names are seen where all tiles of a level are, and full ones that have none there.
std::vector<std::size_t> Making::shown_parts() const {
  std::vector<std::size_t> out;
  for (std::uint32_t depth = 0; depth <= cells_.depth; ++depth) {
    std::vector<std::uint64_t> names;
    for (std::uint32_t i = 0; i < made_.size(); ++i) {
      const Cell& c = cells_.cells[i];
      if (plan_.is_leaf(i) && c.depth <= depth)
        for (auto k = c.begin; k < c.end; ++k) names.push_back(input_.entries()[cells_.order[k]].name);
      else if (!plan_.is_leaf(i) && c.depth == depth)
        std::ranges::copy(read_names(kept_.pieces_path(made_[i].key)), std::back_inserter(names));
    }
    std::ranges::sort(names);
    out.push_back(static_cast<std::size_t>(std::unique(names.begin(), names.end()) - names.begin()));
  }
  return out;
}

bool Making::publish() {
  finish_tree(cells_, made_);
  if (!link_tiles(cells_, made_, kept_, staging_.path(), ctx_.diag)) return false;
  std::uint64_t hash = 0;
  std::vector<ContentHash> keys;
  for (std::size_t i = 0; i < made_.size(); ++i) {
    const auto& [cell, tile, made] = std::tie(cells_.cells[i], made_[i], made_[i].made);
    hash = mixed(hash, made.hash);
    keys.push_back(tile.key);
    out_.tiles.push_back(
        {file_of(cell, tile), cell.depth, tile.said_error, made.triangles, made.draws, made.parts, made.bytes});
    out_.bytes += made.bytes;
    out_.n_over += made.draws > options_.draws || made.bytes > options_.bytes;
  }
  out_.depth = cells_.depth;
  out_.shown = shown_parts();
  const auto name = tiles_folder(hash);
  auto set = tileset_of(cells_, made_, name);
  set.place = options_.place;
  set.tiles_in_file = options_.tiles_in_file;
  const auto files = tileset_files(set);
  for (const auto& file : files) out_.bytes += file.text.size();
  out_.n_descriptions = files.size();
  if (!write_descriptions(std::span(files).subspan(1), staging_.path(), ctx_.diag)) return false;
  if (!staging_.publish(name, files[0].text, ctx_.diag)) return false;
  options_.update ? kept_.forget_others(keys) : kept_.forget();
  return true;
}

}  // namespace
}  // namespace tiles

std::size_t triangles_within(std::uint64_t memory) {
  constexpr std::uint64_t program = 150 << 20, of_triangle = 350;
  const TilesOptions usual;
  const auto n = memory > program ? (memory - program) / of_triangle : 0;
  return std::clamp<std::size_t>(n, 3 * usual.triangles, usual.at_once);
}

TilesMade make_tiles(std::span<const TilesInput> inputs, const std::string& folder, const TilesOptions& options,
                     Document& reader) {
  return tiles::Making(folder, options, reader).run(inputs);
}

}  // namespace wrlkit
