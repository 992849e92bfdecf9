// Surfaces of a tile that stand in several places: found as the pass `instance` finds them, whatever files and nodes
// they are from, and whether they are simplified.
#pragma once
#include <span>
#include <vector>

#include "convert/tiles/piece.h"
#include "scenegraph/transform.h"

namespace wrlkit::tiles {

/// One surface, and where it stands.
struct Repeat {
  struct Place {
    std::uint32_t piece;
    TransformFields where;  // in the coordinates of the pieces
  };
  Mesh mesh;                  // of the first place, around the mean of its corners
  std::vector<Place> places;  // in the order of the pieces
};

/// Surfaces that four pieces or more show, with one look, turned, moved and scaled by one factor: each corner is within
/// `tolerance` metres of where it was. What else moves a piece, a mirror or a scale along one axis, makes another
/// surface of it. Lines and points have none: three.js draws no more than one of theirs. No piece is in two. The same
/// for the same pieces. Expected linear in the corners; memory: a form of each different surface.
std::vector<Repeat> repeats_of(std::span<const Piece> pieces, double tolerance);

/// Of those, the ones that save most bytes of a tile as it is stored; at most as many, and none that saves nothing.
std::vector<Repeat> worthwhile(std::vector<Repeat> repeats, std::size_t most);

}  // namespace wrlkit::tiles
