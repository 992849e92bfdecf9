#include "geometry/text.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "base/text/utf8.h"
#include "geometry/fallback_fonts.h"
#include "geometry/geometry_attributes.h"
#include "scenegraph/nodes.h"

namespace wrlkit {
namespace {

constexpr std::size_t most_characters = 100'000;

enum class Justify : std::uint8_t { first, begin, middle, end };

struct Style {
  double size = 1, spacing = 1;
  Justify major = Justify::begin, minor = Justify::first;
  bool horizontal = true, left_to_right = true, top_to_bottom = true;
  FontFamily family = FontFamily::serif;
  bool bold = false, italic = false;

  // Major: along a string. Minor: from string to string. Which way the coordinate changes.
  double major_way() const { return horizontal ? (left_to_right ? 1 : -1) : (top_to_bottom ? -1 : 1); }
  double minor_way() const { return horizontal ? (top_to_bottom ? -1 : 1) : (left_to_right ? 1 : -1); }
};

std::string upper(std::string_view s) {
  std::string out(s);
  for (auto& c : out)
    if (c >= 'a' && c <= 'z') c = static_cast<char>(c - 'a' + 'A');
  return out;
}

Justify read_justify(std::string_view word, Justify otherwise) {
  if (word == "FIRST") return Justify::first;
  if (word == "BEGIN") return Justify::begin;
  if (word == "MIDDLE") return Justify::middle;
  if (word == "END") return Justify::end;
  return otherwise;
}

/// The first family of the list that is known: the three of the standard, and names that browsers take for one of them.
FontFamily read_family(std::span<const std::string_view> list) {
  static constexpr struct {
    const char* part;
    FontFamily family;
  } names[] = {
      {"TYPEWRITER", FontFamily::typewriter},
      {"COURIER", FontFamily::typewriter},
      {"MONO", FontFamily::typewriter},
      {"SANS", FontFamily::sans},
      {"ARIAL", FontFamily::sans},
      {"HELVETICA", FontFamily::sans},
      {"VERDANA", FontFamily::sans},
      {"SERIF", FontFamily::serif},
      {"TIMES", FontFamily::serif},
  };
  for (auto name : list) {
    if (name.empty()) break;  // the same as SERIF
    for (auto& n : names)
      if (upper(name).find(n.part) != std::string::npos) return n.family;
  }
  return FontFamily::serif;
}

double not_negative(double v, double otherwise) { return std::isfinite(v) ? std::abs(v) : otherwise; }

Style read_style(const Scene& scene, NodeId text) {
  Style out;
  NodeId n = scene.get(text, nodes::text::fontStyle);
  if (!scene.is(n, nodes::FontStyle)) return out;
  namespace fields = nodes::font_style;
  out.size = not_negative(scene.get(n, fields::size), 0);
  out.spacing = not_negative(scene.get(n, fields::spacing), 1);
  auto justify = scene.get(n, fields::justify);
  if (justify.size() > 0) out.major = read_justify(justify[0], out.major);
  if (justify.size() > 1) out.minor = read_justify(justify[1], out.minor);
  out.horizontal = scene.get(n, fields::horizontal);
  out.left_to_right = scene.get(n, fields::leftToRight);
  out.top_to_bottom = scene.get(n, fields::topToBottom);
  out.family = read_family(scene.get(n, fields::family));
  auto style = upper(scene.get(n, fields::style));
  out.bold = style.find("BOLD") != std::string::npos;
  out.italic = style.find("ITALIC") != std::string::npos;
  return out;
}

/// Takes one character off UTF-8 text. A byte that begins none is U+FFFD.
char32_t take_character(std::string_view& s) {
  const auto n = utf8_sequence(s);
  const auto first = static_cast<unsigned char>(s[0]);
  char32_t c = n == 0 ? 0xfffd : n == 1 ? first : first & (0x7fu >> n);
  for (std::size_t i = 1; i < n; ++i) c = c << 6 | (static_cast<unsigned char>(s[i]) & 0x3fu);
  s.remove_prefix(std::max<std::size_t>(n, 1));
  return c;
}

bool is_control(char32_t c) { return c < 0x20 || (c >= 0x7f && c < 0xa0); }

/// Joiners and marks of direction, which say how others are shown.
bool is_invisible(char32_t c) {
  return (c >= 0x200b && c <= 0x200f) || (c >= 0x202a && c <= 0x202e) || (c >= 0x2060 && c <= 0x2069) || c == 0xfeff;
}

class TextMaker {
 public:
  TextMaker(MeshJob& job, Fonts& fonts) : job_(job), fonts_(fonts), style_(read_style(job.scene, job.geometry)) {}

