// What the traversal of VRML 1.0 knows at a node except the transformation: which property nodes are in force. Equal
// states make equal Shapes, so that what is used again in the same state is made once.
#pragma once
#include <algorithm>
#include <array>
#include <compare>
#include <cstdint>
#include <string_view>

#include "scenegraph/ids.h"

namespace wrlkit::vrml1 {

enum class Binding : std::uint8_t {
  automatic,
  overall,
  per_part,
  per_part_indexed,
  per_face,
  per_face_indexed,
  per_vertex,
  per_vertex_indexed
};

inline Binding read_binding(std::string_view word) {
  constexpr std::array<std::string_view, 8> words{"DEFAULT",  "OVERALL",          "PER_PART",   "PER_PART_INDEXED",
                                                  "PER_FACE", "PER_FACE_INDEXED", "PER_VERTEX", "PER_VERTEX_INDEXED"};
  auto i = std::ranges::find(words, word);
  return i == words.end() ? Binding::automatic : static_cast<Binding>(i - words.begin());
}

/// True for faces or parts, not of corners; overall is neither.
inline bool of_faces(Binding b) { return b >= Binding::per_part && b <= Binding::per_face_indexed; }
inline bool of_corners(Binding b) { return b >= Binding::per_vertex; }

enum class Drawing : std::uint8_t { filled, lines, points, invisible };

struct State {
  // Property nodes of the file, and VertexProperty; none: the default.
  NodeId coord, normal, material, color, texture, texture_coord, hints, font;
  NodeId draw_style;                    // one that says how lines or points look
  std::uint32_t texture_transform = 0;  // of Looks
  Binding material_binding = Binding::automatic, normal_binding = Binding::automatic,
          texture_binding = Binding::automatic;
  Drawing drawing = Drawing::filled;
  bool lit = true;
  std::uint8_t unit = 0;  // of Units
  std::int32_t chosen =
      -1;  // whichChild of the last Switch, for those that inherit it; -1 where there are none of them
  auto operator<=>(const State&) const = default;
};

}  // namespace wrlkit::vrml1
