#include "convert/tiles.h"

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <mutex>
#include <set>
#include <unordered_map>

#include "base/hashing.h"
#include "base/parallel.h"
#include "base/stop.h"
#include "convert/tiles/cells.h"
#include "convert/tiles/coarser.h"
#include "convert/tiles/content.h"
#include "convert/tiles/scene_pieces.h"
#include "convert/tiles/staging.h"
#include "convert/tiles/surface_error.h"
#include "parsers/resources.h"

namespace wrlkit {
namespace tiles {
namespace {

namespace fs = std::filesystem;

constexpr std::size_t tiles_at_once = 16;
constexpr std::size_t most_at_once = 1'500'000;  // triangles that are simplified together: some 400 MB
constexpr std::size_t least_saving = 3;          // a coarse tile has at most one triangle of that many
// Distances are taken at points, and the largest may lie between them.
constexpr double between_points = 1.05;
constexpr double single_precision = 1.0 / (1 << 22);

/// A cell with what has been made of it.
struct Tile {
  std::uint64_t n_full = 0;               // that is drawn when nothing is simplified
  std::vector<PieceStore::Entry> pieces;  // of a coarse one
  Box own_box;                            // of what it shows itself
  Box box;                                // and of its children
  Vec3 origin{};
  double error = 0;     // metres, of the surface before it was rounded
  double rounding = 0;  // metres
  std::uint64_t hash = 0;
  TileFigures figures;
};

/// Near the middle, in few binary digits.
Vec3 origin_of(const Box& box) {
  const double step = std::exp2(std::floor(std::log2(std::max(diagonal(box), 1e-9))) - 6);
  Vec3 out = box.centre();
  for (double& x : out) x = std::round(x / step) * step;
  return out;
}

std::uint64_t hash_of_file(const std::string& path) {
  std::ifstream file(path, std::ios::binary);
  const std::string bytes((std::istreambuf_iterator<char>(file)), {});
  std::uint64_t hash = mixed(0, bytes.size());
  for (const unsigned char c : bytes) hash = mixed(hash, c);
  return hash;
}

/// Says in `to` what was said in `from`.
void pass_on(const Diagnostics& from, Diagnostics& to) {
  for (const auto& m : from.messages()) {
    const auto& a = m.args;
    if (a.size() == 1) to.report(m.id, {}, a[0]);
    if (a.size() == 2) to.report(m.id, {}, a[0], a[1]);
    if (a.size() == 3) to.report(m.id, {}, a[0], a[1], a[2]);
  }
}

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
      made = open() && gather(inputs) && make_levels() && measure() && publish();
    } catch (const Stopped&) {
    }
    out_.ending = reader_.ending(made);
    return std::move(out_);
  }

 private:
  bool open() {
    if (!staging_.open(folder_, ctx_.diag)) return false;
    std::string why;
    full_ = PieceStore::open(staging_.path(), why);
    coarse_ = PieceStore::open(staging_.path(), why);
    if (full_ && coarse_) return true;
    ctx_.diag.report(Diag::cannot_write, {}, staging_.path(), why);
    return false;
  }

  bool is_full(bool stored) {
    if (!stored) ctx_.diag.report(Diag::cannot_write, {}, folder_, "the disk is full");
    return !stored;
  }

  bool gather(std::span<const TilesInput> inputs);
  bool make_levels();
  using Range = std::pair<std::uint32_t, std::uint32_t>;
  /// Cells of which all coarse tiles are made at once.
  struct Group {
    std::vector<Piece> pieces;  // of what they are made from; in the end without meshes
    std::size_t n_drawn = 0;
    std::vector<std::vector<std::uint32_t>> levels;   // cells, those that are deepest first
    std::unordered_map<std::uint32_t, Range> ranges;  // of each cell, in the pieces
  };
  bool fits(std::uint32_t cell) const;
  std::size_t target(std::uint32_t cell) const;
  std::size_t count_of(std::span<const std::uint32_t> level, std::size_t n_drawn) const;
  bool make_group(std::uint32_t top);
  Group gather_group(std::uint32_t top);
  std::vector<std::uint32_t> cells_below(std::uint32_t top) const;
  static std::vector<Piece> pieces_within(const Group& group, std::span<const Coarse> level, Range range);
  bool make_coarse(std::uint32_t cell, std::vector<Piece> pieces, Task& task);
  bool write_tile(std::uint32_t cell, std::span<const Piece> pieces, Task& task);
  std::vector<PieceStore::Entry> entries_of(const Cell& cell) const;
  std::vector<Piece> read(const PieceStore& from, std::span<const PieceStore::Entry> entries) const;
  std::vector<Piece> pieces_of_cell(std::uint32_t cell) const;
  bool spill(std::uint32_t cell, std::span<const Piece> pieces);
  bool measure();
  double measured_error(std::uint32_t cell) const;
  void finish_errors();
  bool publish();
  /// Calls f(i, task) for some of them at a time; false when one has failed.
  bool for_each(std::span<const std::uint32_t> cells, const std::function<bool(std::uint32_t, Task&)>& f);

