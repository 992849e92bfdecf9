#include "passes/instance/match.h"

#include <algorithm>
#include <numeric>

#include "base/hashing.h"

namespace wrlkit::instancing {
namespace {

constexpr int most_attempts = 200;                           // frames laid for one pair of meshes
constexpr std::size_t most_likely = 64;                      // corners that may be the first one of a frame
constexpr double same_direction = 0.005, same_place = 1e-5;  // of unit normals, of texture coordinates

double distance2(const Vec3& a, const Vec3& b) {
  const Vec3 d = a - b;
  return dot(d, d);
}

/// Columns: along p, square to it towards q, and square to both.
std::optional<std::array<Vec3, 3>> frame(const Vec3& p, const Vec3& q, bool mirrored) {
  const double lp = fast_length(p);
  if (!(lp > 0)) return std::nullopt;
  const Vec3 x = 1 / lp * p, y = q - dot(q, x) * x;
  const double ly = fast_length(y);
  if (!(ly > 1e-9 * lp)) return std::nullopt;
  const Vec3 e = 1 / ly * y;
  return std::array<Vec3, 3>{x, e, (mirrored ? -1 : 1) * cross(x, e)};
}

/// Some direction that is not that of p.
Vec3 aside(const Vec3& p) {
  Vec3 q{};
  q[static_cast<std::size_t>(std::ranges::min_element(p, {}, [](double v) { return std::abs(v); }) - p.begin())] = 1;
  return q;
}

Vec3 face_centre(const MeshForm& f, std::size_t face) {
  Vec3 c{};
  const auto begin = f.mesh->begin_of(face), end = f.mesh->end_of(face);
  for (auto i = begin; i < end; ++i)
    for (std::size_t k = 0; k < 3; ++k) c[k] += f.at[i][k] / static_cast<double>(end - begin);
  return c;
}

/// For normals: the inverse transposed, up to a positive factor.
Matrix normal_matrix(const Matrix& m) {
  Matrix o;
  const double sign = m.determinant() < 0 ? -1 : 1;
  for (int r = 0; r < 3; ++r)
    for (int c = 0; c < 3; ++c) {
      const int r1 = (r + 1) % 3, r2 = (r + 2) % 3, c1 = (c + 1) % 3, c2 = (c + 2) % 3;
      o(r, c) = sign * (m(r1, c1) * m(r2, c2) - m(r1, c2) * m(r2, c1));
    }
  return o;
}

}  // namespace

// ---- where faces are -----------------------------------------------------------------------------------------------

std::uint64_t FaceGrid::cell(const Vec3& at, int dx, int dy, int dz) const {
  const int d[]{dx, dy, dz};
  std::uint64_t h = 0;
  for (std::size_t k = 0; k < 3; ++k) {
    const auto whole = static_cast<std::int64_t>(std::clamp(std::floor(at[k] / (2 * near_)), -4e18, 4e18));
    h = mixed(h, static_cast<std::uint64_t>(whole + d[k]));
  }
  return h;
}

void FaceGrid::build(const MeshForm& form, double near) {
  near_ = near;
  entries_.clear();
  for (std::size_t f = 0; f < form.mesh->n_faces(); ++f)
    entries_.push_back({cell(face_centre(form, f), 0, 0, 0), static_cast<std::uint32_t>(f)});
  std::ranges::sort(
      entries_, [](const Entry& a, const Entry& b) { return a.cell != b.cell ? a.cell < b.cell : a.face < b.face; });
}

template <class F>
bool FaceGrid::any_near(const Vec3& at, F&& f) const {
  // Cells are two such distances wide: of three along each axis the two nearer ones will do.
  int side[3];
  for (std::size_t k = 0; k < 3; ++k) {
    const double x = at[k] / (2 * near_);
    side[k] = x - std::floor(x) < 0.5 ? -1 : 1;
  }
  int seen = 0;
  for (int corner = 0; corner < 8; ++corner) {
    const auto c = cell(at, corner & 1 ? side[0] : 0, corner & 2 ? side[1] : 0, corner & 4 ? side[2] : 0);
    for (auto e = std::ranges::lower_bound(entries_, c, {}, &Entry::cell); e != entries_.end() && e->cell == c; ++e) {
      if (++seen > most) return false;
      if (f(e->face)) return true;
    }
  }
  return false;
}

// ---- comparing -----------------------------------------------------------------------------------------------------

std::optional<TransformFields> Matcher::match(const MeshForm& from, const MeshForm& to) {
  from_ = &from;
  to_ = &to;
  if (from.at.size() != to.at.size() || from.mesh->n_faces() != to.mesh->n_faces()) return std::nullopt;
  if (auto done = in_order()) return done;
  return by_frames();
}

std::optional<TransformFields> Matcher::in_order() {
  for (std::size_t f = 0; f < from_->mesh->n_faces(); ++f)
    if (from_->mesh->end_of(f) != to_->mesh->end_of(f)) return std::nullopt;
  pairs_.resize(from_->at.size());
  std::iota(pairs_.begin(), pairs_.end(), 0);
  if (agree({}, pairs_)) return TransformFields{};
  return settle(pairs_, false);
}

/// The best motion for these pairs, if it is good enough.
std::optional<TransformFields> Matcher::settle(const Pairs& pairs, bool mirrored) {
  std::vector<Vec3> to(pairs.size());
  for (std::size_t i = 0; i < pairs.size(); ++i) to[i] = to_->at[pairs[i]];
  const Matrix linear = fit(from_->at, to, options_.scaling, mirrored);
  if (!mirrored && linear.determinant() < 0) return std::nullopt;
  if (!agree(translation_matrix(to_->centre) * linear * translation_matrix(-1 * from_->centre), pairs))
    return std::nullopt;
  const double far = from_->reach + fast_length(from_->centre);
  auto fields = in_few_digits(linear, from_->centre, to_->centre, far, options_.tolerance / 4);
  if (!agree(matrix_of(fields), pairs)) fields = in_few_digits(linear, from_->centre, to_->centre, far, 0);
  if (!agree(matrix_of(fields), pairs)) return std::nullopt;
  return fields;
}

bool Matcher::agree(const Matrix& m, const Pairs& pairs) const {
  // What the numbers of the file cannot tell apart.
  const double rounding = 1e-13 * (from_->reach + to_->reach + fast_length(from_->centre) + fast_length(to_->centre));
  const double allowed = std::pow(options_.tolerance + rounding, 2);
  const auto &a = *from_->mesh, &b = *to_->mesh;
  const Matrix normal = normal_matrix(m);
  for (std::size_t i = 0; i < pairs.size(); ++i) {
    const double *p = a.positions.data() + std::size_t{a.corners[i]} * 3,
                 *q = b.positions.data() + std::size_t{b.corners[pairs[i]]} * 3;
    if (!(distance2(m.point({p[0], p[1], p[2]}), {q[0], q[1], q[2]}) <= allowed)) return false;
    if (!agree_in_attributes(normal, static_cast<std::uint32_t>(i), pairs[i])) return false;
  }
  return true;
}

bool Matcher::agree_in_attributes(const Matrix& normal, std::uint32_t i, std::uint32_t k) const {
  const auto &a = *from_->mesh, &b = *to_->mesh;
  if (a.color.present() && !std::equal(a.color.at(a.color.index[i]), a.color.at(a.color.index[i]) + a.color.width,
                                       b.color.at(b.color.index[k])))
    return false;
  if (a.texcoord.present()) {
    const float *p = a.texcoord.at(a.texcoord.index[i]), *q = b.texcoord.at(b.texcoord.index[k]);
    if (!(std::abs(p[0] - q[0]) <= same_place && std::abs(p[1] - q[1]) <= same_place)) return false;
  }
  if (!a.normal.present()) return true;
  const float *p = a.normal.at(a.normal.index[i]), *q = b.normal.at(b.normal.index[k]);
  const Vec3 turned = normal.point({p[0], p[1], p[2]}), wanted{q[0], q[1], q[2]};
  const double n = fast_length(turned), w = fast_length(wanted);
  if (!(n > 0) || !(w > 0)) return !(n > 0) && !(w > 0);
  return distance2(1 / n * turned, 1 / w * wanted) <= same_direction * same_direction;
}

// ---- other orders --------------------------------------------------------------------------------------------------

std::optional<TransformFields> Matcher::by_frames() {
  if (options_.scaling == Scaling::axis || !(from_->size > 0) || !(to_->size > 0)) return std::nullopt;
  factor_ = options_.scaling == Scaling::none ? 1 : to_->size / from_->size;
  const double near = 4 * options_.tolerance + 1e-9 * to_->reach;
  if (!choose_base()) return std::nullopt;
  grid_.build(*to_, near);
  attempts_ = 0;
  const Vec3 p = from_->at[base_[0]], q = from_->at[base_[1]];
  const double rp = fast_length(p) * factor_, rq = fast_length(q) * factor_, d = std::sqrt(distance2(p, q)) * factor_;
  std::vector<Vec3> likely;
  for (const Vec3& a : to_->at) {
    if (std::abs(fast_length(a) - rp) > near || std::ranges::find(likely, a) != likely.end()) continue;
    likely.push_back(a);
    if (likely.size() == most_likely) break;
  }
  std::vector<Vec3> tried;
  for (const Vec3& a : likely) {
    if (line_) {
      if (auto done = try_frame(a, aside(a), false)) return done;
      continue;
    }
    tried.clear();
    for (const Vec3& b : to_->at) {
      if (std::abs(fast_length(b) - rq) > near || std::abs(std::sqrt(distance2(a, b)) - d) > 2 * near ||
          std::ranges::find(tried, b) != tried.end())
        continue;
      tried.push_back(b);
      if (auto done = try_frame(a, b, false)) return done;
      if (options_.mirror)
        if (auto done = try_frame(a, b, true)) return done;
      if (attempts_ >= most_attempts) return std::nullopt;
    }
  }
  return std::nullopt;
}

/// Two corners, such that few others are as far from the centre and from one another.
bool Matcher::choose_base() {
  const double near = (4 * options_.tolerance + 1e-9 * to_->reach) / factor_;
  const auto& at = from_->at;
  // The corner of the fewest of its kind among those that `measure` accepts; kinds are runs of values that are near.
  auto rarest = [&](auto measure) -> std::optional<std::uint32_t> {
    std::vector<std::pair<double, std::uint32_t>> all;
    for (std::uint32_t i = 0; i < at.size(); ++i)
      if (auto m = measure(at[i])) all.push_back({*m, i});
    std::ranges::sort(all);
    std::optional<std::uint32_t> best;
    std::size_t fewest = 0;
    for (std::size_t i = 0, k = 0; i < all.size(); i = k) {
      for (k = i + 1; k < all.size() && all[k].first - all[k - 1].first <= near; ++k) {
      }
      if (!best || k - i <= fewest) {
        best = all[i].second;
        fewest = k - i;
      }  // of equals the farther one
    }
    return best;
  };
  const double least = 0.3 * from_->reach;
  auto first = rarest([&](const Vec3& p) {
    const double r = fast_length(p);
    return r >= least ? std::optional(r) : std::nullopt;
  });
  if (!first) return false;
  base_[0] = *first;
  const Vec3 p = at[*first];
  auto second = rarest([&](const Vec3& q) -> std::optional<double> {
    const double r = fast_length(q);
    if (!(fast_length(cross(p, q)) > 0.2 * fast_length(p) * r) || r < 0.5 * least) return std::nullopt;
    return r + 1.618 * std::sqrt(distance2(p, q));
  });
  line_ = !second;
  if (line_ && from_->spread[1] > near) return false;
  base_[1] = second.value_or(*first);
  return true;
}

std::optional<TransformFields> Matcher::try_frame(const Vec3& p, const Vec3& q, bool mirrored) {
  ++attempts_;
  const Vec3 p0 = from_->at[base_[0]], q0 = line_ ? aside(p0) : from_->at[base_[1]];
  const auto a = frame(p0, q0, false), b = frame(p, q, mirrored);
  if (!a || !b) return std::nullopt;
  Matrix linear;
  linear.m = {};
  for (std::size_t k = 0; k < 3; ++k)
    for (int r = 0; r < 3; ++r)
      for (int c = 0; c < 3; ++c)
        linear(r, c) += factor_ * (*b)[k][static_cast<std::size_t>(r)] * (*a)[k][static_cast<std::size_t>(c)];
  if (!pair_faces(linear, mirrored)) return std::nullopt;
  return settle(pairs_, mirrored);
}

bool Matcher::pair_faces(const Matrix& linear, bool mirrored) {
  taken_.assign(to_->mesh->n_faces(), 0);
  pairs_.assign(from_->at.size(), 0);
  for (std::size_t f = 0; f < from_->mesh->n_faces(); ++f) {
    const bool found = grid_.any_near(linear.point(face_centre(*from_, f)), [&](std::uint32_t g) {
      return !taken_[g] && pair_face(f, g, linear, mirrored) && (taken_[g] = 1);
    });
    if (!found) return false;
  }
  return true;
}

/// Faces may begin with any corner; those of a mirror image run the other way.
bool Matcher::pair_face(std::size_t a, std::size_t b, const Matrix& linear, bool mirrored) {
  const Mesh &m = *from_->mesh, &o = *to_->mesh;
  const auto first = m.begin_of(a), n = m.end_of(a) - first, other = o.begin_of(b);
  if (o.end_of(b) - other != n) return false;
  const double allowed = grid_.near() * grid_.near();
  const std::size_t starts = m.kind == Mesh::Kind::faces ? n : 1;
  for (std::size_t start = 0; start < starts; ++start) {
    auto counterpart = [&](std::size_t i) {
      return other + (mirrored && m.kind == Mesh::Kind::faces ? (start + n - i) % n : (start + i) % n);
    };
    std::size_t i = 0;
    while (i < n && distance2(linear.point(from_->at[first + i]), to_->at[counterpart(i)]) <= allowed) ++i;
    if (i < n) continue;
    for (i = 0; i < n; ++i) pairs_[first + i] = static_cast<std::uint32_t>(counterpart(i));
    return true;
  }
  return false;
}

}  // namespace wrlkit::instancing
