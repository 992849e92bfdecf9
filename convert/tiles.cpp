#include "convert/tiles.h"

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <mutex>
#include <set>

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
// Distances are taken at points, and the largest may lie between them.
constexpr double between_points = 1.1;
constexpr double single_precision = 1.0 / (1 << 22);

/// A cell with what has been made of it.
struct Tile {
  std::vector<PieceStore::Entry> pieces;
  Box own_box;  // of what it shows itself
  Box box;      // and of its children
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
  bool make_tile(std::uint32_t cell, Task& ctx);
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
  std::vector<std::vector<std::uint32_t>> levels(cells_.depth + 1);
  for (std::uint32_t i = 0; i < made_.size(); ++i) levels[cells_.cells[i].depth].push_back(i);
  for (auto level = levels.rbegin(); level != levels.rend(); ++level)
    if (!for_each(*level, [&](std::uint32_t i, Task& task) { return make_tile(i, task); })) return false;
  return true;
}

std::vector<Piece> Making::read(const PieceStore& from, std::span<const PieceStore::Entry> entries) const {
  std::vector<Piece> out;
  for (const auto& e : entries) out.push_back(from.read(e));
  return out;
}

std::vector<Piece> Making::pieces_of_cell(std::uint32_t cell) const {
  const Cell& c = cells_.cells[cell];
  if (!c.children.empty()) return read(*coarse_, made_[cell].pieces);
  // In the order of the files, so that pieces of a part stand together.
  std::vector<std::uint32_t> order(cells_.order.begin() + c.begin, cells_.order.begin() + c.end);
  std::ranges::sort(order);
  std::vector<PieceStore::Entry> entries;
  for (const auto i : order) entries.push_back(entries_[i]);
  return read(*full_, entries);
}

bool Making::spill(std::uint32_t cell, std::span<const Piece> pieces) {
  bool stored = true;
  for (const auto& p : pieces) {
    auto& entry = made_[cell].pieces.emplace_back();
    stored &= coarse_->add(p, entry);
  }
  return stored;
}

bool Making::make_tile(std::uint32_t cell, Task& task) {
  const Cell& c = cells_.cells[cell];
  Tile& tile = made_[cell];
  std::vector<Piece> pieces;
  if (c.children.empty())
    pieces = pieces_of_cell(cell);
  else {
    for (const auto child : c.children) std::ranges::move(pieces_of_cell(child), std::back_inserter(pieces));
    std::size_t drawn = 0;
    for (const auto& p : pieces) drawn += n_drawn(p.mesh);
    pieces = coarser(std::move(pieces), std::min(options_.triangles, drawn / 2), looks_, task);
    if (!spill(cell, pieces)) {
      task.diag.report(Diag::cannot_write, {}, folder_, "the disk is full");
      return false;
    }
  }
  std::set<std::string_view> names;
  for (const auto& p : pieces) {
    tile.own_box.unite(bounds_of(p.mesh));
    names.insert(p.name);
  }
  tile.box = tile.own_box;
  for (const auto child : c.children) tile.box.unite(made_[child].box);
  tile.origin = origin_of(tile.box);
  GltfSummary summary;
  const auto path = staging_.path() + '/' + c.name + ".glb";
  if (!write_content(pieces, tile.origin, looks_, gltf_, *pictures_, path, task.diag, summary)) return false;
  tile.rounding = summary.quantization.position;
  tile.hash = hash_of_file(path);
  tile.figures = {c.name + ".glb", c.depth, 0, summary.triangles, summary.draws, names.size(), summary.bytes()};
  return true;
}

bool Making::measure() {
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
