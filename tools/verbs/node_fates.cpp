#include "tools/verbs/node_fates.h"

#include <fmt/format.h>

#include <algorithm>
#include <iterator>

namespace wrlkit {
namespace {

/// `nodes`: names with blanks around them; empty: all others of the component.
struct FateRow {
  std::string_view component, nodes, fate;
};

constexpr std::string_view animated = "animations of glTF; kept", kept = "kept", drawn = "drawn",
                           run = "run in glTF (`--behaviour interactivity`) and on the page of `view`; kept";

constexpr FateRow rows[] = {
    {"CADGeometry", "", drawn},
    {"Core", "", "kept; no picture"},
    {"CubeMapTexturing", "", kept},
    {"DIS", " EspduTransform ", "a Transform; kept"},
    {"DIS", "", kept},
    {"EnvironmentalEffects", " Background TextureBackground ", "drawn in pictures, in glTF with `--sky`; kept"},
    {"EnvironmentalEffects", " Fog ", "drawn in pictures; kept"},
    {"EnvironmentalEffects", "", kept},
    {"EnvironmentalSensor", " ProximitySensor VisibilitySensor ", run},
    {"EnvironmentalSensor", "", kept},
    {"EventUtilities", "", run},
    {"Followers", "", kept},
    {"Geometry2D", "", drawn},
    {"Geometry3D", "", drawn},
    {"Geospatial", " GeoMetadata GeoProximitySensor GeoTouchSensor ", kept},
    {"Geospatial", " GeoPositionInterpolator ", animated},
    {"Geospatial", "", "drawn, in metres around the origin"},
    {"Grouping", "", drawn},
    {"HAnim", " HAnimMotion HAnimDisplacer ", kept},
    {"HAnim", "", "drawn in the pose of the file"},
    {"Interpolation",
     " ColorInterpolator ScalarInterpolator SplineScalarInterpolator PositionInterpolator2D "
     "SplinePositionInterpolator2D ",
     "animations of glTF, those of materials, lights and textures with `--animation-pointer`; kept"},
    {"Interpolation", " CoordinateInterpolator2D ", kept},
    {"Interpolation", "", animated},
    {"KeyDeviceSensor", "", kept},
    {"Layering", "", "drawn as groups"},
    {"Layout", "", "what is below them is drawn"},
    {"Lighting", " EnvironmentLight ", kept},
    {"Lighting", "", drawn},
    {"NURBS", " NurbsSet ", "kept; surfaces are drawn in their Shapes"},
    {"NURBS", " NurbsPositionInterpolator NurbsOrientationInterpolator NurbsSurfaceInterpolator ", animated},
    {"NURBS", "", "drawn as triangles and lines"},
    {"Navigation", "", "cameras, groups and how one moves; kept"},
    {"Networking", " Anchor ", run},
    {"Networking", " LoadSensor ", kept},
    {"Networking", "", "its world is drawn"},
    {"ParticleSystems", " BoundedPhysicsModel ", kept},
    {"ParticleSystems", "", "drawn as they stand in their first second, which is reported"},
    {"Picking", " PickableGroup ", "what is below it is drawn"},
    {"Picking", "", kept},
    {"PointingDeviceSensor", " TouchSensor ", run},
    {"PointingDeviceSensor", "", kept},
    {"Rendering", " Tangent ", kept},
    {"Rendering", "", drawn},
    {"RigidBodyPhysics", " CollidableOffset CollidableShape RigidBody RigidBodyCollection ",
     "what is below them is drawn; kept"},
    {"RigidBodyPhysics", " Contact ", "events of a CollisionSensor; no file has one"},
    {"RigidBodyPhysics", "", kept},
    {"Scripting", "", "run when the user asks for it (`--run-startup`, the page of `view`); kept"},
    {"Shaders", "", kept},
    {"Shape", " LineProperties PointProperties ", "drawn in pictures; glTF says that it has none"},
    {"Shape", " FillProperties ",
     "drawn in pictures; glTF leaves out what is not filled, and says that it has no hatches"},
    {"Shape", " AcousticProperties ", "kept; no picture"},
    {"Shape", "", drawn},
    {"Sound", "", "kept; no picture"},
    {"Text", "", drawn},
    {"TextureProjection", "", kept},
    {"Texturing", " MultiTexture MultiTextureCoordinate MultiTextureTransform ",
     "drawn as one picture, or the first of them, which is reported"},
    {"Texturing", " TextureCoordinateGenerator ",
     "drawn, or near to it where it depends on the viewer, which is reported"},
    {"Texturing", " MovieTexture ", "kept"},
    {"Texturing", "", drawn},
    {"Texturing3D", " TextureCoordinate3D TextureCoordinate4D TextureTransform3D TextureTransformMatrix3D ",
     "drawn over flat pictures"},
    {"Texturing3D", "", kept},
    {"Time", "", animated},
    {"VolumeRendering", "", kept},
};

std::string_view component_of(const NodeType& t) { return t.component.substr(0, t.component.find_first_of(" :")); }

bool is_named(const FateRow& row, const NodeType& t) {
  return row.nodes.find(" " + std::string(t.name) + " ") != row.nodes.npos;
}

const FateRow* row_of(const NodeType& t) {
  const auto fits = [&](const FateRow& row) {
    return row.component == component_of(t) && (row.nodes.empty() || is_named(row, t));
  };
  const auto at = std::ranges::find_if(rows, fits);
  return at == std::end(rows) ? nullptr : at;
}

}  // namespace

std::string_view node_fate(const NodeType& t) {
  const auto* row = row_of(t);
  return row ? row->fate : std::string_view();
}

std::string node_fates_table() {
  std::string out = "| component | nodes | what becomes of them |\n|---|---|---|\n";
  for (const FateRow& row : rows) {
    std::string names;
    for (const NodeType& t : builtin_nodes())
      if (row_of(t) == &row) (names += names.empty() ? "" : ", ") += t.name;
    if (!names.empty()) out += fmt::format("| {} | {} | {} |\n", row.component, names, row.fate);
  }
  return out;
}

}  // namespace wrlkit
