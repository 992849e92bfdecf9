// Text as faces (ISO/IEC 14772-1, 6.47 and 6.20).
#pragma once
#include "geometry/fonts.h"
#include "geometry/mesh_job.h"

namespace wrlkit {

/// Makes job.mesh of a Text node: triangles in the plane z = 0 that face +Z, seen from both sides (solid is false),
/// with the texture coordinates of the standard: (0, 0) at the origin of the first string, one unit for the size of the
/// font.
///
/// Where the standard leaves the layout open:
/// - The em of the font is `size` high. So is the box of a line, which the font's ascent and descent divide above and
///   below the baseline; it is what justify aligns. Lines with spacing 1 are stacked without a gap.
/// - Vertical strings give every character a box of size * size, one below the other, and centre it in that.
/// - `length` and `maxExtent` scale the characters along the string, `length` first. Blanks count.
/// - Lines with letters that join or run from right to left (Arabic, Hebrew, Devanagari, ...) are shaped, and ordered
/// by
///   Unicode Standard Annex #9 (geometry/shaping.h), where they are horizontal; `leftToRight` FALSE makes the direction
///   of their paragraph right to left. Other lines have neither kerning nor ligatures. `language` is not used.
/// - Control characters are left out. Characters that neither the font nor the sans font has come from one for their
///   script (geometry/fallback_fonts.h), plain and upright, or else are shown as the font's box for that.
///
/// Reports no-font, degenerate-geometry for a size of 0, and expansion-limit above 100,000 characters; the mesh is then
/// of kind `faces` without faces, or has the first 100,000.
void text_mesh(MeshJob& job);
void text_mesh(MeshJob& job, Fonts& fonts);

}  // namespace wrlkit
