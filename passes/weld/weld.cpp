// First every corner gets the number of its point, then all repairs work on these numbers. Only at the end is it
// decided whether the mesh takes the joined points or, as nothing was joined, keeps the list that it had, which may be
// shared with other geometry.
#include "passes/weld/weld.h"

#include <algorithm>
#include <cmath>
#include <memory>

#include "base/math/digits.h"
#include "passes/pipeline/length_option.h"
#include "passes/weld/scratch.h"

namespace wrlkit {
namespace {

void count(MeshJob& job, std::string_view what, std::size_t n) {
  if (n == 0) return;
  auto& stats = job.ctx.stats;
  auto i = stats.find(what);
  if (i == stats.end()) i = stats.emplace(what, 0).first;
  i->second += n;
}

/// Joins equal values, and forgets those that no corner uses if there is anything to join or `tidy`; true when it did.
template <int width>
bool join_values(Attribute& a, ValueTable<float, width>& table, StampedMap& map, bool tidy) {
  std::size_t n_used = 0;
  table.start(std::min(a.count(), a.index.size()));
  map.reset(a.count());
  for (std::uint32_t i : a.index)
    if (!map.contains(i)) {
      map.set(i, table.number(a.at(i)));
      ++n_used;
    }
  if (n_used == table.count() && !(tidy && a.count() > n_used)) return false;
  for (std::uint32_t& i : a.index) i = map[i];
  a.values.swap(table.values);
  return true;
}

class Welding {
 public:
  Welding(MeshJob& job, const WeldOptions& options)
      : job_(job),
        options_(options),
        mesh_(job.mesh),
        scratch_(scratch_of(job.scratch)),
        surface_{mesh_, scratch_.joiner.points, scratch_.face_of} {}

  Outcome run() {
    bool joined = join_points();
    spell_out_faces();
    const std::size_t n_values = count_values();
    bool repaired = repair();
    forget_triangles();
    give_back_points();
    joined |= join_attributes(count_values() > n_values);
    return joined || repaired ? Outcome::changed : Outcome::unchanged;
  }

 private:
  static WeldScratch& scratch_of(MeshScratch& s) {
    if (!s.weld) s.weld = std::make_shared<WeldScratch>();
    return *s.weld;
  }

  bool join_points();
  bool join_attributes(bool tidy);
  std::size_t count_values() const {
    return mesh_.normal.count() + mesh_.color.count() + mesh_.texcoord.count() + mesh_.lightcoord.count();
  }
  void spell_out_faces();
  void forget_triangles();
  bool repair();
  bool drop_faces();
  void find_edges();
  bool close_t_junctions();
  bool unify_winding();
  bool merge_coplanar();
  void count_what_is_left();
  void give_back_points();

