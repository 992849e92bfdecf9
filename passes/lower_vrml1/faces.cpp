#include "passes/lower_vrml1/faces.h"

#include <numeric>

#include "scenegraph/nodes.h"

namespace wrlkit::vrml1 {
namespace {

namespace v1 = nodes::vrml1;
using Int = std::int32_t;

struct Corner {
  Int coord, sequence, place;
};

void add(Faces& f, std::span<const Corner> corners, Int part, Int number) {
  f.faces.push_back(
      {static_cast<std::uint32_t>(f.coord.size()), static_cast<std::uint32_t>(corners.size()), part, number});
  for (auto& c : corners) {
    f.coord.push_back(c.coord);
    f.sequence.push_back(c.sequence);
    f.place.push_back(c.place);
  }
  f.coord.push_back(-1);
  f.sequence.push_back(-1);
  f.place.push_back(-1);
}

void add(Faces& f, std::initializer_list<Corner> corners, Int part, Int number) {
  add(f, std::span(corners.begin(), corners.size()), part, number);
}

/// Every polygon as it is.
void polygon(Faces& f, std::span<const Corner> run, Int number) { add(f, run, number, number); }

/// Every second triangle of a strip is turned.
void strip(Faces& f, std::span<const Corner> run, Int number) {
  for (std::size_t k = 2; k < run.size(); ++k) {
    const auto &a = run[k - 2], &b = run[k - 1];
    add(f, {k % 2 ? b : a, k % 2 ? a : b, run[k]}, number, static_cast<Int>(f.faces.size()));
  }
}

void segments(Faces& f, std::span<const Corner> run, Int number) {
  for (std::size_t k = 1; k < run.size(); ++k) add(f, {run[k - 1], run[k]}, static_cast<Int>(f.faces.size()), number);
}

using Take = void (*)(Faces&, std::span<const Corner>, Int);

void indexed(Faces& f, std::span<const Int> index, Take take) {
  std::vector<Corner> run;
  Int number = 0, sequence = 0;
  for (std::size_t i = 0; i <= index.size(); ++i) {
    if (i < index.size() && index[i] >= 0)
      run.push_back({index[i], sequence++, static_cast<Int>(i)});
    else if (!run.empty()) {
      take(f, run, number++);
      run.clear();
    }
  }
}

// numVertices: how many each takes; -1: all that are left.
void counted(Faces& f, Int start, std::span<const Int> counts, std::size_t n_points, Take take) {
  std::vector<Corner> run;
  const auto n = static_cast<std::int64_t>(n_points);
  std::int64_t at = std::max(start, 0);
  Int number = 0, sequence = 0;
  for (Int count : counts) {
    const auto end = count < 0 ? n : std::min(n, at + count);
    for (; at < end; ++at) {
      run.push_back({static_cast<Int>(at), sequence, sequence});
      ++sequence;
    }
    take(f, run, number++);
    run.clear();
  }
}

void grid(Faces& f, Int start, std::int64_t rows, std::int64_t columns, std::size_t n_points) {
  if (rows < 2 || columns < 2 || start < 0) return;
  auto corner = [&](std::int64_t r, std::int64_t c) {
    auto k = static_cast<Int>(r * columns + c);
    return Corner{start + k, k, k};
  };
  for (std::int64_t r = 0; r + 1 < rows && start + (r + 2) * columns <= static_cast<std::int64_t>(n_points); ++r)
    for (std::int64_t c = 0; c + 1 < columns; ++c)
      add(f, {corner(r, c), corner(r + 1, c), corner(r + 1, c + 1), corner(r, c + 1)}, static_cast<Int>(r),
          static_cast<Int>(f.faces.size()));
}

bool given(std::span<const Int> index) { return !index.empty() && !(index.size() == 1 && index[0] < 0); }

Int wrapped(std::int64_t i, std::size_t n) {
  return i < 0 || n == 0 ? 0 : static_cast<Int>(i % static_cast<std::int64_t>(n));
}

bool all_below(std::span<const Int> index, std::size_t n) {
  return std::ranges::all_of(index, [&](Int i) { return i < 0 || static_cast<std::size_t>(i) < n; });
}

/// One for each face.
std::vector<Int> face_values(const Faces& f, Binding b, std::span<const Int> index, std::size_t n_values) {
  const bool part = b == Binding::per_part || b == Binding::per_part_indexed;
  const bool looked_up = (b == Binding::per_part_indexed || b == Binding::per_face_indexed) && given(index);
  std::vector<Int> out;
  out.reserve(f.faces.size());
  for (auto& face : f.faces) {
    const auto k = part ? face.part : face.number;
    out.push_back(wrapped(
        looked_up && static_cast<std::size_t>(k) < index.size() ? index[static_cast<std::size_t>(k)] : k, n_values));
  }
  return out;
}

bool counts_up(std::span<const Int> index) {
  for (std::size_t i = 0; i < index.size(); ++i)
    if (index[i] != static_cast<Int>(i)) return false;
  return true;
}

}  // namespace

Faces read_faces(const Scene& scene, NodeId n, std::size_t n_points, bool cut) {
  Faces f;
  const Take line = cut ? segments : polygon;
  if (scene.is(n, v1::IndexedFaceSet)) {
    indexed(f, scene.get(n, v1::indexed_face_set::coordIndex), polygon);
    f.verbatim = true;
  } else if (scene.is(n, v1::IndexedLineSet)) {
    indexed(f, scene.get(n, v1::indexed_line_set::coordIndex), line);
    f.verbatim = !cut;
  } else if (scene.is(n, v1::IndexedTriangleStripSet))
    indexed(f, scene.get(n, v1::indexed_triangle_strip_set::coordIndex), strip);
  else if (scene.is(n, v1::FaceSet))
    counted(f, scene.get(n, v1::face_set::startIndex), scene.get(n, v1::face_set::numVertices), n_points, polygon);
  else if (scene.is(n, v1::LineSet))
    counted(f, scene.get(n, v1::line_set::startIndex), scene.get(n, v1::line_set::numVertices), n_points, line);
  else if (scene.is(n, v1::TriangleStripSet))
    counted(f, scene.get(n, v1::triangle_strip_set::startIndex), scene.get(n, v1::triangle_strip_set::numVertices),
            n_points, strip);
  else if (scene.is(n, v1::QuadMesh))
    grid(f, scene.get(n, v1::quad_mesh::startIndex), scene.get(n, v1::quad_mesh::verticesPerColumn),
         scene.get(n, v1::quad_mesh::verticesPerRow), n_points);
  return f;
}

Attribute bind(const Faces& f, Binding b, std::span<const Int> index, std::size_t n_values) {
  Attribute a;
  if (n_values == 0) return a;
  if (of_faces(b)) {
    a.of = Attribute::Of::faces;
    a.index = face_values(f, b, index, n_values);
    if (counts_up(a.index)) a.index.clear();
  } else if (of_corners(b)) {
    a.of = Attribute::Of::corners;
    const bool looked_up = b == Binding::per_vertex_indexed && given(index);
    if (b == Binding::per_vertex_indexed && !looked_up && all_below(f.coord, n_values)) return a;
    a.index.reserve(f.coord.size());
    for (std::size_t i = 0; i < f.coord.size(); ++i) {
      const auto place = static_cast<std::size_t>(f.place[i]);
      if (f.coord[i] < 0)
        a.index.push_back(-1);
      else if (b == Binding::per_vertex)
        a.index.push_back(wrapped(f.sequence[i], n_values));
      else
        a.index.push_back(wrapped(looked_up && place < index.size() ? index[place] : f.coord[i], n_values));
    }
    if (a.index == f.coord) a.index.clear();
  } else
    a.of = Attribute::Of::all;
  return a;
}

std::size_t values_needed(const Faces& f, const Attribute& a) {
  if (!a || a.of == Attribute::Of::all) return a ? 1 : 0;
  if (a.of == Attribute::Of::faces && a.index.empty()) return f.faces.size();
  const auto& index = a.index.empty() ? f.coord : a.index;
  return index.empty() ? 0 : static_cast<std::size_t>(*std::ranges::max_element(index) + 1);
}

Faces choose(const Faces& f, std::span<const std::uint32_t> which) {
  Faces out;
  for (auto k : which) {
    const auto& face = f.faces[k];
    out.faces.push_back({static_cast<std::uint32_t>(out.coord.size()), face.count, face.part, face.number});
    for (std::uint32_t i = face.begin; i <= face.begin + face.count; ++i) {
      out.coord.push_back(f.coord[i]);
      out.sequence.push_back(f.sequence[i]);
      out.place.push_back(f.place[i]);
    }
  }
  return out;
}

Attribute choose(const Faces& f, std::span<const std::uint32_t> which, const Attribute& a) {
  Attribute out{a.of, {}};
  if (a.of == Attribute::Of::faces)
    for (auto k : which) out.index.push_back(a.index.empty() ? static_cast<Int>(k) : a.index[k]);
  if (a.of == Attribute::Of::corners && !a.index.empty())
    for (auto k : which)
      for (std::uint32_t i = f.faces[k].begin; i <= f.faces[k].begin + f.faces[k].count; ++i)
        out.index.push_back(a.index[i]);
  return out;
}

}  // namespace wrlkit::vrml1
