#include "geometry/recognise/recognise.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "geometry/recognise/chain_forms.h"
#include "geometry/recognise/pieces.h"

namespace wrlkit {
namespace {

using namespace recognising;

constexpr std::size_t most_readings = 80;  // of one piece

/// What is best explained: all faces, by the plainest kinds.
class Search {
 public:
  Search(const Piece& piece, const RecogniseOptions& options) : p_(piece), options_(options), walk_(piece) {}

  Reading run() {
    hollow();
    if (!best_.forms.empty()) return std::move(best_);
    std::size_t tried = 0;
    for (const auto& start : walk_.starts()) {
      if (++tried > most_readings) break;
      const auto chain = walk_.walk(start);
      if (!chain) continue;
      consider(read_chain(p_, *chain, options_));
      if (!best_.forms.empty() && (best_.rank == 0 || best_.rank == 3)) break;
    }
    return std::move(best_);
  }

 private:
  void consider(Reading reading) {
    if (reading.forms.empty() || reading.n_faces != p_.n_faces()) return;
    if (best_.forms.empty() || reading.rank < best_.rank) best_ = std::move(reading);
  }

  /// From regions with holes.
  void hollow() {
    std::size_t tried = 0;
    for (std::uint32_t r = 0; r < p_.region_border.size() && tried < 4; ++r) {
      if (p_.region_border[r] < 6) continue;
      auto loops = walk_.loops_around(r);
      if (loops.size() < 2) continue;
      ++tried;
      std::vector<Chain> chains;
      for (auto& loop : loops) {
        auto chain = walk_.walk({std::move(loop), ChainEnd::cap, r, none, true});
        if (!chain) break;
        chains.push_back(std::move(*chain));
      }
      if (chains.size() != loops.size()) continue;
      consider(read_hollow(p_, chains, options_));
      if (!best_.forms.empty()) return;
    }
  }

  const Piece& p_;
  const RecogniseOptions& options_;
  RingWalk walk_;
  Reading best_;
};

void move(Form& form, const Vec3& by) {
  for (int r = 0; r < 3; ++r) form.frame(r, 3) += by[static_cast<std::size_t>(r)];
}

}  // namespace

Recognition recognise_forms(const Mesh& mesh, const RecogniseOptions& options) {
  Recognition out;
  if (mesh.kind != Mesh::Kind::faces || mesh.n_faces() == 0) return out;
  Pieces pieces(mesh, options.step);
  std::vector<char> taken(mesh.n_faces());
  Piece piece;
  while (pieces.next(piece)) {
    Reading reading = Search(piece, options).run();
    for (auto& found : reading.forms) {
      move(found.form, pieces.origin());
      for (auto& f : found.faces) {
        f = piece.mesh_face[f];
        taken[f] = 1;
      }
      std::ranges::sort(found.faces);
      found.inside_out = piece.mixed || found.inside_out == mesh.ccw;
      out.forms.push_back(std::move(found));
    }
  }
  for (auto f : pieces.empty_faces()) taken[f] = 1;
  std::ranges::stable_sort(out.forms, {}, [](const RecognisedForm& f) { return f.faces.front(); });
  for (std::uint32_t f = 0; f < taken.size(); ++f)
    if (!taken[f]) out.rest.push_back(f);
  return out;
}

}  // namespace wrlkit
