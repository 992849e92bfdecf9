#include "convert/forms_census.h"

#include <algorithm>

#include "convert/geometry_census.h"
#include "geometry/forms/form_node.h"
#include "passes/pipeline/pipeline.h"

namespace wrlkit {

std::optional<FormsCensus> count_forms(Document& document, const MeshSource& triangles) {
  Scene& scene = document.scene();
  Diagnostics unheard(document.diag().shared_sources());
  Statistics counts;
  PassContext context{unheard, counts, document.context().resources, nullptr, document.context().stop};
  std::string why;
  if (!Pipeline::parse("join,recognise", why)->run(scene, context)) return std::nullopt;
  Places places;
  if (!find_places(scene, places)) return std::nullopt;
  FormsCensus out;
  for (const auto& [geometry, where] : places) {
    const NodeId n{geometry};
    if (const auto form = read_form(scene, n))
      out.parts[std::string(kind_of(*form))] += where.size();
    else if (const Mesh& mesh = triangles(n); mesh.kind == Mesh::Kind::faces)
      out.triangles_left += mesh.n_faces() * where.size();
  }
  out.residual = static_cast<double>(counts["recognise.largest-residual"]) * 1e-6;
  return out;
}

}  // namespace wrlkit
