// Extrusion (ISO/IEC 14772-1, 6.18): a ring of points at each point of the spine, quadrilaterals between the rings, a
// polygon on each end. Normals are left to the `normals` pass, which applies creaseAngle; the caps, which are flat
// whatever creaseAngle says, have points of their own as soon as there is something to smooth.
//
// Texture coordinates run from 0 to 1 by the number of the point, not by the length of the way: the standard leaves
// that open, and the browsers count.
#include <algorithm>
#include <cmath>

#include "base/math/box.h"
#include "geometry/geometry_attributes.h"
#include "geometry/shapes/shapes.h"
#include "geometry/shapes/spine.h"
#include "scenegraph/nodes.h"

namespace wrlkit {
namespace {

// Spine and cross-section are multiplied, so that a short file can ask for more than a machine holds.
constexpr std::size_t most_faces = 1'000'000;

// Turns v by an SFRotation; one without an axis turns nothing.
Vec3 rotate(const Vec4& r, const Vec3& v) {
  const Vec3 axis = unit({r[0], r[1], r[2]});
  if (r[3] == 0 || dot(axis, axis) == 0) return v;
  const double c = std::cos(r[3]), s = std::sin(r[3]);
  return c * v + s * cross(axis, v) + (dot(axis, v) * (1 - c)) * axis;
}

struct ExtrusionFields {
  std::vector<Vec2> crossSection, scale;
  std::vector<Vec3> spine;
  std::vector<Vec4> orientation;
  bool beginCap, endCap;
};

class Reader {
 public:
  explicit Reader(MeshJob& job) : job_(job) {}

  ExtrusionFields read() {
    namespace fields = nodes::extrusion;
    const Scene& scene = job_.scene;
    const NodeId n = job_.geometry;
    ExtrusionFields f{list<2>(scene.get(n, fields::crossSection)),
                      list<2>(scene.get(n, fields::scale)),
                      list<3>(scene.get(n, fields::spine)),
                      list<4>(scene.get(n, fields::orientation)),
                      scene.get(n, fields::beginCap),
                      scene.get(n, fields::endCap)};
    fit(f.scale, {1, 1}, f.spine.size(), "scale");
    fit(f.orientation, {0, 0, 1, 0}, f.spine.size(), "orientation");
    if (n_not_finite_) job_.ctx.diag.report(Diag::not_finite, scene.where(n), title(job_), n_not_finite_);
    return f;
  }

 private:
  template <std::size_t N>
  std::vector<std::array<double, N>> list(std::span<const double> flat) {
    std::vector<std::array<double, N>> out(flat.size() / N);
    for (std::size_t i = 0; i < out.size() * N; ++i) {
      double v = flat[i];
      if (!std::isfinite(v)) {
        v = 0;
        ++n_not_finite_;
      }
      out[i / N][i % N] = v;
    }
    return out;
  }

  // One value is for all points of the spine; too few are undefined by the standard, and the last one is repeated.
  template <class T>
  void fit(std::vector<T>& v, const T& fallback, std::size_t n, std::string_view what) {
    if (v.size() > 1 && v.size() < n)
      job_.ctx.diag.report(Diag::short_attribute, job_.scene.where(job_.geometry), title(job_), what, "spine");
    v.resize(n, v.empty() ? fallback : v.back());
  }

  MeshJob& job_;
  std::size_t n_not_finite_ = 0;
};

// Rings of points and the faces between them. A cross-section that is closed shares its first point, and so does a
// spine whose last ring falls on the first.
class Extruder {
 public:
  Extruder(Mesh& mesh, const ExtrusionFields& f)
      : mesh_(mesh),
        positions_(mesh.positions.edit()),
        f_(f),
        n_section_(static_cast<std::uint32_t>(f.crossSection.size())),
        closed_(f.crossSection.front() == f.crossSection.back()),
        n_ring_(closed_ ? n_section_ - 1 : n_section_) {}

  void write() {
    mesh_.face_begin.push_back(0);
    write_points();
    write_side_texcoords();
    const auto n_spine = static_cast<std::uint32_t>(f_.spine.size());
    for (std::uint32_t i = 0; i + 1 < n_spine; ++i)
      for (std::uint32_t k = 0; k + 1 < n_section_; ++k)
        face({corner(i, k), corner(i, k + 1), corner(i + 1, k + 1), corner(i + 1, k)});
    if (n_ring_ < 3) return;
    write_cap_texcoords();
    if (f_.beginCap) cap(0, false);
    if (f_.endCap) cap(n_spine - 1, true);
  }

 private:
  struct Corner {
    std::uint32_t position, texcoord;
  };

  Vec3 point(std::uint32_t p) const { return {positions_[3 * p], positions_[3 * p + 1], positions_[3 * p + 2]}; }

  void write_points() {
    const auto planes = spine_planes(f_.spine);
    for (std::size_t i = 0; i < f_.spine.size(); ++i)
      for (std::uint32_t k = 0; k < n_ring_; ++k) {
        const Vec3 in_plane = rotate(
            f_.orientation[i], {f_.scale[i][0] * f_.crossSection[k][0], 0, f_.scale[i][1] * f_.crossSection[k][1]});
        const Vec3 p = f_.spine[i] + in_plane[0] * planes[i].x + in_plane[1] * planes[i].y + in_plane[2] * planes[i].z;
        positions_.insert(positions_.end(), p.begin(), p.end());
      }
    const auto last = positions_.end() - 3 * std::ptrdiff_t{n_ring_};
    spine_closed_ = f_.spine.size() > 2 && std::equal(last, positions_.end(), positions_.begin());
    if (spine_closed_) positions_.erase(last, positions_.end());
  }

