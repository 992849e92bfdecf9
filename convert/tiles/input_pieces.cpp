#include "convert/tiles/input_pieces.h"

#include <new>
#include <set>

#include "base/stop.h"
#include "convert/nothing_shown.h"
#include "convert/tiles/reading_progress.h"

namespace wrlkit::tiles {

bool InputPieces::open(const std::string& folder) {
  std::string why;
  store_ = PieceStore::open(folder, why);
  if (!store_) reader_.context().diag.report(Diag::cannot_write, {}, folder, why);
  return store_.has_value();
}

bool InputPieces::read_scene(const std::string& path) {
  if (!reader_.read(path)) return false;
  report_undrawn(reader_.scene(), reader_.resources(), reader_.context().diag);
  return true;
}

/// The pieces of a file, all of them or none. False when it cannot be read, or does not fit into the memory.
bool InputPieces::take(const TilesInput& input, SceneCounts& counts, TilesMade& made) {
  const auto n_before = entries_.size();
  auto mine = counts;
  std::set<std::string> names;
  std::size_t n_triangles = 0;
  const auto put = [&](const Piece& piece) {
    PieceStore::Entry entry{};
    is_full_ = !store_->add(piece, entry);
    entries_.push_back(entry);
    n_triangles += piece.mesh.is_triangles() ? piece.mesh.n_faces() : 0;
    names.insert(piece.name);
    return !is_full_;
  };
  bool is_read = false, is_too_large = false;
  try {
    is_read = read_scene(input.path) && pieces_of(reader_, {input.name, most_, passes_}, looks_, put, mine);
  } catch (const std::bad_alloc&) {
    reader_.context().diag.report(Diag::cannot_read, {}, input.path, "it needs more memory than there is");
    entries_.resize(n_before);
    is_too_large = true;
  }
  if (reader_) reader_.scene() = {};  // levels need the memory
  if (is_too_large) return false;
  counts = std::move(mine);
  made.triangles += n_triangles;
  made.parts += names.size();
  return is_read;
}

bool InputPieces::read(std::span<const TilesInput> inputs, TilesMade& made) {
  auto& diag = reader_.context().diag;
  SceneCounts counts;
  ReadingProgress progress(inputs, reader_.context().monitor);
  for (const auto& input : inputs) {
    check_stop();
    ++made.n_files;
    made.n_failed += !take(input, counts, made);
    progress.next();
    if (is_full_) diag.report(Diag::cannot_write, {}, set_, "the disk is full");
    if (is_full_) return false;
    check_stop();
  }
  made.n_cut = counts.n_cut;
  made.lost = std::move(counts.lost);
  const auto& folders = looks_.picture_folders();
  pictures_ = std::make_unique<FileResources>(ResourceOptions{.allowed = {folders.begin(), folders.end()}}, nullptr);
  if (entries_.empty() && made.n_failed < made.n_files)
    diag.report(Diag::nothing_drawn, {},
                diag.count(Diag::hidden_geometry) > 0 ? "what there is, is in Switches that are off; use --show-all"
                                                      : "there is no geometry in any of the files");
  return !entries_.empty();
}

}  // namespace wrlkit::tiles
