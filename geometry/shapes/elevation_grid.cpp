// ElevationGrid (ISO/IEC 14772-1, 6.17): quadrilaterals over a regular grid in X and Z, seen from above
// counterclockwise.
#include <cmath>

#include "geometry/geometry_attributes.h"
#include "geometry/shapes/shapes.h"
#include "scenegraph/nodes.h"

namespace wrlkit {
namespace {

namespace fields = nodes::elevation_grid;

// Points along X and Z, no more than there are heights for.
struct Grid {
  std::size_t nx = 0, nz = 0;
};

Grid read_dimensions(MeshJob& job, std::size_t n_heights) {
  const auto x = job.scene.get(job.geometry, fields::xDimension), z = job.scene.get(job.geometry, fields::zDimension);
  if (x < 2 || z < 2) return {};
  Grid grid{static_cast<std::size_t>(x), static_cast<std::size_t>(z)};
  constexpr std::size_t most_points = UINT32_MAX / 4;  // corners are counted in 32 bits
  const std::size_t whole_rows = std::min(n_heights, most_points) / grid.nx;
  if (whole_rows >= grid.nz) return grid;
  if (n_heights > 0)
    job.ctx.diag.report(Diag::short_height, job.scene.where(job.geometry), title(job), n_heights, x, z);
  return whole_rows < 2 ? Grid{} : Grid{grid.nx, whole_rows};
}

class GridWriter {
 public:
  GridWriter(MeshJob& job, Grid grid) : job_(job), mesh_(job.mesh), grid_(grid) {}

  void write(std::span<const double> height) {
    write_points(height);
    for (std::size_t j = 0; j + 1 < grid_.nz; ++j)
      for (std::size_t i = 0; i + 1 < grid_.nx; ++i) write_face(i, j);
    mesh_.face_begin.resize((grid_.nx - 1) * (grid_.nz - 1) + 1);
    for (std::size_t f = 0; f < mesh_.face_begin.size(); ++f) mesh_.face_begin[f] = static_cast<std::uint32_t>(4 * f);
  }

  // From (0, 0) at the first point to (1, 1) at the last.
  void write_default_texcoords() {
    for (std::size_t j = 0; j < grid_.nz; ++j)
      for (std::size_t i = 0; i < grid_.nx; ++i) {
        mesh_.texcoord.values.push_back(static_cast<float>(double(i) / double(grid_.nx - 1)));
        mesh_.texcoord.values.push_back(static_cast<float>(double(j) / double(grid_.nz - 1)));
      }
    mesh_.texcoord.index = mesh_.corners;
  }

 private:
  void write_points(std::span<const double> height) {
    const double dx = finite(job_.scene.get(job_.geometry, fields::xSpacing));
    const double dz = finite(job_.scene.get(job_.geometry, fields::zSpacing));
    auto& positions = mesh_.positions.edit();
    positions.reserve(3 * grid_.nx * grid_.nz);
    for (std::size_t j = 0; j < grid_.nz; ++j)
      for (std::size_t i = 0; i < grid_.nx; ++i)
        positions.insert(positions.end(), {dx * double(i), finite(height[j * grid_.nx + i]), dz * double(j)});
    if (n_not_finite_)
      job_.ctx.diag.report(Diag::not_finite, job_.scene.where(job_.geometry), title(job_), n_not_finite_);
  }

  void write_face(std::size_t i, std::size_t j) {
    const auto a = static_cast<std::uint32_t>(j * grid_.nx + i), below = a + static_cast<std::uint32_t>(grid_.nx);
    mesh_.corners.insert(mesh_.corners.end(), {a, below, below + 1, a + 1});
  }

  double finite(double v) {
    if (std::isfinite(v)) return v;
    ++n_not_finite_;
    return 0;
  }

  MeshJob& job_;
  Mesh& mesh_;
  Grid grid_;
  std::size_t n_not_finite_ = 0;
};

void read_grid_flags(MeshJob& job) {
  job.mesh.kind = Mesh::Kind::faces;
  job.mesh.ccw = job.scene.get(job.geometry, fields::ccw);
  job.mesh.solid = job.scene.get(job.geometry, fields::solid);
  const double crease_angle = job.scene.get(job.geometry, fields::creaseAngle);
  job.mesh.crease_angle = std::isfinite(crease_angle) ? crease_angle : 0;
}

template <FieldType T>
void bind(MeshJob& job, Attribute& attribute, NodeId node, FieldKey<T> key, AttributeBinding binding) {
  if (job.scene.is(node, key.node)) binding.values = job.scene.get(node, key);
  bind_attribute(job, attribute, binding, {});
}

}  // namespace

void make_elevation_grid(MeshJob& job, const Tessellation&) {
  const Scene& scene = job.scene;
  const NodeId n = job.geometry;
  const auto height = scene.get(n, fields::height);
  const Grid grid = read_dimensions(job, height.size());
  if (grid.nx < 2 || grid.nz < 2) return report_no_surface(job, "it has fewer than two rows or columns of heights");

  read_grid_flags(job);
  GridWriter writer(job, grid);
  writer.write(height);
  const double last_x = job.mesh.positions[job.mesh.positions.size() - 3],
               last_z = job.mesh.positions[job.mesh.positions.size() - 1];
  if (!std::isfinite(last_x + last_z)) return report_no_surface(job, "its size is not finite");
  bind(job, job.mesh.color, scene.get(n, fields::color), nodes::color::color,
       {"color", {}, {}, scene.get(n, fields::colorPerVertex)});
  bind(job, job.mesh.normal, scene.get(n, fields::normal), nodes::normal::vector,
       {"normal", {}, {}, scene.get(n, fields::normalPerVertex)});
  bind(job, job.mesh.texcoord, scene.get(n, fields::texCoord), nodes::texture_coordinate::point,
       {"texCoord", {}, {}, true});
  if (!job.mesh.texcoord.present()) writer.write_default_texcoords();
}

}  // namespace wrlkit
