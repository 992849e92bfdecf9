// The modes of a MultiTexture (ISO/IEC 19775-1, table 18.3) on two colours.
#pragma once
#include <array>
#include <string_view>

namespace wrlkit::x3d {

using Rgba = std::array<double, 4>;  // display-referred, in [0, 1]

/// What is known of the light in a colour: that it is still to be multiplied by it (`lit`), or that it has taken the
/// place of the lit colour.
struct Blended {
  Rgba value{1, 1, 1, 1};
  bool lit = true;
  bool exact = true;  // false: light multiplies what it would only be added to
};

/// How one picture is laid over what is below it, made of the texts of `mode`, `source` and `function`.
class TextureBlend {
 public:
  /// Texts in capitals or not. Words that are not known: the default, MODULATE on what is below.
  TextureBlend(std::string_view mode, std::string_view source, std::string_view function);

  /// OFF: as if the picture were not there.
  bool is_off() const { return color_ == Mode::off && alpha_ == Mode::off; }
  /// `picture` over `below`; `factor` is MultiTexture.color and alpha.
  Blended operator()(const Rgba& picture, const Blended& below, const Rgba& factor) const;

 private:
  enum class Mode : unsigned char {
    modulate,
    modulate2x,
    modulate4x,
    replace,
    select_below,
    add,
    add_signed,
    add_signed2x,
    add_smooth,
    subtract,
    by_picture_alpha,
    by_factor_alpha,
    by_below_alpha,
    alpha_add_color,
    inverse_alpha_add_color,
    inverse_color_add_alpha,
    dot_product,
    off
  };
  enum class Source : unsigned char { below, light, factor };
  enum class Function : unsigned char { none, complement, alpha_replicate };

  static Mode mode_of(std::string_view word);
  static double blend(Mode, const Rgba& picture, const Rgba& below, const Rgba& factor, std::size_t channel);
  static bool keeps_light(Mode);

  Mode color_ = Mode::modulate, alpha_ = Mode::modulate;
  Source source_ = Source::below;
  Function function_ = Function::none;
};

}  // namespace wrlkit::x3d
