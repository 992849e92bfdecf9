// What the surface of a scene looks like: how much of it has which colours and which picture.
#pragma once
#include <array>
#include <compare>
#include <cstdint>
#include <map>
#include <string>
#include <unordered_map>
#include <vector>

#include "base/diagnostics.h"
#include "geometry/mesh.h"
#include "scenegraph/resources.h"
#include "scenegraph/scene.h"
#include "scenegraph/transform.h"

namespace wrlkit {

/// In 255ths, colours as displayed. The places of pictures are no part of it.
struct SurfaceLook {
  std::array<std::uint8_t, 3> color{}, emissive{}, specular{};
  std::uint8_t opacity = 255, shininess = 0;  // shininess: 0 without specular
  bool is_lit = true;
  std::string picture;  // of equal pixels the same: their hash; empty: there is none

  auto operator<=>(const SurfaceLook&) const = default;
};

/// "#cc0000", "#cc0000 transparent 50 %, with a picture".
std::string text_of(const SurfaceLook&);

class LookCensus {
 public:
  /// Of a scene whose prototypes and Inlines are expanded. What cannot be read is reported.
  LookCensus(const Scene& scene, Resources* resources, Diagnostics& diag);

  /// The mesh of a geometry, wherever a Shape shows it; once for each geometry. Meshes that are not triangles are
  /// passed over. O(triangles x places).
  void add(NodeId geometry, const Mesh& mesh);

  /// Square metres of the world of each look.
  const std::map<SurfaceLook, double>& areas() const { return areas_; }

 private:
  struct Use {
    NodeId appearance;
    Matrix place;
  };
  SurfaceLook look_of(NodeId appearance, const Mesh& mesh);
  std::string picture_of(NodeId texture);

  const Scene& scene_;
  Resources* resources_;
  Diagnostics& diag_;
  std::unordered_map<std::uint32_t, std::vector<Use>> uses_;  // by geometry
  std::unordered_map<std::uint32_t, std::string> pictures_;   // by texture node
  std::map<SurfaceLook, double> areas_;
};

/// A look that one scene has more of than the other.
struct LookChange {
  SurfaceLook look;
  double share = 0;  // of the surface

  void fields(auto&& f) const {
    f("look", text_of(look));
    f("share", share);
  }
};

struct LookDifference {
  double share = 0;                    // of the surface that looks otherwise
  std::vector<LookChange> gone, made;  // the largest first
};

/// By shares of the surface. Colours that differ by no more than 2 of 255 are the same: other formats round otherwise.
/// O(n log n) in the looks, O(n^2) in those that only one of the scenes has, of which 2,000 are matched.
LookDifference difference(const std::map<SurfaceLook, double>& a, const std::map<SurfaceLook, double>& b);

}  // namespace wrlkit
