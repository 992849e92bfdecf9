#include "geometry/progressive/progressive.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>
#include <span>

namespace wrlkit {
namespace {

using Record = ProgressiveRecord;
constexpr std::uint32_t none = 0xffffffffu;

/// The nearest float that is not less: so a stated error stays true.
float rounded_up(double x) {
  constexpr float largest = std::numeric_limits<float>::max();
  if (!(x < largest)) return largest;
  const auto f = static_cast<float>(x);
  return f < x ? std::nextafter(f, largest) : f;
}

/// The entries of one step of a record, whose ends are given one step after the other.
template <class T, class Step>
std::span<const T> part_of(const std::vector<T>& all, const std::vector<Step>& steps, std::size_t i,
                           std::size_t Step::*end) {
  const std::size_t begin = i ? steps[i - 1].*end : 0;
  return std::span(all).subspan(begin, steps[i].*end - begin);
}

/// Goes through the collapses once in their order, to see what corners each of them moves and what its faces were when
/// they went; then once backwards, to number and write what appears.
class Reversal {
 public:
  Reversal(const Mesh& mesh, const CollapseRecord& record) : mesh_(mesh), in_(record) {}

  Record run() {
    read_corners();
    for (std::size_t i = 0; i < in_.steps.size(); ++i) collapse(i);
    set_flags();
    write_base();
    for (std::size_t i = in_.steps.size(); i-- > 0;) write_split(i);
    return std::move(out_);
  }

 private:
  using Corner = Record::Corner;
  struct Moved {
    std::uint32_t corner, fine, coarse;
  };

  std::uint32_t rank(std::uint32_t original) const {
    return static_cast<std::uint32_t>(std::ranges::lower_bound(used_, original) - used_.begin());
  }

  void read_corners() {
    const std::size_t n = in_.wedge_of_corner.size();
    for (std::uint32_t w : in_.wedge_of_corner)
      if (w != none) used_.push_back(in_.wedge_vertex[w]);
    std::ranges::sort(used_);
    used_.erase(std::unique(used_.begin(), used_.end()), used_.end());
    corner_.resize(n);
    next_.resize(n, none);
    first_.resize(used_.size(), none);
    last_.resize(used_.size(), none);
    for (std::uint32_t c = 0; c < n; ++c) {
      const std::uint32_t w = in_.wedge_of_corner[c];
      if (w == none) continue;
      corner_[c] = {rank(in_.wedge_vertex[w]), w};
      append(corner_[c].vertex, c);
    }
    position_.resize(used_.size());
    for (std::size_t v = 0; v < used_.size(); ++v)
      for (std::size_t i = 0; i < 3; ++i) position_[v][i] = mesh_.positions[3 * std::size_t{used_[v]} + i];
    gone_.resize(n / 3);
    gone_vertex_.resize(used_.size());
    row_.resize(in_.wedge_vertex.size());
    std::iota(row_.begin(), row_.end(), 0u);
  }

  void append(std::uint32_t vertex, std::uint32_t corner) {
    (first_[vertex] == none ? first_[vertex] : next_[last_[vertex]]) = corner;
    last_[vertex] = corner;
    next_[corner] = none;
  }

  void collapse(std::size_t i) {
    const auto& step = in_.steps[i];
    const std::uint32_t u = rank(step.from), v = rank(step.to);
    for (std::uint32_t f : part_of(in_.removed_faces, in_.steps, i, &CollapseRecord::Step::end_of_faces))
      gone_[f] = true;
    const std::size_t begin = moved_.size();
    for (std::uint32_t c = first_[u], after; c != none; c = after) {
      after = next_[c];
      if (gone_[c / 3]) continue;
      moved_.push_back({c, corner_[c].wedge, 0});
      append(v, c);
    }
    for (const auto& change : part_of(in_.corners, in_.steps, i, &CollapseRecord::Step::end_of_corners))
      corner_[change.corner].wedge = change.after;
    for (std::size_t k = begin; k < moved_.size(); ++k) {
      moved_[k].coarse = corner_[moved_[k].corner].wedge;
      corner_[moved_[k].corner].vertex = v;
    }
    end_of_moved_.push_back(moved_.size());
    for (const auto& change : part_of(in_.wedges, in_.steps, i, &CollapseRecord::Step::end_of_wedges))
      row_[change.wedge] = change.after;
    gone_vertex_[u] = true;
    position_[v] = step.position;
  }

  void set_flags() {
    Mesh& m = out_.flags;
    m.kind = mesh_.kind;
    m.ccw = mesh_.ccw;
    m.solid = mesh_.solid;
    m.convex = mesh_.convex;
    m.crease_angle = mesh_.crease_angle;
    out_.n_normal = mesh_.normal.present() ? mesh_.normal.width : 0;
    out_.n_color = mesh_.color.present() ? mesh_.color.width : 0;
    out_.n_texcoord = mesh_.texcoord.present() ? mesh_.texcoord.width : 0;
    out_.values = in_.values;
    if (!in_.steps.empty()) out_.base_error = rounded_up(in_.steps.back().error);
  }

