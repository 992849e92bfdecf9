// Arrays of make_normals that serve one mesh after another; normals.cpp explains them.
#pragma once
#include <cstdint>
#include <vector>

namespace wrlkit {

struct NormalsScratch {
  struct FaceNormal {
    float x, y, z, weight;
  };
  struct Edge {
    std::uint32_t other, link;
  };
  struct Seen {
    std::uint32_t from, edge;
  };

  std::vector<FaceNormal> face_normals;
  std::vector<Edge> edges;
  std::vector<Seen> seen;
  std::vector<std::uint32_t> ids, first_edge, face_of, groups, recent;
};

}  // namespace wrlkit