  MeshJob& job_;
  const WeldOptions& options_;
  Mesh& mesh_;
  WeldScratch& scratch_;
  Surface surface_;
  double tolerance_ = 0;
};

bool Welding::join_points() {
  auto& joiner = scratch_.joiner;
  joiner.join_equal(mesh_.positions.span(), mesh_.corners, job_.scratch.map);
  tolerance_ = options_.tolerance.automatic ? tolerance_by_digits(joiner.points) : options_.tolerance.length;
  if (tolerance_ > 0) joiner.join_near(tolerance_, mesh_.corners);
  count(job_, "weld.joined-points", joiner.n_joined);
  return joiner.n_joined > 0;
}

/// After the repairs, which make new values.
bool Welding::join_attributes(bool tidy) {
  StampedMap& map = job_.scratch.map;
  bool joined = false;
  for (Attribute* a : mesh_.attributes()) {
    if (!a->present()) continue;
    if (a->width == 2) joined |= join_values(*a, scratch_.pairs, map, tidy);
    if (a->width == 3) joined |= join_values(*a, scratch_.triples, map, tidy);
    if (a->width == 4) joined |= join_values(*a, scratch_.quadruples, map, tidy);
  }
  return joined;
}

void Welding::spell_out_faces() {
  if (!mesh_.face_begin.empty()) return;
  for (std::uint32_t c = 0; c <= mesh_.corners.size(); c += 3) mesh_.face_begin.push_back(c);
}

/// The other way: for triangles alone face_begin is empty.
void Welding::forget_triangles() {
  const auto& begin = mesh_.face_begin;
  std::size_t f = 0;
  while (f < begin.size() && begin[f] == 3 * f) ++f;
  if (f == begin.size()) mesh_.face_begin.clear();
}

bool Welding::repair() {
  bool changed = drop_faces();
  find_edges();
  changed |= close_t_junctions();
  changed |= unify_winding();
  changed |= merge_coplanar();
  count_what_is_left();
  return changed;
}

bool Welding::drop_faces() {
  auto& cleaner = scratch_.cleaner;
  cleaner.counts = {};
  const std::size_t n_faces = surface_.n_faces();
  if (options_.degenerate) cleaner.drop_degenerate(surface_);
  const bool is_given = !options_.tolerance.automatic && options_.tolerance.length > 0;
  if (is_given && 2 * cleaner.counts.without_area > n_faces)
    job_.ctx.diag.report(Diag::weld_collapsed, job_.scene.where(job_.geometry), job_.scene.type(job_.geometry).name,
                         shortest_text(options_.tolerance.length), cleaner.counts.without_area, n_faces);
  if (options_.duplicates) cleaner.drop_duplicates(surface_, !mesh_.solid);
  count(job_, "weld.degenerate-faces", cleaner.counts.degenerate_faces);
  count(job_, "weld.repeated-corners", cleaner.counts.repeated_corners);
  count(job_, "weld.duplicate-faces", cleaner.counts.duplicate_faces);
  count(job_, "weld.duplicate-triangles", cleaner.counts.duplicate_triangles);
  return cleaner.counts.degenerate_faces + cleaner.counts.repeated_corners + cleaner.counts.duplicate_faces > 0;
}

void Welding::find_edges() {
  surface_.number_faces();
  scratch_.edges.build(surface_);
}

bool Welding::close_t_junctions() {
  if (!options_.t_junctions) return false;
  std::size_t n = scratch_.t_junctions.close(surface_, scratch_.edges.edges(), tolerance_);
  if (n > 0) find_edges();
  count(job_, "weld.t-junctions", n);
  return n > 0;
}

bool Welding::unify_winding() {
  if (!options_.winding && !options_.outward) return false;
  auto& winding = scratch_.winding;
  winding.counts = {};
  winding.unify(surface_, scratch_.edges.edges(), options_.outward);
  count(job_, "weld.flipped-faces", winding.counts.flipped_faces);
  count(job_, "weld.one-sided-parts", winding.counts.one_sided_parts);
  if (winding.counts.flipped_faces > 0) find_edges();
  return winding.counts.flipped_faces > 0;
}

bool Welding::merge_coplanar() {
  if (!options_.merge_coplanar) return false;
  std::size_t n = scratch_.merger.merge(surface_, scratch_.edges.edges(), tolerance_, job_.scratch.map);
  count(job_, "weld.merged-faces", n);
  if (n > 0) find_edges();
  return n > 0;
}

void Welding::count_what_is_left() {
  const auto& edges = scratch_.edges.edges();
  count(job_, "weld.non-manifold-edges", std::ranges::count_if(edges, [](auto& e) { return e.n_faces > 2; }));
  count(job_, "weld.non-manifold-points", count_non_manifold_points(surface_, edges, scratch_.parents, scratch_.fans));
}

void Welding::give_back_points() {
  auto& joiner = scratch_.joiner;
  if (joiner.n_joined == 0) {
    for (auto& c : mesh_.corners) c = joiner.position[c];
    return;
  }
  joiner.drop_unused(mesh_.corners);
  mesh_.positions.clear();
  mesh_.positions.edit().swap(joiner.points);
}

}  // namespace

bool WeldTolerance::read(std::string_view text) {
  automatic = text == "auto";
  length = 0;
  if (automatic) return true;
  LengthOption given;
  if (!given.read(text)) return false;
  length = given.metres;
  return true;
}

std::string WeldTolerance::print() const { return automatic ? "auto" : shortest_text(length); }

Outcome weld(MeshJob& job, const WeldOptions& options) {
  if (job.driven || job.mesh.kind != Mesh::Kind::faces || job.mesh.corners.empty()) return Outcome::unchanged;
  return Welding(job, options).run();
}

}  // namespace wrlkit
