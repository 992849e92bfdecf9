// From a chain of rings to the forms that it is made of.
#pragma once
#include <vector>

#include "geometry/recognise/recognise.h"
#include "geometry/recognise/rings.h"

namespace wrlkit::recognising {

/// A ring with what a circle through its points would be.
struct Ring {
  std::vector<Vec3> at;  // by column
  Vec3 centre{}, normal{};
  double radius = 0;
  bool apex = false, round = false;
};

/// The forms of a chain, each with its faces of the piece; those that do not fit are in none. `rank` says which of
/// several readings of one part is to be preferred: the lower.
struct Reading {
  std::vector<RecognisedForm> forms;
  std::size_t n_faces = 0;  // in the forms
  int rank = 0;
};

Reading read_chain(const Piece& piece, const Chain& chain, const RecogniseOptions& options);

/// A region with holes and the chains that begin at its loops: a ring, or a prism with holes. Nothing when the chains
/// do not end in one other region.
Reading read_hollow(const Piece& piece, const std::vector<Chain>& chains, const RecogniseOptions& options);

}  // namespace wrlkit::recognising
