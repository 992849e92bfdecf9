#include "passes/lower_x3d/texture_blend.h"

#include <algorithm>

#include "base/text/letter_case.h"

namespace wrlkit::x3d {
namespace {

std::string_view bare_word(std::string_view s) {
  const auto first = s.find_first_not_of(" \t\r\n");
  if (first == s.npos) return {};
  return s.substr(first, s.find_last_not_of(" \t\r\n") - first + 1);
}

}  // namespace

/// By the alpha of the diffuse colour, which is 1 where the material is opaque, only the picture is left.
TextureBlend::Mode TextureBlend::mode_of(std::string_view word) {
  struct Row {
    std::string_view word;
    Mode mode;
  };
  static constexpr Row rows[] = {{"MODULATE", Mode::modulate},
                                 {"MODULATE2X", Mode::modulate2x},
                                 {"MODULATE4X", Mode::modulate4x},
                                 {"REPLACE", Mode::replace},
                                 {"SELECTARG1", Mode::replace},
                                 {"SELECTARG2", Mode::select_below},
                                 {"ADD", Mode::add},
                                 {"ADDSIGNED", Mode::add_signed},
                                 {"ADDSIGNED2X", Mode::add_signed2x},
                                 {"ADDSMOOTH", Mode::add_smooth},
                                 {"SUBTRACT", Mode::subtract},
                                 {"BLENDDIFFUSEALPHA", Mode::replace},
                                 {"BLENDTEXTUREALPHA", Mode::by_picture_alpha},
                                 {"BLENDFACTORALPHA", Mode::by_factor_alpha},
                                 {"BLENDCURRENTALPHA", Mode::by_below_alpha},
                                 {"MODULATEALPHA_ADDCOLOR", Mode::alpha_add_color},
                                 {"MODULATEINVALPHA_ADDCOLOR", Mode::inverse_alpha_add_color},
                                 {"MODULATEINVCOLOR_ADDALPHA", Mode::inverse_color_add_alpha},
                                 {"DOTPRODUCT3", Mode::dot_product},
                                 {"OFF", Mode::off}};
  for (const Row& row : rows)
    if (equal_ignoring_case(row.word, word)) return row.mode;
  return Mode::modulate;
}

/// "MODULATE" or, for colour and alpha, "MODULATE,REPLACE".
TextureBlend::TextureBlend(std::string_view mode, std::string_view source, std::string_view function) {
  const auto comma = mode.find_first_of(",/");
  color_ = mode_of(bare_word(mode.substr(0, comma)));
  alpha_ = comma == mode.npos ? color_ : mode_of(bare_word(mode.substr(comma + 1)));
  if (color_ == Mode::dot_product && comma == mode.npos) alpha_ = Mode::replace;
  if (equal_ignoring_case(source, "DIFFUSE") || equal_ignoring_case(source, "SPECULAR")) source_ = Source::light;
  if (equal_ignoring_case(source, "FACTOR")) source_ = Source::factor;
  if (equal_ignoring_case(function, "COMPLEMENT")) function_ = Function::complement;
  if (equal_ignoring_case(function, "ALPHAREPLICATE")) function_ = Function::alpha_replicate;
}

double TextureBlend::blend(Mode mode, const Rgba& picture, const Rgba& below, const Rgba& factor, std::size_t i) {
  const double a = picture[i], b = below[i];
  const auto mix = [&](double share) { return a * share + b * (1 - share); };
  switch (mode) {
    case Mode::modulate:
      return a * b;
    case Mode::modulate2x:
      return 2 * a * b;
    case Mode::modulate4x:
      return 4 * a * b;
    case Mode::replace:
      return a;
    case Mode::select_below:
    case Mode::off:
      return b;
    case Mode::add:
      return a + b;
    case Mode::add_signed:
      return a + b - 0.5;
    case Mode::add_signed2x:
      return 2 * (a + b - 0.5);
    case Mode::add_smooth:
      return a + b - a * b;
    case Mode::subtract:
      return a - b;
    case Mode::by_picture_alpha:
      return mix(picture[3]);
    case Mode::by_factor_alpha:
      return mix(factor[3]);
    case Mode::by_below_alpha:
      return mix(below[3]);
    case Mode::alpha_add_color:
      return a + picture[3] * b;
    case Mode::inverse_alpha_add_color:
      return (1 - picture[3]) * b + a;
    case Mode::inverse_color_add_alpha:
      return (1 - a) * b + picture[3];
    case Mode::dot_product: {
      double sum = 0;
      for (std::size_t k = 0; k < 3; ++k) sum += 4 * (picture[k] - 0.5) * (below[k] - 0.5);
      return sum;
    }
  }
  return b;
}

/// Whether light that multiplies what is below multiplies the result.
bool TextureBlend::keeps_light(Mode m) {
  return m == Mode::modulate || m == Mode::modulate2x || m == Mode::modulate4x || m == Mode::select_below ||
         m == Mode::off;
}

Blended TextureBlend::operator()(const Rgba& picture, const Blended& below, const Rgba& factor) const {
  if (is_off()) return below;
  Blended out = source_ == Source::below ? below
                                         : Blended{source_ == Source::factor ? factor : Rgba{1, 1, 1, 1},
                                                   source_ == Source::light, below.exact};
  const Rgba under = out.value;
  for (std::size_t i = 0; i < 4; ++i)
    out.value[i] = std::clamp(blend(i < 3 ? color_ : alpha_, picture, under, factor, i), 0.0, 1.0);
  if (color_ == Mode::replace)
    out.lit = false;
  else if (out.lit && !keeps_light(color_))
    out.exact = false;
  if (function_ == Function::alpha_replicate) out.value = {out.value[3], out.value[3], out.value[3], out.value[3]};
  if (function_ != Function::complement) return out;
  for (double& v : out.value) v = 1 - v;
  out.exact &= !out.lit;
  return out;
}

}  // namespace wrlkit::x3d
