// The forms of our own (scenegraph/nodes/wrlkit.nodes).
#include <algorithm>
#include <cmath>

#include "geometry/forms/form_node.h"
#include "geometry/shapes/shapes.h"

namespace wrlkit {

void make_form(MeshJob& job, const Tessellation& options) {
  const auto form = read_form(job.scene, job.geometry);
  if (!form) return report_no_surface(job, "its size is zero or not finite");
  FormCut cut;
  if (options.segments > 0)
    cut.segments = std::clamp(options.segments, 3, 1024);
  else if (options.tolerance > 0)
    cut = cut_within(*form, options.tolerance);
  else if (form->segments == 0)
    cut = cut_within(*form, 0.005 * std::sqrt(reach_of(*form)));
  tessellate_form(*form, cut, job.mesh);
}

}  // namespace wrlkit
