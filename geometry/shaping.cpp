#include "geometry/shaping.h"

#include <algorithm>
#include <span>

#ifdef WRLKIT_SHAPING
#include <fribidi.h>
#include <hb.h>

#include "base/lazy_library.h"
#endif

namespace wrlkit {

bool needs_shaping(char32_t c) {
  // Hebrew to NKo and Arabic Extended, the scripts of India to Myanmar, Mongolian and Khmer, joiners and marks of
  // direction, presentation forms of Hebrew and Arabic, and right-to-left scripts beyond 16 bits.
  struct Range {
    char32_t first, last;
  };
  static constexpr Range ranges[] = {{0x0590, 0x109f},   {0x1780, 0x18af},   {0x1b00, 0x1c4f},  {0x200c, 0x200f},
                                     {0x202a, 0x202e},   {0x2066, 0x2069},   {0xfb1d, 0xfdff},  {0xfe70, 0xfefc},
                                     {0x10800, 0x10fff}, {0x11000, 0x11fff}, {0x1e800, 0x1efff}};
  return std::ranges::any_of(ranges, [c](const Range& r) { return c >= r.first && c <= r.last; });
}

#ifdef WRLKIT_SHAPING

namespace {

struct Functions {
#define HARFBUZZ(function) decltype(&::function) function = nullptr;
#define BIDI(function) decltype(&::function) function = nullptr;
#include "geometry/shaping_functions.def"
#undef HARFBUZZ
#undef BIDI
  bool has_harfbuzz = false, has_fribidi = false;
};

Functions open_libraries() {
  Functions out;
  LazyLibrary harfbuzz("libharfbuzz.so.0"), fribidi("libfribidi.so.0");
#define HARFBUZZ(function) harfbuzz.find(out.function, #function);
#define BIDI(function) fribidi.find(out.function, #function);
#include "geometry/shaping_functions.def"
#undef HARFBUZZ
#undef BIDI
  out.has_harfbuzz = harfbuzz.fault().empty();
  out.has_fribidi = fribidi.fault().empty();
  return out;
}

const Functions& lib() {
  static const Functions functions = open_libraries();
  return functions;
}

/// Embedding levels, of which odd ones run from right to left.
std::vector<FriBidiLevel> levels_of(std::u32string_view line, std::optional<bool> right_to_left) {
  const std::vector<FriBidiChar> text(line.begin(), line.end());
  std::vector<FriBidiLevel> levels(text.size(), 0);
  FriBidiParType base = !right_to_left ? FRIBIDI_PAR_ON : *right_to_left ? FRIBIDI_PAR_RTL : FRIBIDI_PAR_LTR;
  if (!lib().fribidi_log2vis(text.data(), static_cast<FriBidiStrIndex>(text.size()), &base, nullptr, nullptr, nullptr,
                             levels.data()))
    std::ranges::fill(levels, FriBidiLevel{0});
  return levels;
}

/// Whether a run ends behind that letter because of its length: HarfBuzz takes quadratic time for marks on one letter.
bool is_too_long(std::size_t length, char32_t last) {
  constexpr std::size_t long_enough = 256, longest = 1024;
  return length >= longest || (length >= long_enough && last == ' ');
}

}  // namespace

bool can_shape() { return lib().has_harfbuzz && lib().has_fribidi; }

MissingLibraries missing_for_shaping() {
  if (can_shape()) return {};
  if (lib().has_harfbuzz) return {"FriBidi", "libfribidi0"};
  if (lib().has_fribidi) return {"HarfBuzz", "libharfbuzz0b"};
  return {"HarfBuzz and FriBidi", "libharfbuzz0b and libfribidi0"};
}

std::vector<std::uint32_t> scripts_of(std::u32string_view line) {
  std::vector<std::uint32_t> out;
  auto* const unicode = lib().hb_unicode_funcs_get_default();
  std::uint32_t before = HB_SCRIPT_COMMON;
  for (const char32_t c : line) {
    const std::uint32_t script = lib().hb_unicode_script(unicode, c);
    const bool has_none = script == HB_SCRIPT_COMMON || script == HB_SCRIPT_INHERITED || script == HB_SCRIPT_UNKNOWN;
    out.push_back(has_none ? before : before = script);
  }
  return out;
}

std::vector<TextRun> visual_runs(std::u32string_view line, const std::vector<std::uint32_t>& kinds,
                                 std::optional<bool> right_to_left) {
  const auto levels = levels_of(line, right_to_left);
  std::vector<TextRun> runs;
  std::vector<FriBidiLevel> of_run;
  for (std::size_t i = 0; i < line.size(); ++i) {
    const bool goes_on = i > 0 && levels[i] == levels[i - 1] && kinds[i] == kinds[i - 1] &&
                         !is_too_long(i - runs.back().begin, line[i - 1]);
    if (!goes_on) {
      runs.push_back({i, i, levels[i] % 2 != 0});
      of_run.push_back(levels[i]);
    }
    runs.back().end = i + 1;
  }
  // Rule L2: from the highest level to the lowest odd one, what is at that level or above is turned round.
  const FriBidiLevel highest = of_run.empty() ? FriBidiLevel{0} : *std::ranges::max_element(of_run);
  for (FriBidiLevel level = highest; level > 0; --level)
    for (std::size_t first = 0; first < runs.size();) {
      std::size_t last = first;
      while (last < runs.size() && of_run[last] >= level) ++last;
      std::reverse(runs.begin() + static_cast<std::ptrdiff_t>(first), runs.begin() + static_cast<std::ptrdiff_t>(last));
      std::reverse(of_run.begin() + static_cast<std::ptrdiff_t>(first),
                   of_run.begin() + static_cast<std::ptrdiff_t>(last));
      first = last + 1;
    }
  return runs;
}

struct ShapingFont::Handles {
  hb_face_t* face = nullptr;
  hb_font_t* font = nullptr;
};

ShapingFont::ShapingFont(const std::string& path) : handles_(std::make_unique<Handles>()) {
  hb_blob_t* const blob = lib().hb_blob_create_from_file(path.c_str());  // empty when it cannot be read
  handles_->face = lib().hb_face_create(blob, 0);
  handles_->font = lib().hb_font_create(handles_->face);
  lib().hb_blob_destroy(blob);
}

ShapingFont::~ShapingFont() {
  lib().hb_font_destroy(handles_->font);
  lib().hb_face_destroy(handles_->face);
}

namespace {

/// A run that HarfBuzz has shaped.
class ShapedRun {
 public:
  ShapedRun(hb_font_t* font, std::u32string_view run, bool right_to_left) : buffer_(lib().hb_buffer_create()) {
    const std::vector<std::uint32_t> text(run.begin(), run.end());
    const int length = static_cast<int>(text.size());
    lib().hb_buffer_add_utf32(buffer_, text.data(), length, 0, length);
    lib().hb_buffer_set_direction(buffer_, right_to_left ? HB_DIRECTION_RTL : HB_DIRECTION_LTR);
    lib().hb_buffer_set_language(buffer_, lib().hb_language_from_string("und", -1));  // else that of the user's locale
    lib().hb_buffer_guess_segment_properties(buffer_);
    lib().hb_shape(font, buffer_, nullptr, 0);
  }
  ~ShapedRun() { lib().hb_buffer_destroy(buffer_); }
  ShapedRun(const ShapedRun&) = delete;
  ShapedRun& operator=(const ShapedRun&) = delete;

