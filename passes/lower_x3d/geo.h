// Nodes with places on Earth as nodes of VRML97, in metres around one origin, so that single precision will do.
#pragma once
#include "base/diagnostics.h"
#include "scenegraph/scene.h"

namespace wrlkit::x3d {

/// Places every node of the component Geospatial (ISO/IEC 19775-1, 25) but GeoMetadata:
///
///   GeoLocation { geoCoords 52 13.4 30 children ... }   ->   Transform { translation ... rotation ... children ... }
///
/// GeoCoordinate becomes Coordinate, GeoElevationGrid an IndexedFaceSet on the round Earth, GeoViewpoint,
/// GeoPositionInterpolator and the sensors those of VRML97, GeoLOD an LOD. The origin is the first GeoOrigin of the
/// scene. Where there is none it is the first place that is named, and Y is up there, X east. A ROUTE of places on
/// Earth leads to translation or position. False: there is nothing of it. O(scene).
bool place_on_earth(Scene&, Diagnostics&);

}  // namespace wrlkit::x3d