  const std::string& folder_;
  const TilesOptions& options_;
  Document& reader_;
  PassContext& ctx_;
  GltfOptions gltf_;
  Staging staging_;
  Looks looks_;
  std::optional<PieceStore> full_, coarse_;
  std::vector<PieceStore::Entry> entries_;  // of full_
  Cells cells_;
  std::vector<Tile> made_;  // by cell
  std::vector<std::string> folders_;
  std::unique_ptr<FileResources> pictures_;
  TilesMade out_;
};

bool Making::gather(std::span<const TilesInput> inputs) {
  std::set<std::string> names;
  bool stored = true;
  SceneCounts counts;
  const auto put = [&](const Piece& piece) {
    PieceStore::Entry entry{};
    stored = full_->add(piece, entry);
    entries_.push_back(entry);
    out_.triangles += piece.mesh.is_triangles() ? piece.mesh.n_faces() : 0;
    names.insert(piece.name);
    return stored;
  };
  for (const auto& input : inputs) {
    check_stop();
    ++out_.n_files;
    const bool read =
        reader_.read(input.path) && pieces_of(reader_, input.name, options_.triangles, looks_, put, counts);
    if (is_full(stored)) return false;
    check_stop();
    out_.n_failed += !read;
    folders_.push_back(fs::path(input.path).parent_path().string());
    out_.parts += names.size();
    names.clear();
  }
  out_.n_cut = counts.n_cut;
  out_.n_lights = counts.n_lights;
  out_.n_routes = counts.n_routes;
  std::ranges::sort(folders_);
  folders_.erase(std::unique(folders_.begin(), folders_.end()), folders_.end());
  pictures_ = std::make_unique<FileResources>(ResourceOptions{.allowed = folders_}, nullptr);
  if (entries_.empty()) ctx_.diag.report(Diag::nothing_drawn, {}, "there is no geometry in any of the files");
  return !entries_.empty();
}

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
    for (const auto& diag : said) pass_on(diag, ctx_.diag);
  }
  return good;
}

bool Making::make_levels() {
  cells_ = cut_into_cells(entries_, options_.triangles);
  made_.resize(cells_.cells.size());
  if (ctx_.monitor) ctx_.monitor->begin("making tiles", made_.size(), "tiles");
  std::vector<std::uint32_t> leaves;
  for (std::uint32_t i = 0; i < made_.size(); ++i) {
    const Cell& c = cells_.cells[i];
    for (auto k = c.begin; k < c.end; ++k) made_[i].n_full += entries_[cells_.order[k]].n_drawn;
    if (c.children.empty()) leaves.push_back(i);
  }
  const auto make_leaf = [&](std::uint32_t i, Task& task) { return write_tile(i, pieces_of_cell(i), task); };
  if (!for_each(leaves, make_leaf)) return false;
  // From the last level on, cells come before those that they are in.
  for (auto i = static_cast<std::uint32_t>(made_.size()); i-- > 0;) {
    const Cell& c = cells_.cells[i];
    const bool is_with_others = fits(i) && i != c.parent && fits(c.parent);
    if (!c.children.empty() && !is_with_others && !make_group(i)) return false;
  }
  return true;
}

/// Whether all that is in a cell can be simplified at once.
bool Making::fits(std::uint32_t cell) const { return made_[cell].n_full <= most_at_once; }

/// What a coarse tile draws, at most.
std::size_t Making::target(std::uint32_t cell) const {
  return std::min<std::uint64_t>(options_.triangles, made_[cell].n_full / least_saving);
}