  std::span<const hb_glyph_info_t> glyphs() const {
    unsigned n = 0;
    const hb_glyph_info_t* const first = lib().hb_buffer_get_glyph_infos(buffer_, &n);
    return {first, n};
  }
  const hb_glyph_position_t* places() const { return lib().hb_buffer_get_glyph_positions(buffer_, nullptr); }

 private:
  hb_buffer_t* buffer_;
};

}  // namespace

std::vector<std::size_t> ShapingFont::clusters(std::u32string_view run, bool right_to_left) const {
  const ShapedRun shaped(handles_->font, run, right_to_left);
  std::vector<std::size_t> begins;
  for (const hb_glyph_info_t& glyph : shaped.glyphs()) begins.push_back(glyph.cluster);
  std::ranges::sort(begins);
  begins.erase(std::unique(begins.begin(), begins.end()), begins.end());
  return begins;
}

std::vector<ShapedGlyph> ShapingFont::shape(std::u32string_view run, bool right_to_left) const {
  const ShapedRun shaped(handles_->font, run, right_to_left);
  const double em = std::max(1u, lib().hb_face_get_upem(handles_->face));
  std::vector<ShapedGlyph> out;
  const hb_glyph_position_t* place = shaped.places();
  for (const hb_glyph_info_t& glyph : shaped.glyphs()) {
    out.push_back({glyph.codepoint, place->x_advance / em, place->x_offset / em, place->y_offset / em});
    ++place;
  }
  return out;
}

#else

bool can_shape() { return false; }
MissingLibraries missing_for_shaping() {
  return {"HarfBuzz and FriBidi, which this build leaves out", "libharfbuzz-dev, libfribidi-dev for a build"};
}
std::vector<std::uint32_t> scripts_of(std::u32string_view line) { return std::vector<std::uint32_t>(line.size(), 0); }
std::vector<TextRun> visual_runs(std::u32string_view line, const std::vector<std::uint32_t>&, std::optional<bool>) {
  return {{0, line.size(), false}};
}

struct ShapingFont::Handles {};
ShapingFont::ShapingFont(const std::string&) {}
ShapingFont::~ShapingFont() = default;
std::vector<std::size_t> ShapingFont::clusters(std::u32string_view, bool) const { return {}; }
std::vector<ShapedGlyph> ShapingFont::shape(std::u32string_view, bool) const { return {}; }

#endif

}  // namespace wrlkit