  void write_base() {
    vertex_number_.resize(used_.size());
    wedge_number_.resize(in_.wedge_vertex.size(), none);
    face_number_.resize(gone_.size(), none);
    for (std::uint32_t v = 0; v < used_.size(); ++v)
      if (!gone_vertex_[v]) write_vertex(v);
    std::uint32_t number = 0;  // of the faces that the Collapser did not drop
    original_face_.resize(gone_.size());
    for (std::uint32_t f = 0; f < gone_.size(); ++f) {
      if (in_.wedge_of_corner[3 * std::size_t{f}] == none) continue;
      original_face_[f] = number++;
      if (!gone_[f]) write_face(f);
    }
    out_.n_base_vertices = out_.vertices.size();
    out_.n_base_wedges = out_.wedges.size();
    out_.n_base_faces = out_.faces.size();
  }

  void write_vertex(std::uint32_t v) {
    vertex_number_[v] = static_cast<std::uint32_t>(out_.vertices.size());
    out_.vertices.push_back({position_[v], v});
  }

  std::uint32_t wedge(std::uint32_t w) {
    if (in_.width == 0) return 0;
    if (wedge_number_[w] == none) {
      wedge_number_[w] = static_cast<std::uint32_t>(out_.wedges.size());
      out_.wedges.push_back(row_[w]);
    }
    return wedge_number_[w];
  }

  void write_face(std::uint32_t f) {
    face_number_[f] = static_cast<std::uint32_t>(out_.faces.size());
    Record::Face face{{}, original_face_[f]};
    for (std::size_t k = 0; k < 3; ++k) {
      const Corner& c = corner_[3 * std::size_t{f} + k];
      face.corners[k] = {vertex_number_[c.vertex], wedge(c.wedge)};
    }
    out_.faces.push_back(face);
  }

  void write_split(std::size_t i) {
    const auto& step = in_.steps[i];
    const std::uint32_t u = rank(step.from), v = rank(step.to);
    const auto changes = part_of(in_.wedges, in_.steps, i, &CollapseRecord::Step::end_of_wedges);
    for (const auto& change : changes) row_[change.wedge] = change.before;
    position_[u] = step.old_from;
    write_vertex(u);
    const std::size_t old_wedges = out_.wedges.size();
    write_moved(i);
    for (std::uint32_t f : part_of(in_.removed_faces, in_.steps, i, &CollapseRecord::Step::end_of_faces)) write_face(f);
    for (const auto& change : changes)  // one that appears here has its values already
      if (wedge(change.wedge) < old_wedges)
        out_.wedge_changes.push_back({wedge(change.wedge), change.after, change.before});
    out_.splits.push_back({vertex_number_[v], step.position, step.old_to, i ? rounded_up(in_.steps[i - 1].error) : 0,
                           out_.faces.size(), out_.corners.size(), out_.wedge_changes.size()});
  }

  void write_moved(std::size_t i) {
    const std::size_t begin = i ? end_of_moved_[i - 1] : 0;
    const auto moved = std::span(moved_).subspan(begin, end_of_moved_[i] - begin);
    auto renumbered = [&](std::uint32_t c) { return 3 * face_number_[c / 3] + c % 3; };
    std::ranges::sort(moved, {}, [&](const Moved& m) { return renumbered(m.corner); });
    for (const Moved& m : moved) out_.corners.push_back({renumbered(m.corner), wedge(m.coarse), wedge(m.fine)});
  }

  const Mesh& mesh_;
  const CollapseRecord& in_;
  Record out_;

  // By rank among the positions that are used.
  std::vector<std::uint32_t> used_, first_, last_, vertex_number_;
  std::vector<Record::Point> position_;
  std::vector<bool> gone_vertex_;
  // By the numbers of the record.
  std::vector<Corner> corner_;
  std::vector<std::uint32_t> next_;  // corner of the same vertex
  std::vector<bool> gone_;           // faces
  std::vector<std::uint32_t> row_, wedge_number_, face_number_, original_face_;

  std::vector<Moved> moved_;
  std::vector<std::size_t> end_of_moved_;  // by step
};

/// Numbers what is used in the order of `key`: the new number of each, or none.
template <class Key>
std::vector<std::uint32_t> order_of(const std::vector<bool>& used, Key key, std::vector<std::uint32_t>& sorted) {
  sorted.clear();
  for (std::uint32_t i = 0; i < used.size(); ++i)
    if (used[i]) sorted.push_back(i);
  std::ranges::stable_sort(sorted, {}, key);
  std::vector<std::uint32_t> number(used.size(), none);
  for (std::uint32_t i = 0; i < sorted.size(); ++i) number[sorted[i]] = i;
  return number;
}

/// Rows of values, each in the order in which the corners use it first.
class ValueWriter {
 public:
  ValueWriter(const Record& record, const std::vector<std::uint32_t>& row) : record_(record), row_(row) {}

