#include "convert/tiles/repeats.h"

#include <algorithm>
#include <cmath>
#include <deque>
#include <unordered_map>

#include "base/hashing.h"
#include "base/math/affine.h"
#include "base/math/quaternion.h"
#include "base/stop.h"
#include "convert/tiles/prisms.h"
#include "geometry/simplify/pieces.h"
#include "passes/instance/match.h"

namespace wrlkit::tiles {
namespace {

using namespace instancing;

constexpr std::size_t least_places = 4;
constexpr std::size_t most_compared = 16;  // surfaces of equal invariants that a piece is compared with

Vec3 mean_of_corners(const Mesh& mesh) {
  Vec3 sum{};
  const double* first = mesh.positions.data() + std::size_t{mesh.corners[0]} * 3;
  for (const auto c : mesh.corners)
    for (std::size_t k = 0; k < 3; ++k) sum[k] += mesh.positions[std::size_t{c} * 3 + k] - first[k];
  for (std::size_t k = 0; k < 3; ++k) sum[k] = first[k] + sum[k] / static_cast<double>(mesh.corners.size());
  return sum;
}

class Finding {
 public:
  Finding(std::span<const Piece> pieces, double tolerance)
      : pieces_(pieces), tolerance_(tolerance), matcher_({Scaling::uniform, false, tolerance}) {}

  std::vector<Repeat> run() {
    std::unordered_map<std::uint64_t, std::size_t> n_alike;
    for (const auto& p : pieces_) ++n_alike[counts_of(p)];
    for (std::uint32_t i = 0; i < pieces_.size(); ++i) {
      const Piece& p = pieces_[i];
      if (p.mesh.is_triangles() && !p.mesh.corners.empty() && n_alike[counts_of(p)] >= least_places) sort_in(i);
    }
    std::vector<Repeat> out;
    for (auto& known : known_)
      if (known.repeat.places.size() >= least_places) out.push_back(std::move(known.repeat));
    return out;
  }

 private:
  struct Known {
    Repeat repeat;
    MeshForm form;  // of its mesh
    std::optional<Prism> prism = {};
  };

  static std::uint64_t counts_of(const Piece& p) { return mixed(p.look, p.mesh.corners.size()); }

  void sort_in(std::uint32_t i) {
    check_stop();
    const Piece& piece = pieces_[i];
    const Vec3 centre = mean_of_corners(piece.mesh);
    Mesh mesh = piece.mesh;
    auto& points = mesh.positions.edit();
    for (std::size_t k = 0; k < points.size(); ++k) points[k] -= centre[k % 3];
    MeshForm form;
    form.take(mesh);
    if (!(form.size > 0) || !std::isfinite(form.size)) return;
    const auto prism = prism_of(mesh, tolerance_);
    if ((prism && find_prism(i, form, centre)) || find(i, form, centre)) return;
    TransformFields where{.translation = centre};
    if (prism) {
      simplify::transform(mesh, inverse(prism->frame));
      where.rotation = axis_angle(prism->frame);
    }
    know({{std::move(mesh), {{i, where}}}, {}, prism}, piece.look);
  }

  void know(Known&& made, std::uint32_t look) {
    known_.push_back(std::move(made));
    Known& known = known_.back();
    known.form.take(known.repeat.mesh);
    by_cell_[mixed(cells_of(known.form, Scaling::uniform, tolerance_, false)[0], look)].push_back(&known);
    if (known.prism) prisms_[mixed(shape_of(known.repeat.mesh), look)].push_back(&known);
  }

  /// Whether it is a prism that is known, with other sizes along its axes.
  bool find_prism(std::uint32_t i, const MeshForm& form, const Vec3& centre) {
    const auto found = prisms_.find(mixed(shape_of(pieces_[i].mesh), pieces_[i].look));
    if (found == prisms_.end()) return false;
    std::size_t compared = 0;
    for (Known* known : found->second) {
      if (++compared > most_compared) break;
      auto where = stretched(*known->prism, known->form, form, tolerance_);
      if (!where) continue;
      where->translation = where->translation + centre;
      known->repeat.places.push_back({i, *where});
      return true;
    }
    return false;
  }

  /// Whether it is one that is known.
  bool find(std::uint32_t i, const MeshForm& form, const Vec3& centre) {
    std::size_t compared = 0;
    for (const auto cell : cells_of(form, Scaling::uniform, tolerance_, true)) {
      const auto found = by_cell_.find(mixed(cell, pieces_[i].look));
      if (found == by_cell_.end()) continue;
      for (Known* known : found->second) {
        if (++compared > most_compared) return false;
        auto where = matcher_.match(known->form, form);
        if (!where) continue;
        where->translation = where->translation + centre;
        known->repeat.places.push_back({i, *where});
        return true;
      }
    }
    return false;
  }

  std::span<const Piece> pieces_;
  double tolerance_;
  Matcher matcher_;
  std::deque<Known> known_;  // forms point to meshes
  std::unordered_map<std::uint64_t, std::vector<Known*>> by_cell_, prisms_;
};

/// About, of quantised and packed vertices, and of JSON.
double saved_bytes(const Repeat& repeat) {
  constexpr double vertex = 8, corner = 1, place = 24, node = 1000;
  const auto corners = static_cast<double>(repeat.mesh.corners.size());
  const double vertices = (corners + static_cast<double>(repeat.mesh.n_positions())) / 2;  // split at creases
  const auto n = static_cast<double>(repeat.places.size());
  return (n - 1) * (vertices * vertex + corners * corner) - n * place - node;
}

}  // namespace

std::vector<Repeat> repeats_of(std::span<const Piece> pieces, double tolerance) {
  return Finding(pieces, tolerance).run();
}

std::vector<Repeat> worthwhile(std::vector<Repeat> repeats, std::size_t most) {
  std::erase_if(repeats, [](const Repeat& r) { return saved_bytes(r) <= 0; });
  std::ranges::stable_sort(repeats, std::greater{}, saved_bytes);
  if (repeats.size() > most) repeats.resize(most);
  return repeats;
}

}  // namespace wrlkit::tiles