  void make() {
    start_mesh();
    if (!(style_.size > 0))
      return job_.ctx.diag.report(Diag::degenerate_geometry, where(), title(job_), "the size of its font is 0");
    auto strings = job_.scene.get(job_.geometry, nodes::text::string);
    if (std::ranges::all_of(strings, &std::string_view::empty)) return;
    if (!find_fonts()) return;
    for (auto s : strings) add_line(s);
    if (cut_off_) job_.ctx.diag.report(Diag::expansion_limit, where(), most_characters, "characters in one Text node");
    report_missing();
    set_lengths();
    place();
  }

 private:
  struct Line {
    std::size_t first, last;  // into glyphs_
    double length, scale;
  };
  struct Box {
    double left, bottom, x_scale, y_scale;
  };

  Span where() const { return job_.scene.where(job_.geometry); }
  void start_mesh();
  bool find_fonts();
  Font* font_of(char32_t);
  void report_missing();
  void add_line(std::string_view);
  void add_letters();
  void add_letter(const Glyph&);
  void add_shaped();
  void add_run(Font&, const TextRun&);
  void add_clusters(Font&, const TextRun&);
  double advance(const PlacedGlyph& g) const { return g.advance * style_.size; }
  void set_lengths();
  double major_start(const Line&) const;
  double minor_start() const;
  void place();
  void place(const Line&, double minor);
  void add(const Glyph&, const Box&);

