#include "convert/tiles/input_pieces.h"

#include <filesystem>
#include <new>
#include <set>
#include <unordered_map>

#include "base/stop.h"
#include "convert/nothing_shown.h"
#include "convert/tiles/reading_progress.h"

namespace wrlkit::tiles {
namespace {

/// Which of the files of a set others of it inline.
class Inlined {
 public:
  explicit Inlined(std::span<const TilesInput> inputs) {
    for (std::size_t i = 0; i < inputs.size(); ++i) numbers_.try_emplace(identity_of(inputs[i].path), i);
  }

  /// By the file that was read last.
  std::vector<std::size_t> by(const Document& reader) const {
    std::vector<std::size_t> out;
    if (numbers_.size() < 2) return out;
    for (const auto& lookup : reader.lookups())
      if (const auto found = numbers_.find(lookup.result.canonical); found != numbers_.end())
        out.push_back(found->second);
    return out;
  }

 private:
  static std::string identity_of(const std::string& path) {
    std::error_code fault;
    const auto out = std::filesystem::canonical(path, fault);
    return fault ? path : out.string();
  }

  std::unordered_map<std::string, std::size_t> numbers_;  // by canonical path
};

}  // namespace

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
bool InputPieces::take(const TilesInput& input, Taken& out) {
  std::set<std::string> names;
  const auto put = [&](const Piece& piece) {
    is_full_ = !store_->add(piece, out.entries.emplace_back());
    out.triangles += piece.mesh.is_triangles() ? piece.mesh.n_faces() : 0;
    names.insert(piece.name);
    return !is_full_;
  };
  try {
    out.is_read = read_scene(input.path) && pieces_of(reader_, {input.name, most_, passes_}, looks_, put, out.counts);
  } catch (const std::bad_alloc&) {
    reader_.context().diag.report(Diag::cannot_read, {}, input.path, "it needs more memory than there is");
    out = {};
    names.clear();
  }
  if (reader_) reader_.scene() = {};  // levels need the memory
  out.parts = names.size();
  return out.is_read;
}

bool InputPieces::read(std::span<const TilesInput> inputs, TilesMade& made) {
  auto& diag = reader_.context().diag;
  std::vector<Taken> taken(inputs.size());
  const Inlined inlined(inputs);
  ReadingProgress progress(inputs, reader_.context().monitor);
  for (std::size_t i = 0; i < inputs.size(); ++i) {
    check_stop();
    ++made.n_files;
    if (!taken[i].is_inlined) {
      made.n_failed += !take(inputs[i], taken[i]);
      for (const auto k : inlined.by(reader_))
        if (k != i) taken[k] = {.is_inlined = true};
    }
    progress.next();
    if (is_full_) diag.report(Diag::cannot_write, {}, set_, "the disk is full");
    if (is_full_) return false;
    check_stop();
  }
  for (std::size_t i = 0; i < inputs.size(); ++i) {
    auto& file = taken[i];
    if (file.is_inlined) made.inlined.push_back(inputs[i].name);
    entries_.insert(entries_.end(), file.entries.begin(), file.entries.end());
    file.entries = {};
    made.triangles += file.triangles;
    made.parts += file.parts;
    made.n_cut += file.counts.n_cut;
    for (const auto& [name, n] : file.counts.lost) made.lost[name] += n;
  }
  const auto& folders = looks_.picture_folders();
  pictures_ = std::make_unique<FileResources>(ResourceOptions{.allowed = {folders.begin(), folders.end()}}, nullptr);
  if (entries_.empty() && made.n_failed < made.n_files)
    diag.report(Diag::nothing_drawn, {},
                diag.count(Diag::hidden_geometry) > 0 ? "what there is, is in Switches that are off; use --show-all"
                                                      : "there is no geometry in any of the files");
  return !entries_.empty();
}

}  // namespace wrlkit::tiles
