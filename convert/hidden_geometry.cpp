#include "convert/hidden_geometry.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <set>
#include <string>
#include <vector>

#include "convert/expanded_copy.h"
#include "convert/startup_scripts.h"
#include "scenegraph/any_node.h"
#include "scenegraph/nodes.h"
#include "scenegraph/switches.h"
#include "scenegraph/walk.h"

namespace wrlkit {
namespace {

constexpr double least_share = 0.1;
constexpr std::size_t most_names = 4;

double triangles_of_faces(std::span<const std::int32_t> indices) {
  double out = 0;
  std::size_t corners = 0;
  for (const auto i : indices) {
    if (i >= 0)
      ++corners;
    else
      out += static_cast<double>(std::max<std::size_t>(corners, 2) - 2);
    if (i < 0) corners = 0;
  }
  return out + static_cast<double>(std::max<std::size_t>(corners, 2) - 2);
}

/// The elements of a field that its type may have.
std::size_t n_elements(const Scene& scene, NodeId n, std::string_view field) {
  const auto slot = scene.type(n).find(field, Dialect::x3d);
  return slot ? scene.value(n, *slot).count : 0;
}

/// The sets of X3D: of their indices, or of all their points.
double triangles_of_set(const Scene& scene, NodeId n) {
  auto corners = n_elements(scene, n, "index");
  for_each_child(scene, n, [&](NodeId c) { corners = std::max(corners, n_elements(scene, c, "point")); });
  const bool are_quads = scene.is(n, nodes::QuadSet) || scene.is(n, nodes::IndexedQuadSet);
  const bool are_triangles = scene.is(n, nodes::TriangleSet) || scene.is(n, nodes::IndexedTriangleSet);
  return static_cast<double>(corners) / (are_triangles ? 3 : are_quads ? 2 : 1);
}

bool is_line_or_point(const Scene& scene, NodeId n) {
  return scene.is(n, nodes::IndexedLineSet) || scene.is(n, nodes::LineSet) || scene.is(n, nodes::PointSet);
}

/// About what a geometry becomes; 0 for other nodes.
double triangles_of(const Scene& scene, NodeId n) {
  constexpr double of_box = 12, of_cone = 62, of_cylinder = 124, of_sphere = 960;  // as they are drawn
  constexpr double of_curved = 100;                                                // about
  if (!scene.is(n, nodes::X3DGeometryNode) || is_line_or_point(scene, n)) return 0;
  if (scene.is(n, nodes::IndexedFaceSet)) return triangles_of_faces(scene.get(n, nodes::indexed_face_set::coordIndex));
  if (scene.is(n, nodes::Box)) return of_box;
  if (scene.is(n, nodes::Cone)) return of_cone;
  if (scene.is(n, nodes::Cylinder)) return of_cylinder;
  if (scene.is(n, nodes::Sphere)) return of_sphere;
  const bool is_set = scene.is(n, nodes::X3DComposedGeometryNode) && !scene.is(n, nodes::ElevationGrid);
  return is_set ? triangles_of_set(scene, n) : of_curved;
}

/// Triangles below the nodes of a scene, each counted as often as it stands there.
class Census {
 public:
  explicit Census(const Scene& scene) : scene_(scene), counts_(scene.node_count()) {
    std::vector<char> seen(scene.node_count());
    std::vector<NodeId> stack(scene.main.roots.begin(), scene.main.roots.end());
    while (!stack.empty()) {  // children before parents
      const NodeId n = stack.back();
      if (seen[n.value]++) {
        stack.pop_back();
        if (seen[n.value] == 2) counts_[n.value] = count(n);
        seen[n.value] = 3;
        continue;
      }
      for_each_child(scene, n, [&](NodeId c) {
        if (!seen[c.value]) stack.push_back(c);
      });
    }
  }

  double all() const { return sum(scene_.main.roots, &Count::all); }
  double hidden() const { return sum(scene_.main.roots, &Count::hidden); }

  /// The Switch that hides most.
  NodeId first() const {
    NodeId out;
    for (const NodeId n : reachable(scene_, scene_.main))
      if (is_switched_off(scene_, n) && (!out || counts_[n.value].all > counts_[out.value].all)) out = n;
    return out;
  }

