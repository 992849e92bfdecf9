// Edge collapse: levels as PLY for measuring their quality elsewhere (simplify_quality.py), and triangles a CPU second.
//   simplify_bench levels IN.wrl OUT CRITERION 0.5,0.25,...   writes OUT_0.5.ply, ...
//   simplify_bench speed IN.wrl|N [CRITERION,...]             each criterion to 10 %, one line each; a number makes a
//                                                             torus with bumps of N triangles

#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <sstream>
#include <string>
#include <vector>

#include "bench/loaded_world.h"
#include "bench/process_cost.h"
#include "geometry/simplify/levels.h"

namespace {

using namespace wrlkit;

Criterion criterion(const std::string& name) {
  CriterionName chosen;
  if (!chosen.read(name)) {
    std::fprintf(stderr, "no criterion '%s'\n", name.c_str());
    std::exit(2);
  }
  return chosen.value;
}

std::vector<std::string> split(const std::string& s) {
  std::vector<std::string> parts;
  std::istringstream in(s);
  for (std::string p; std::getline(in, p, ',');) parts.push_back(p);
  return parts;
}

/// The largest mesh of the file, its points joined, as `simplify` takes it: what only touches would crack.
Mesh read(const char* path) {
  LoadedWorld world(path, "weld,triangulate");
  Mesh largest;
  world.each_mesh([&](const Mesh& m) {
    if (m.corners.size() <= largest.corners.size()) return;
    largest = m;
    largest.positions.edit();
  });
  return largest;
}

Mesh bumpy_torus(double n_faces) {
  Mesh m;
  m.kind = Mesh::Kind::faces;
  const auto rings = static_cast<std::uint32_t>(std::sqrt(n_faces)), sides = rings / 2;
  auto& p = m.positions.edit();
  for (std::uint32_t i = 0; i < rings; ++i)
    for (std::uint32_t j = 0; j < sides; ++j) {
      double a = 6.283185307179586 * i / rings, b = 6.283185307179586 * j / sides, r = 0.4;
      for (double f = 5, h = 0.03; f < 200; f *= 2.3, h /= 2)
        r += h * std::sin(f * a + f) * std::sin(std::floor(f) * b);
      p.insert(p.end(), {(1 + r * std::cos(b)) * std::cos(a), (1 + r * std::cos(b)) * std::sin(a), r * std::sin(b)});
      std::uint32_t i1 = (i + 1) % rings, j1 = (j + 1) % sides;
      std::uint32_t q[] = {i * sides + j, i1 * sides + j, i1 * sides + j1, i * sides + j1};
      m.corners.insert(m.corners.end(), {q[0], q[1], q[2], q[0], q[2], q[3]});
    }
  return m;
}

void write_ply(const Mesh& m, const std::string& path) {
  std::FILE* out = std::fopen(path.c_str(), "wb");
  if (!out) {
    std::perror(path.c_str());
    std::exit(1);
  }
  std::fprintf(out,
               "ply\nformat binary_little_endian 1.0\nelement vertex %zu\nproperty float x\nproperty float y\n"
               "property float z\nelement face %zu\nproperty list uchar int vertex_indices\nend_header\n",
               m.n_positions(), m.n_faces());
  for (std::size_t i = 0; i < m.positions.size(); ++i) {
    float f = static_cast<float>(m.positions[i]);
    std::fwrite(&f, 4, 1, out);
  }
  for (std::size_t f = 0; f < m.n_faces(); ++f) {
    std::fputc(3, out);
    std::fwrite(&m.corners[3 * f], 4, 3, out);
  }
  std::fclose(out);
}

void levels(const Mesh& mesh, const std::string& out, Criterion by, const std::string& ratios) {
  double begin = cpu_seconds();
  Collapser c(mesh, {.criterion = by});
  for (const std::string& r : split(ratios)) {
    c.run_to(static_cast<std::size_t>(static_cast<double>(mesh.n_faces()) * std::stod(r)));
    std::printf("ratio=%s faces=%zu error=%.4e cpu=%.3f\n", r.c_str(), c.n_faces(), c.error(), cpu_seconds() - begin);
    write_ply(c.mesh(), out + "_" + r + ".ply");
  }
}

void speed(const Mesh& mesh, Criterion by) {
  double before = peak_megabytes(), begin = cpu_seconds(), n = static_cast<double>(mesh.n_faces());
  Collapser c(mesh, {.criterion = by});
  double built = cpu_seconds() - begin;
  c.run_to(mesh.n_faces() / 10);
  double seconds = cpu_seconds() - begin;
  std::printf("%-15s faces=%zu to=%zu built=%.3f cpu=%.3f ktriangles/s=%.0f bytes/triangle=%.0f\n",
              info(by).name.c_str(), mesh.n_faces(), c.n_faces(), built, seconds, n / seconds / 1e3,
              1048576 * (peak_megabytes() - before) / n);
  std::fflush(stdout);
}

}  // namespace

int main(int argc, char** argv) {
  if (argc < 3) {
    std::fprintf(stderr, "see the head of simplify_bench.cpp\n");
    return 2;
  }
  Mesh mesh = std::atof(argv[2]) > 0 ? bumpy_torus(std::atof(argv[2])) : read(argv[2]);
  if (!std::strcmp(argv[1], "levels") && argc == 6)
    levels(mesh, argv[3], criterion(argv[4]), argv[5]);
  else
    for (const std::string& name : argc > 3 ? split(argv[3]) : criterion_names()) speed(mesh, criterion(name));
}