  MeshJob& job_;
  Fonts& fonts_;
  Style style_;
  Font *font_ = nullptr, *second_ = nullptr;
  std::vector<PlacedGlyph> glyphs_;
  std::u32string letters_;  // of the line at hand
  std::vector<Line> lines_;
  bool cut_off_ = false;
  std::size_t n_missing_ = 0;
  char32_t first_missing_ = 0, first_unshaped_ = 0;
  Vec2 origin_{};  // of the texture
};

void TextMaker::start_mesh() {
  Mesh& mesh = job_.mesh;
  mesh.clear();
  mesh.kind = Mesh::Kind::faces;
  mesh.primitive = true;
  mesh.solid = false;
}

bool TextMaker::find_fonts() {
  font_ = fonts_.find(style_.family, style_.bold, style_.italic);
  second_ = fonts_.find(FontFamily::sans, style_.bold, style_.italic);
  if (font_) return true;
  static constexpr const char* names[] = {"SERIF", "SANS", "TYPEWRITER"};
  job_.ctx.diag.report(Diag::no_font, where(), names[static_cast<std::size_t>(style_.family)],
                       "neither the DejaVu nor the Liberation fonts are installed; WRLKIT_FONTS may name folders");
  return false;
}

// -- strings

/// Null when no font has it, which is noted.
Font* TextMaker::font_of(char32_t c) {
  for (Font* font : {font_, second_})
    if (font->glyph(c)) return font;
  if (Font* font = fonts_.find_for(c)) return font;
  if (n_missing_++ == 0) first_missing_ = c;
  return nullptr;
}

void TextMaker::report_missing() {
  if (first_unshaped_) {
    const auto [names, packages] = missing_for_shaping();
    job_.ctx.diag.report(Diag::text_not_shaped, where(), title(job_),
                         fmt::format("{:04X}", static_cast<std::uint32_t>(first_unshaped_)), names, packages);
  }
  if (!n_missing_) return;
  auto first = fmt::format("{:04X}", static_cast<std::uint32_t>(first_missing_));
  if (const auto* known = fallback_fonts(first_missing_))
    first += fmt::format(" (the Debian package {} has one)", known->package);
  job_.ctx.diag.report(Diag::missing_glyph, where(), title(job_), n_missing_, first);
}

void TextMaker::add_line(std::string_view s) {
  letters_.clear();
  while (!s.empty() && !cut_off_) {
    char32_t c = take_character(s);
    if (c == '\t') c = ' ';
    if (is_control(c)) continue;
    cut_off_ = glyphs_.size() + letters_.size() >= most_characters;
    if (!cut_off_) letters_.push_back(c);
  }
  Line line{glyphs_.size(), glyphs_.size(), 0, 1};
  const auto special = std::ranges::find_if(letters_, needs_shaping);
  const bool shapes = special != letters_.end() && can_shape();
  if (special != letters_.end() && !shapes && !first_unshaped_) first_unshaped_ = *special;
  shapes ? add_shaped() : add_letters();
  line.last = glyphs_.size();
  for (auto i = line.first; i < line.last; ++i) line.length += advance(glyphs_[i]);
  lines_.push_back(line);
}

void TextMaker::add_letters() {
  for (const char32_t c : letters_) {
    if (is_invisible(c)) continue;
    Font* const font = font_of(c);
    add_letter(font ? *font->glyph(c) : font_->missing());
  }
}

/// Behind the one before, or in a column below or above it, in the middle.
void TextMaker::add_letter(const Glyph& g) {
  if (style_.horizontal)
    glyphs_.push_back({&g, g.advance});
  else
    glyphs_.push_back({&g, 1, (1 - g.advance) / 2});
}

/// Glyphs of a line with letters that join or run from right to left, in the order in which they stand along the line;
/// in a column in the order in which they are read.
void TextMaker::add_shaped() {
  const auto scripts = scripts_of(letters_);
  std::vector<Font*> fonts;
  std::vector<std::uint32_t> kinds;  // numbers that change with the font and the script
  for (std::size_t i = 0; i < letters_.size(); ++i) {
    const bool same_script = i > 0 && scripts[i] == scripts[i - 1];
    // A mark or joiner stays with its letter, and a blank with its word, where their font has it.
    const bool stays = same_script && fonts.back() && fonts.back()->glyph(letters_[i]);
    if (is_invisible(letters_[i]))
      fonts.push_back(i > 0 ? fonts.back() : font_);
    else
      fonts.push_back(stays ? fonts.back() : font_of(letters_[i]));
    const bool same = same_script && fonts[i] == fonts[i - 1];
    kinds.push_back(kinds.empty() ? 0 : kinds.back() + (same ? 0 : 1));
  }
  const auto first = glyphs_.size();
  const auto direction = style_.left_to_right ? std::optional<bool>() : true;
  auto runs = visual_runs(letters_, kinds, direction);
  if (!style_.horizontal) std::ranges::sort(runs, {}, &TextRun::begin);
  for (const TextRun& run : runs) {
    if (Font* const font = fonts[run.begin])
      style_.horizontal ? add_run(*font, run) : add_clusters(*font, run);
    else
      for (auto i = run.begin; i < run.end; ++i) add_letter(font_->missing());
  }
  if (style_.horizontal && !style_.left_to_right)
    std::reverse(glyphs_.begin() + static_cast<std::ptrdiff_t>(first), glyphs_.end());
}

void TextMaker::add_run(Font& font, const TextRun& run) {
  const auto text = std::u32string_view(letters_).substr(run.begin, run.end - run.begin);
  const auto shaped = font.shape(text, run.right_to_left);
  glyphs_.insert(glyphs_.end(), shaped.begin(), shaped.end());
}

/// Each cluster of a column has the place of one letter; letters that would join stand alone.
void TextMaker::add_clusters(Font& font, const TextRun& run) {
  const auto text = std::u32string_view(letters_).substr(run.begin, run.end - run.begin);
  auto begins = font.clusters(text, run.right_to_left);
  begins.push_back(text.size());
  for (std::size_t i = 0; i + 1 < begins.size(); ++i) {
    const auto shaped = font.shape(text.substr(begins[i], begins[i + 1] - begins[i]), run.right_to_left);
    double width = 0;
    for (const PlacedGlyph& g : shaped) width += g.advance;
    double left = (1 - width) / 2;
    const std::size_t steps = style_.top_to_bottom ? 0 : shaped.size() - 1;  // the glyph that the pen moves by
    for (std::size_t k = 0; k < shaped.size(); ++k) {
      glyphs_.push_back({shaped[k].glyph, k == steps ? 1.0 : 0.0, left + shaped[k].dx, shaped[k].dy});
      left += shaped[k].advance;
    }
  }
}

/// The lengths that the node asks for: `length` of each string, then maxExtent of the longest.
void TextMaker::set_lengths() {
  auto stretch = [](Line& line, double by) {
    line.length *= by;
    line.scale *= by;
  };
  auto lengths = job_.scene.get(job_.geometry, nodes::text::length);
  double longest = 0;
  for (std::size_t i = 0; i < lines_.size(); ++i) {
    Line& line = lines_[i];
    if (i < lengths.size() && lengths[i] > 0 && std::isfinite(lengths[i]) && line.length > 0)
      stretch(line, lengths[i] / line.length);
    longest = std::max(longest, line.length);
  }
  double extent = job_.scene.get(job_.geometry, nodes::text::maxExtent);
  if (extent > 0 && longest > extent)
    for (auto& line : lines_) stretch(line, extent / longest);
}

// -- layout

/// Where the string begins, so that it is justified at 0.
double TextMaker::major_start(const Line& line) const {
  double before = style_.major == Justify::middle ? line.length / 2 : style_.major == Justify::end ? line.length : 0;
  return -style_.major_way() * before;
}

/// Where the first line is, so that all are justified at 0: its baseline, or the left side of its column.
double TextMaker::minor_start() const {
  if (style_.horizontal && style_.minor == Justify::first) return 0;
  double way = style_.minor_way(), up = font_->ascent() * style_.size;
  double low = style_.horizontal ? up - style_.size : 0, high = low + style_.size;
  double begin = -(way < 0 ? high : low);
  double end = -(way < 0 ? low : high) - way * style_.spacing * style_.size * static_cast<double>(lines_.size() - 1);
  if (style_.minor == Justify::middle) return (begin + end) / 2;
  return style_.minor == Justify::end ? end : begin;
}

void TextMaker::place() {
  double minor = minor_start(), major = major_start(lines_[0]);
  origin_ = style_.horizontal ? Vec2{major, minor} : Vec2{minor, major};
  job_.mesh.normal.values = {0, 0, 1};
  for (auto& line : lines_) {
    place(line, minor);
    minor += style_.minor_way() * style_.spacing * style_.size;
  }
  job_.mesh.normal.index.assign(job_.mesh.corners.size(), 0);
  job_.mesh.texcoord.index = job_.mesh.corners;
}

void TextMaker::place(const Line& line, double minor) {
  double size = style_.size, stretched = size * line.scale, pen = major_start(line), way = style_.major_way();
  for (auto i = line.first; i < line.last; ++i) {
    const PlacedGlyph& placed = glyphs_[i];
    const Glyph& g = *placed.glyph;
    double step = advance(placed) * line.scale, low = way > 0 ? pen : pen - step;
    if (style_.horizontal && placed.dx == 0 && placed.dy == 0)
      add(g, {low, minor, stretched, size});
    else if (style_.horizontal)
      add(g, {low + placed.dx * stretched, minor + placed.dy * size, stretched, size});
    else
      add(g, {minor + placed.dx * size, low + (1 - font_->ascent() + placed.dy) * stretched, size, stretched});
    pen += way * step;
  }
}

void TextMaker::add(const Glyph& g, const Box& box) {
  Mesh& mesh = job_.mesh;
  auto& positions = mesh.positions.edit();
  auto first = static_cast<std::uint32_t>(positions.size() / 3);
  for (auto [x, y] : g.points) {
    double px = box.left + box.x_scale * x, py = box.bottom + box.y_scale * y;
    positions.insert(positions.end(), {px, py, 0});
    mesh.texcoord.values.push_back(static_cast<float>((px - origin_[0]) / style_.size));
    mesh.texcoord.values.push_back(static_cast<float>((py - origin_[1]) / style_.size));
  }
  for (auto c : g.triangles) mesh.corners.push_back(first + c);
}

}  // namespace

void text_mesh(MeshJob& job) { text_mesh(job, Fonts::installed()); }

void text_mesh(MeshJob& job, Fonts& fonts) { TextMaker(job, fonts).make(); }

}  // namespace wrlkit
