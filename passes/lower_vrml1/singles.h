// Nodes of VRML 1.0 that have a counterpart which does not depend on the state: cameras, lights, files, text.
#pragma once
#include "base/diagnostics.h"
#include "scenegraph/transform.h"

namespace wrlkit::vrml1 {

/// A Viewpoint. An OrthographicCamera is moved to where as much is seen in perspective at its focalDistance.
NodeId viewpoint(Scene&, NodeId camera, Diagnostics&);
/// A light; `axes`: what a direction is turned by. PointLight and SpotLight shine without limit. Of a ClipPlane, which
/// cuts what follows as a DirectionalLight lights it, that of X3D, moved by `axes`.
NodeId light(Scene&, NodeId, const Matrix& axes, Diagnostics&);
/// An Inline of a WWWInline or a File; none when it names nothing.
NodeId inline_of(Scene&, NodeId);
/// WorldInfo, or what the browsers of the time took an Info of that name for: Title, Viewer, BackgroundColor.
NodeId info_of(Scene&, NodeId);
/// A Fog of an Environment; none when it has none.
NodeId fog_of(Scene&, NodeId, Diagnostics&);
/// What a transform node does; none when it does nothing in VRML97, which is reported.
TransformFields transform_of(const Scene&, NodeId, Diagnostics&);
/// The matrix for row vectors, as MatrixTransform has it. A projection is lost, which is reported.
Matrix matrix_of_rows(std::span<const double> sixteen, Span where, Diagnostics&);
/// Metres in a unit of Units.units, and its number.
double metres(std::string_view unit, std::uint8_t& number);
double metres(std::uint8_t number);

}  // namespace wrlkit::vrml1