/// The coarse tiles from a cell downwards, as far as they are not made: all levels of one that fits, from the full
/// pieces; of a larger one itself, from its children.
bool Making::make_group(std::uint32_t top) {
  Group group = gather_group(top);
  std::vector<std::size_t> counts;
  for (const auto& level : group.levels) counts.push_back(fits(top) ? count_of(level, group.n_drawn) : target(top));
  auto coarse = coarser(group.pieces, counts, looks_, ctx_);
  for (auto k = group.levels.size(); k-- > 0;) {
    const auto make = [&](std::uint32_t i, Task& task) {
      return make_coarse(i, pieces_within(group, coarse[k], group.ranges.at(i)), task);
    };
    if (!for_each(group.levels[k], make)) return false;
    coarse[k].clear();
  }
  return true;
}

Making::Group Making::gather_group(std::uint32_t top) {
  Group out;
  const auto depth_of = [&](std::uint32_t i) { return cells_.cells[i].depth - cells_.cells[top].depth; };
  const bool all = fits(top);
  for (const auto i : cells_below(top)) {
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

/// Cells in the order in which a tree is walked.
std::vector<std::uint32_t> Making::cells_below(std::uint32_t top) const {
  std::vector<std::uint32_t> out, open{top};
  while (!open.empty()) {
    const auto i = open.back();
    open.pop_back();
    out.push_back(i);
    const auto& children = cells_.cells[i].children;
    open.insert(open.end(), children.rbegin(), children.rend());
  }
  return out;
}

/// Triangles of a whole group at which the tiles of a level have as many as they may have.
std::size_t Making::count_of(std::span<const std::uint32_t> level, std::size_t n_drawn) const {
  double full = 0, wanted = 0;
  for (const auto i : level) {
    full += static_cast<double>(made_[i].n_full);
    wanted += static_cast<double>(target(i));
  }
  return static_cast<std::size_t>(static_cast<double>(n_drawn) * std::min(1.0, wanted / full));
}
std::vector<Piece> Making::read(const PieceStore& from, std::span<const PieceStore::Entry> entries) const {
  std::vector<Piece> out;
  for (const auto& e : entries) out.push_back(from.read(e));
  return out;
}

/// In the order of the files, so that pieces of a part stand together.
std::vector<PieceStore::Entry> Making::entries_of(const Cell& cell) const {
  std::vector<std::uint32_t> order(cells_.order.begin() + cell.begin, cells_.order.begin() + cell.end);
  std::ranges::sort(order);
  std::vector<PieceStore::Entry> out;
  for (const auto i : order) out.push_back(entries_[i]);
  return out;
}

std::vector<Piece> Making::pieces_of_cell(std::uint32_t cell) const {
  const Cell& c = cells_.cells[cell];
  return c.children.empty() ? read(*full_, entries_of(c)) : read(*coarse_, made_[cell].pieces);
}

bool Making::spill(std::uint32_t cell, std::span<const Piece> pieces) {
  bool stored = true;
  for (const auto& p : pieces) {
    auto& entry = made_[cell].pieces.emplace_back();
    stored &= coarse_->add(p, entry);
  }
  return stored;
}

std::vector<Piece> Making::pieces_within(const Group& group, std::span<const Coarse> level, Range range) {
  std::vector<Piece> out;
  const auto first = std::ranges::lower_bound(level, range.first, {}, &Coarse::from);
  for (auto i = first; i != level.end() && i->from < range.second; ++i)
    out.push_back({group.pieces[i->from].name, group.pieces[i->from].look, i->mesh});
  return out;
}

bool Making::make_coarse(std::uint32_t cell, std::vector<Piece> pieces, Task& task) {
  std::size_t drawn = 0;
  for (const auto& p : pieces) drawn += n_drawn(p.mesh);
  if (const std::size_t most = options_.triangles; drawn > most) {
    auto coarse = coarser(pieces, {&most, 1}, looks_, task);
    std::vector<Piece> fewer;
    for (auto& c : coarse[0]) fewer.push_back({pieces[c.from].name, pieces[c.from].look, std::move(c.mesh)});
    pieces = std::move(fewer);
  }
  if (!spill(cell, pieces)) {
    task.diag.report(Diag::cannot_write, {}, folder_, "the disk is full");
    return false;
  }
  return write_tile(cell, pieces, task);
}

bool Making::write_tile(std::uint32_t cell, std::span<const Piece> pieces, Task& task) {
  const Cell& c = cells_.cells[cell];
  Tile& tile = made_[cell];
  std::set<std::string_view> names;
  for (const auto& p : pieces) {
    tile.own_box.unite(bounds_of(p.mesh));
    names.insert(p.name);
  }
  tile.figures.depth = c.depth;
  if (pieces.empty()) return true;
  tile.origin = origin_of(tile.own_box);
  GltfSummary summary;
  const auto path = staging_.path() + '/' + c.name + ".glb";
  if (!write_content(pieces, tile.origin, looks_, gltf_, *pictures_, path, task.diag, summary)) return false;
  tile.rounding = summary.quantization.position;
  tile.hash = hash_of_file(path);
  tile.figures = {c.name + ".glb", c.depth, 0, summary.triangles, summary.draws, names.size(), summary.bytes()};
  return true;
}

bool Making::measure() {
  for (auto i = made_.size(); i-- > 0;) {
    made_[i].box = made_[i].own_box;
    for (const auto child : cells_.cells[i].children) made_[i].box.unite(made_[child].box);
    if (made_[i].own_box.empty()) made_[i].origin = origin_of(made_[i].box);
  }
  std::vector<std::uint32_t> inner;
  for (std::uint32_t i = 0; i < made_.size(); ++i)
    if (!cells_.cells[i].children.empty()) inner.push_back(i);
  if (ctx_.monitor) ctx_.monitor->begin("measuring tiles", inner.size(), "tiles");
  const auto measured = [&](std::uint32_t i, Task&) {
    made_[i].error = measured_error(i);
    return true;
  };
  for_each(inner, measured);
  finish_errors();
  return true;
}

double Making::measured_error(std::uint32_t cell) const {
  std::vector<FullTile> full;
  std::vector<std::uint32_t> open{cell};
  while (!open.empty()) {
    const auto i = open.back();
    open.pop_back();
    const auto& children = cells_.cells[i].children;
    open.insert(open.end(), children.rbegin(), children.rend());
    if (children.empty()) full.push_back({made_[i].own_box, [this, i] { return pieces_of_cell(i); }});
  }
  const double error = surface_error(pieces_of_cell(cell), full);
  return std::isfinite(error) ? between_points * error : diagonal(made_[cell].box);
}

/// A tile is not nearer than its children, and rounding counts.
void Making::finish_errors() {
  for (std::size_t i = made_.size(); i-- > 0;) {
    Tile& tile = made_[i];
    const auto& children = cells_.cells[i].children;
    if (!children.empty()) tile.figures.error = tile.error + tile.rounding;
    for (const auto child : children) tile.figures.error = std::max(tile.figures.error, made_[child].figures.error);
  }
}

bool Making::publish() {
  std::uint64_t hash = 0;
  for (const auto& tile : made_) hash = mixed(hash, tile.hash);
  const auto name = tiles_folder(hash);
  Tileset set{.tiles = {}, .error = diagonal(made_[0].box), .place = options_.place};
  double grown = single_precision * diagonal(made_[0].box);
  for (const auto& tile : made_) grown = std::max(grown, 2 * tile.rounding);
  for (std::size_t i = 0; i < made_.size(); ++i) {
    const Tile& tile = made_[i];
    Box box = tile.box;
    box.low = box.low - Vec3{grown, grown, grown};
    box.high = box.high + Vec3{grown, grown, grown};
    const auto& children = cells_.cells[i].children;
    set.tiles.push_back(
        {name + '/' + tile.figures.file, tile.origin, box, tile.figures.error, {children.begin(), children.end()}});
    out_.tiles.push_back(tile.figures);
    out_.bytes += tile.figures.bytes;
  }
  out_.depth = cells_.depth;
  set.error = std::max(set.error, made_[0].figures.error);
  const auto text = tileset_json(set);
  out_.bytes += text.size();
  return staging_.publish(name, text, ctx_.diag);
}

}  // namespace
}  // namespace tiles

TilesMade make_tiles(std::span<const TilesInput> inputs, const std::string& folder, const TilesOptions& options,
                     Document& reader) {
  return tiles::Making(folder, options, reader).run(inputs);
}

}  // namespace wrlkit
