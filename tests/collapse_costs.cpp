// A closed surface with bumps as VRML, and what each of its collapses costs by each criterion: for the viewer page,
// which computes the costs again from the stream (tests/browser/viewer_costs.mjs).
//   collapse_costs FOLDER        writes bumps.wrl and costs.json
#include <fmt/format.h>

#include <cmath>
#include <filesystem>
#include <fstream>
#include <numbers>

#include "geometry/simplify/collapse.h"

using namespace wrlkit;

namespace {

/// A torus, n rings of m; no two edges are alike. Nine digits, to which the stream rounds new vertices.
Mesh bumps(std::uint32_t n, std::uint32_t m) {
  Mesh mesh;
  mesh.kind = Mesh::Kind::faces;
  for (std::uint32_t i = 0; i < n; ++i) {
    for (std::uint32_t j = 0; j < m; ++j) {
      const double a = 2 * std::numbers::pi * i / n, b = 2 * std::numbers::pi * j / m;
      const double r = 0.4 + 0.04 * std::sin(5 * a + 0.3) * std::cos(3 * b + 0.1) + 0.01 * std::sin(17 * a + 2 * b);
      for (const double x : {(1 + r * std::cos(b)) * std::cos(a), (1 + r * std::cos(b)) * std::sin(a), r * std::sin(b)})
        mesh.positions.edit().push_back(std::round(x * 1e9) / 1e9);
      const std::uint32_t i1 = (i + 1) % n, j1 = (j + 1) % m;
      for (const auto& [p, q, s] :
           {std::array{i * m + j, i1 * m + j, i1 * m + j1}, std::array{i * m + j, i1 * m + j1, i * m + j1}})
        mesh.corners.insert(mesh.corners.end(), {p, q, s});
    }
  }
  return mesh;
}

std::string vrml(const Mesh& mesh) {
  std::string text =
      "#VRML V2.0 utf8\nShape { appearance Appearance { material Material { } } geometry IndexedFaceSet { coord "
      "Coordinate { point [\n";
  const auto p = mesh.positions.span();
  for (std::size_t i = 0; i < p.size(); i += 3) text += fmt::format("{:.9f} {:.9f} {:.9f}\n", p[i], p[i + 1], p[i + 2]);
  text += "] } coordIndex [\n";
  for (std::size_t c = 0; c < mesh.corners.size(); c += 3)
    text += fmt::format("{} {} {} -1\n", mesh.corners[c], mesh.corners[c + 1], mesh.corners[c + 2]);
  return text + "] } }\n";
}

std::string costs(const Mesh& mesh, Criterion criterion) {
  Collapser collapser(mesh, {.criterion = criterion, .record = true});
  collapser.run_to(0);
  std::string text;
  for (const auto& step : collapser.record().steps)
    text += fmt::format("{}{:.17g}", text.empty() ? "" : ",", step.cost);
  return text;
}

}  // namespace

int main(int argc, char** argv) {
  if (argc != 2) return 2;
  const std::filesystem::path folder = argv[1];
  std::filesystem::create_directories(folder);
  const Mesh mesh = bumps(60, 24);
  std::ofstream(folder / "bumps.wrl") << vrml(mesh);
  std::ofstream(folder / "costs.json") << fmt::format(
      "{{\"length-normal\":[{}],\"melax\":[{}],\"lindstrom-turk\":[{}]}}", costs(mesh, Criterion::length_normal),
      costs(mesh, Criterion::melax), costs(mesh, Criterion::lindstrom_turk));
}
