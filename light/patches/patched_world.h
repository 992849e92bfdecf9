// The surfaces of a scene, cut into patches: what light falls on and leaves in the methods of radiosity. Each patch has
// one side, or two where its Shape is lit on both (solid FALSE). Patches are flat; normals of the file do not bend
// them.
#pragma once
#include <memory>
#include <span>
#include <vector>

#include "light/flux.h"
#include "light/patches/patch_mesh.h"
#include "light/world.h"

namespace wrlkit::light {

struct PatchSizes {
  double max_edge = 0, max_area = 0;      // metres, square metres; none of both: some twenty thousand patches
  std::size_t most_patches = 10'000'000;  // a side is one
};

class PatchedWorld {
 public:
  static constexpr std::uint32_t none = 0xffffffffu;

  struct Side {
    std::uint32_t use, face;  // of mesh(use)
    bool back;
  };

  /// `world` must stay. When there would be more than most_patches, they become larger, which is reported. O(patches).
  PatchedWorld(const LightWorld& world, const PatchSizes& sizes, Diagnostics& diag);

  const LightWorld& world() const { return world_; }
  std::size_t n_uses() const { return uses_.size(); }
  const PatchMesh& mesh(std::uint32_t use) const { return *uses_[use].mesh; }
  /// Has that Shape patches? Lines and points have none.
  bool has_patches(std::uint32_t use) const { return uses_[use].mesh != nullptr; }
  bool both_sides(std::uint32_t use) const { return uses_[use].both_sides; }
  /// What was asked for, or became of it.
  const PatchSizes& sizes() const { return sizes_; }

  // Sides are numbered by use, front faces before back faces.
  std::size_t n_sides() const { return sides_.size(); }
  std::uint32_t first_side(std::uint32_t use) const { return uses_[use].first; }
  const Side& side(std::uint32_t s) const { return sides_[s]; }
  double area(std::uint32_t s) const { return areas_[s]; }
  /// Means over the patch: reflectance and emitted radiance.
  const V3& albedo(std::uint32_t s) const { return albedo_[s]; }
  const V3& emission(std::uint32_t s) const { return emission_[s]; }

  /// A place on a side, for u and v in the unit square; the same area everywhere.
  Receiver receiver(std::uint32_t s, double u, double v) const;
  /// The side that a ray has met; none: the black back of a solid face.
  std::uint32_t side_at(const Hit& hit, const V3& position) const;

  /// Splits the patches that these numbers of sides belong to, and counts all afresh.
  void refine(std::span<const std::uint32_t> sides);

 private:
  struct Use {
    std::unique_ptr<PatchMesh> mesh;
    std::uint32_t first = 0;
    bool both_sides = false;
  };
  void cut(Diagnostics& diag);
  bool try_to_cut();
  std::vector<std::array<V3, 3>> triangles_of(std::uint32_t use) const;
  double total_area() const;  // of all sides
  double least_patches() const;
  void enlarge(double factor);
  void number_sides();
  void paint(std::uint32_t s);

  const LightWorld& world_;
  PatchSizes sizes_;
  std::vector<Use> uses_;
  std::vector<Side> sides_;
  std::vector<double> areas_;
  std::vector<V3> albedo_, emission_;
};

}  // namespace wrlkit::light