  /// The Switches that are off, those that hide most first.
  std::vector<std::string> names() const {
    std::map<std::string, double> by_name;
    for (const NodeId n : reachable(scene_, scene_.main))
      if (is_switched_off(scene_, n) && counts_[n.value].all > 0)
        by_name[std::string(scene_.name(n))] += counts_[n.value].all;
    std::vector<std::pair<double, std::string>> order;
    for (auto& [name, hidden] : by_name) order.emplace_back(-hidden, name.empty() ? "without a name" : name);
    std::ranges::sort(order);
    std::vector<std::string> out;
    for (auto& [hidden, name] : order) out.push_back(std::move(name));
    return out;
  }

 private:
  struct Count {
    double all = 0, hidden = 0;
  };

  double sum(std::span<const NodeId> nodes, double Count::*member) const {
    double out = 0;
    for (const NodeId n : nodes) out += counts_[n.value].*member;
    return out;
  }
  Count count(NodeId n) const {
    Count out{triangles_of(scene_, n), 0};
    if (scene_.is(n, nodes::LOD)) {
      const auto shown = shown_children(scene_, n);
      return {sum(shown, &Count::all), sum(shown, &Count::hidden)};
    }
    for_each_child(scene_, n, [&](NodeId c) {
      out.all += counts_[c.value].all;
      out.hidden += counts_[c.value].hidden;
    });
    if (is_switched_off(scene_, n)) out.hidden = out.all;
    return out;
  }

  const Scene& scene_;
  std::vector<Count> counts_;
};

/// In whole per cent; 100 only where nothing is shown.
int per_cent(double hidden, double all) {
  const auto rounded = static_cast<int>(std::lround(100 * hidden / all));
  return hidden < all ? std::min(rounded, 99) : rounded;
}

/// Whether there is a Switch, or may be one, in a scene or in the files that it shows.
class SwitchSearch {
 public:
  SwitchSearch(Resources* files, Diagnostics& diag) : files_(files), diag_(diag) {}

  bool finds(const Scene& scene) {
    if (!seen_.insert(&scene).second) return false;
    if (any_node(scene, [&](NodeId n) { return is_switch(scene, n); })) return true;
    if (!files_) return false;
    for (std::uint32_t i = 0; i < scene.node_count(); ++i)
      if (finds_below(scene, NodeId{i})) return true;
    return false;
  }

 private:
  bool finds_below(const Scene& scene, NodeId n) {
    if (scene.is(n, nodes::vrml1::WWWInline) || scene.is(n, nodes::vrml1::File))
      return true;  // read when it is lowered
    if (!scene.is(n, nodes::Inline) || !scene.get(n, nodes::inline_::load)) return false;
    if (scene.value(n, nodes::inline_::url.slot).is) return true;
    const auto urls = scene.get(n, nodes::inline_::url);
    if (urls.empty()) return false;
    const auto world = files_->world(urls, scene.where(n), diag_).scene;
    return world && finds(*world);
  }

  Resources* files_;
  Diagnostics& diag_;
  std::set<const Scene*> seen_;
};

void report_hidden(const Scene& scene, Diagnostics& diag) {
  const Census census(scene);
  const double all = census.all(), hidden = census.hidden();
  if (!(hidden >= least_share * all) || hidden == 0 || !std::isfinite(all)) return;
  const auto names = census.names();
  std::string list;
  for (std::size_t i = 0; i < std::min(names.size(), most_names); ++i) list += (i ? ", " : "") + names[i];
  if (names.size() > most_names) list += ", ...";
  const bool scripted = startup_scripts(scene).switches();
  diag.report(Diag::hidden_geometry, scene.where(census.first()), per_cent(hidden, all), list,
              scripted ? "; --run-startup runs the Scripts that may turn them on" : "");
}

}  // namespace

void report_hidden_geometry(const Scene& scene, Resources* files, Diagnostics& diag) {
  if (SwitchSearch(files, diag).finds(scene)) report_hidden(expanded_copy(scene, files, diag), diag);
}

}  // namespace wrlkit
