// Whether an edge may be collapsed whatever it costs: the topology must stay, and no face may turn over.
#pragma once
#include "geometry/simplify/surface.h"

namespace wrlkit::simplify {

/// The edge from u to v may be collapsed to one vertex, by the faces around: every neighbour that both have is the
/// third corner of a face at the edge (link condition), no two faces become the same, and no face vanishes whose two
/// other edges are both features.
bool keeps_topology(const Ring& u, const Ring& v);

/// With that vertex at x, no face turns by about 80 degrees or more, and none becomes a sliver that was none. Nor does
/// one that turns by ten degrees or more come to lie back on a neighbour, their normals more than 150 degrees apart
/// where they were not: on noisy scans faces turn over step by step. `may_fold` takes this last rule away.
bool keeps_shape(const Surface& surface, const Ring& u, const Ring& v, const Vec3& x, bool may_fold);

/// Where faces around the edge look in opposite directions, as at the end of a wire or on the rim of a sheet: how far
/// the two vertices are from the faces that are left of both rings, squared; 0 elsewhere. The planes of the faces do
/// not tell that an end is drawn in.
double squared_loss_at_fold(const Surface& surface, const Ring& u, const Ring& v, const Vec3& x);

/// The largest distance of x from the planes of the faces and, for x on a feature, from its lines.
double deviation(const Surface& surface, const Ring& u, const Ring& v, const Vec3& x);

}  // namespace wrlkit::simplify
