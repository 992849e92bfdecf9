// EXTERNPROTOs that name a node which browsers have, by a urn: "urn:web3d:vrml97:node:GeoCoordinate".
#pragma once
#include "scenegraph/scene.h"

namespace wrlkit {

/// A prototype with the interface of an EXTERNPROTO and that node for a body, every field of the interface one of the
/// node's; none when the table has no such node, or no url is a urn.
ProtoId native_proto(Scene&, const Proto& external);

}  // namespace wrlkit