  void write_side_texcoords() {
    const double n_along = static_cast<double>(f_.spine.size() - 1), n_across = n_section_ - 1;
    for (std::size_t i = 0; i < f_.spine.size(); ++i)
      for (std::uint32_t k = 0; k < n_section_; ++k) texcoord(k / n_across, static_cast<double>(i) / n_along);
  }

  // The cross-section scaled into the texture square; S follows X, T follows Z.
  void write_cap_texcoords() {
    cap_texcoords_ = static_cast<std::uint32_t>(mesh_.texcoord.count());
    Box2 box;
    for (auto& c : f_.crossSection) box.add(c);
    const auto &low = box.low, &high = box.high;
    const double larger = std::max(high[0] / 2 - low[0] / 2, high[1] / 2 - low[1] / 2);  // halves do not overflow
    auto scaled = [&](std::uint32_t k, std::size_t axis) {
      return larger > 0 ? (f_.crossSection[k][axis] / 2 - low[axis] / 2) / larger : 0;
    };
    for (std::uint32_t k = 0; k < n_ring_; ++k) texcoord(scaled(k, 0), scaled(k, 1));
  }

  void texcoord(double s, double t) {
    mesh_.texcoord.values.insert(mesh_.texcoord.values.end(), {static_cast<float>(s), static_cast<float>(t)});
  }

  std::uint32_t ring(std::uint32_t i) const { return spine_closed_ && i + 1 == f_.spine.size() ? 0 : i * n_ring_; }
  Corner corner(std::uint32_t i, std::uint32_t k) const { return {ring(i) + k % n_ring_, i * n_section_ + k}; }

  // A quadrilateral with two equal neighbours is a triangle, as where a scale of 0 makes a tip; with less it is
  // nothing.
  void face(std::initializer_list<Corner> quad) {
    const Corner* c = quad.begin();
    std::array<bool, 4> kept{};
    for (std::size_t k = 0; k < 4; ++k) kept[k] = point(c[k].position) != point(c[(k + 1) % 4].position);
    if (std::ranges::count(kept, true) < 3) return;
    for (std::size_t k = 0; k < 4; ++k)
      if (kept[k]) add(c[k]);
    end_face();
  }

  void cap(std::uint32_t i, bool at_end) {
    std::uint32_t first = ring(i);
    bool one_point = true;
    for (std::uint32_t k = 1; k < n_ring_; ++k) one_point &= point(first + k) == point(first);
    if (one_point) return;
    if (mesh_.crease_angle > 0) first = copy_ring(first);
    for (std::uint32_t k = 0; k < n_ring_; ++k) {
      const std::uint32_t at = at_end ? k : n_ring_ - 1 - k;
      add({first + at, cap_texcoords_ + at});
    }
    end_face();
  }

  std::uint32_t copy_ring(std::uint32_t first) {
    const auto copy = static_cast<std::uint32_t>(positions_.size() / 3);
    for (std::size_t v = 0; v < 3 * std::size_t{n_ring_}; ++v)
      positions_.push_back(positions_[3 * std::size_t{first} + v]);
    return copy;
  }

  void add(Corner c) {
    mesh_.corners.push_back(c.position);
    mesh_.texcoord.index.push_back(c.texcoord);
  }
  void end_face() { mesh_.face_begin.push_back(static_cast<std::uint32_t>(mesh_.corners.size())); }

  Mesh& mesh_;
  std::vector<double>& positions_;
  const ExtrusionFields& f_;
  std::uint32_t n_section_;
  bool closed_;
  std::uint32_t n_ring_;
  bool spine_closed_ = false;
  std::uint32_t cap_texcoords_ = 0;
};

void read_extrusion_flags(MeshJob& job) {
  namespace fields = nodes::extrusion;
  job.mesh.kind = Mesh::Kind::faces;
  job.mesh.ccw = job.scene.get(job.geometry, fields::ccw);
  job.mesh.solid = job.scene.get(job.geometry, fields::solid);
  job.mesh.convex = job.scene.get(job.geometry, fields::convex);
  const double crease_angle = job.scene.get(job.geometry, fields::creaseAngle);
  job.mesh.crease_angle = std::isfinite(crease_angle) ? crease_angle : 0;
}

bool all_finite(std::span<const double> values) {
  return std::ranges::all_of(values, [](double v) { return std::isfinite(v); });
}

}  // namespace

void make_extrusion(MeshJob& job, const Tessellation&) {
  auto fields = Reader(job).read();
  if (fields.spine.size() < 2) return report_no_surface(job, "its spine has fewer than two points");
  if (fields.crossSection.size() < 2) return report_no_surface(job, "its crossSection has fewer than two points");
  if (fields.crossSection.size() > most_faces / fields.spine.size()) {
    job.ctx.diag.report(Diag::expansion_limit, job.scene.where(job.geometry), most_faces, "faces in one Extrusion");
    fields.crossSection.resize(std::min(fields.crossSection.size(), most_faces / 2));
    fields.spine.resize(std::min(fields.spine.size(), most_faces / fields.crossSection.size()));
  }
  read_extrusion_flags(job);
  Extruder(job.mesh, fields).write();
  if (!all_finite(job.mesh.positions.span())) return report_no_surface(job, "its size is not finite");
  if (job.mesh.corners.empty()) report_no_surface(job, "all its points coincide");
}

}  // namespace wrlkit