  void write(Attribute& to, int width, int offset, std::span<const std::uint32_t> wedges) {
    if (width == 0) return;
    to.width = width;
    std::vector<std::uint32_t> id(row_.size(), none);
    for (std::uint32_t w : wedges) {
      if (id[w] == none) {
        id[w] = static_cast<std::uint32_t>(to.count());
        const float* v =
            record_.values.data() + std::size_t{row_[w]} * static_cast<std::size_t>(record_.width()) + offset;
        to.values.insert(to.values.end(), v, v + width);
      }
      to.index.push_back(id[w]);
    }
  }

 private:
  const Record& record_;
  const std::vector<std::uint32_t>& row_;
};

}  // namespace

ProgressiveRecord make_progressive(const Mesh& mesh, const CollapseRecord& record) {
  return Reversal(mesh, record).run();
}

std::optional<ProgressiveRecord> make_progressive(const Mesh& mesh, Criterion criterion, std::size_t base_faces) {
  if (!info(criterion).keeps_record) return {};
  Collapser c(mesh, {.criterion = criterion, .record = true});
  c.run_to(base_faces);
  return make_progressive(mesh, c.record());
}

ProgressiveMesh::ProgressiveMesh(ProgressiveRecord record)
    : record_(std::move(record)), n_faces_(record_.n_base_faces), row_(record_.wedges) {
  for (const auto& v : record_.vertices) position_.push_back(v.position);
  for (const auto& f : record_.faces) corner_.insert(corner_.end(), f.corners.begin(), f.corners.end());
}

void ProgressiveMesh::refine_to(std::size_t n_faces) {
  while (n_faces_ < n_faces && done_ < record_.splits.size()) split();
}

void ProgressiveMesh::coarsen_to(std::size_t n_faces) {
  while (n_faces_ > n_faces && done_ > 0) collapse();
}

void ProgressiveMesh::split() {
  using Split = Record::Split;
  const Split& s = record_.splits[done_];
  const auto born = static_cast<std::uint32_t>(record_.n_base_vertices + done_);
  position_[s.vertex] = s.fine;
  for (const auto& c : part_of(record_.corners, record_.splits, done_, &Split::end_of_corners))
    corner_[c.corner] = {born, c.fine};
  for (const auto& w : part_of(record_.wedge_changes, record_.splits, done_, &Split::end_of_wedges))
    row_[w.wedge] = w.fine;
  n_faces_ = s.end_of_faces;
  ++done_;
}

void ProgressiveMesh::collapse() {
  using Split = Record::Split;
  --done_;
  const Split& s = record_.splits[done_];
  position_[s.vertex] = s.coarse;
  for (const auto& c : part_of(record_.corners, record_.splits, done_, &Split::end_of_corners))
    corner_[c.corner] = {s.vertex, c.coarse};
  for (const auto& w : part_of(record_.wedge_changes, record_.splits, done_, &Split::end_of_wedges))
    row_[w.wedge] = w.coarse;
  n_faces_ = done_ ? record_.splits[done_ - 1].end_of_faces : record_.n_base_faces;
}

Mesh ProgressiveMesh::mesh() const {
  Mesh m = record_.flags;
  std::vector<std::uint32_t> faces, vertices;
  order_of(
      std::vector<bool>(n_faces_, true), [&](std::uint32_t f) { return record_.faces[f].number; }, faces);
  std::vector<bool> used(record_.n_base_vertices + done_);
  for (std::size_t c = 0; c < 3 * n_faces_; ++c) used[corner_[c].vertex] = true;
  const auto number = order_of(
      used, [&](std::uint32_t v) { return record_.vertices[v].number; }, vertices);
  auto& positions = m.positions.edit();
  for (std::uint32_t v : vertices) positions.insert(positions.end(), position_[v].begin(), position_[v].end());
  std::vector<std::uint32_t> wedges;
  for (std::uint32_t f : faces)
    for (std::size_t k = 0; k < 3; ++k) {
      const auto& c = corner_[3 * std::size_t{f} + k];
      m.corners.push_back(number[c.vertex]);
      wedges.push_back(c.wedge);
    }
  ValueWriter values(record_, row_);
  values.write(m.normal, record_.n_normal, 0, wedges);
  values.write(m.color, record_.n_color, record_.n_normal, wedges);
  values.write(m.texcoord, record_.n_texcoord, record_.n_normal + record_.n_color, wedges);
  return m;
}

}  // namespace wrlkit
