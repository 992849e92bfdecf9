// Text: the layout against the tables of ISO/IEC 14772-1, 6.20, the glyphs against what is known of their shapes. Needs
// the DejaVu fonts, whose typewriter font has one advance for all characters.
#include "geometry/text.h"

#include <catch2/catch.hpp>
#include <random>
#include <thread>

#include "passes/triangulate/triangulate.h"
#include "scenegraph/nodes.h"
#include "tests/unit/flat_fixture.h"
#include "tests/unit/temp_folder.h"

using namespace wrlkit;
using namespace wrlkit::flat_tests;

namespace {

struct Job {
  Scene scene;
  NodeId text = scene.add(nodes::Text), style = scene.add(nodes::FontStyle);
  Mesh mesh;
  MeshScratch scratch;
  Diagnostics diag;
  Statistics stats;
  PassContext ctx{diag, stats};

  Job() { scene.set(text, nodes::text::fontStyle, style); }

  void strings(const std::vector<std::string_view>& s) { scene.set(text, nodes::text::string, s); }
  const Mesh& make() { return make(Fonts::installed()); }
  const Mesh& make(Fonts& fonts) {
    MeshJob job{scene, text, mesh, scratch, ctx};
    text_mesh(job, fonts);
    return mesh;
  }
};

struct Bounds {
  double left = 1e300, right = -1e300, bottom = 1e300, top = -1e300;
  void add(double x, double y) {
    left = std::min(left, x);
    right = std::max(right, x);
    bottom = std::min(bottom, y);
    top = std::max(top, y);
  }
};

Bounds bounds(const Mesh& mesh) {
  Bounds b;
  for (auto c : mesh.corners) b.add(mesh.positions[3 * c], mesh.positions[3 * c + 1]);
  return b;
}

Bounds bounds(const Glyph& glyph) {
  Bounds b;
  for (auto [x, y] : glyph.points) b.add(x, y);
  return b;
}

void check_bounds(const Bounds& b, double left, double right, double bottom, double top) {
  CHECK(b.left == Approx(left).margin(1e-9));
  CHECK(b.right == Approx(right).margin(1e-9));
  CHECK(b.bottom == Approx(bottom).margin(1e-9));
  CHECK(b.top == Approx(top).margin(1e-9));
}

Flat flat(const Mesh& mesh) {
  Flat out;
  for (std::size_t i = 0; i < mesh.n_positions(); ++i)
    out.points.push_back({mesh.positions[3 * i], mesh.positions[3 * i + 1]});
  out.triangles = mesh.corners;
  return out;
}

}  // namespace

TEST_CASE("justify, in every direction", "[text]") {
  Job job;
  job.strings({"HHH", "H"});
  auto* font = Fonts::installed().find(FontFamily::typewriter, false, false);
  REQUIRE(font);
  const Glyph& h = *font->glyph('H');
  const Bounds ink = bounds(h);
  const double size = 2, spacing = 1.5, step = size * spacing, up = font->ascent() * size, down = size - up;
  namespace fields = nodes::font_style;
  job.scene.set(job.style, fields::family, std::vector<std::string_view>{"TYPEWRITER"});
  job.scene.set(job.style, fields::size, size);
  job.scene.set(job.style, fields::spacing, spacing);
  const char* words[] = {"FIRST", "BEGIN", "MIDDLE", "END"};
  for (int bits = 0; bits < 8; ++bits)
    for (int major = 0; major < 4; ++major)
      for (int minor = 0; minor < 4; ++minor) {
        bool horizontal = bits & 1, right = bits & 2, down_page = bits & 4;
        CAPTURE(horizontal, right, down_page, words[major], words[minor]);
        job.scene.set(job.style, fields::horizontal, horizontal);
        job.scene.set(job.style, fields::leftToRight, right);
        job.scene.set(job.style, fields::topToBottom, down_page);
        job.scene.set(job.style, fields::justify, std::vector<std::string_view>{words[major], words[minor]});
        auto b = bounds(job.make());
        if (horizontal) {
          // Table 6.3 and 6.4: each string for itself, then all of them.
          auto left_of = [&](double length) { return major == 2 ? -length / 2 : (major == 3) == right ? -length : 0; };
          double l3 = left_of(3 * h.advance * size), l1 = left_of(h.advance * size);
          double top = 0;  // of all lines
          if (minor == 0) top = down_page ? up : up + step;
          if (minor == 1) top = down_page ? 0 : size + step;
          if (minor == 2) top = (size + step) / 2;
          if (minor == 3) top = down_page ? size + step : 0;
          double upper = top - up, lower = upper - step;  // baselines
          check_bounds(b, std::min(l3, l1) + ink.left * size,
                       std::max(l3 + 3 * h.advance * size, l1 + h.advance * size) - (h.advance - ink.right) * size,
                       lower + ink.bottom * size, upper + ink.top * size);
        } else {
          auto top_of = [&](double length) { return major == 2 ? length / 2 : (major == 3) == down_page ? length : 0; };
          double t3 = top_of(3 * size), t1 = top_of(size), left = 0;  // of all columns
          if (minor <= 1) left = right ? 0 : -size - step;
          if (minor == 2) left = -(size + step) / 2;
          if (minor == 3) left = right ? -size - step : 0;
          double centre = (size - h.advance * size) / 2;
          check_bounds(b, left + centre + ink.left * size, left + step + size - centre - (h.advance - ink.right) * size,
                       std::min(t3 - 3 * size, t1 - size) + down + ink.bottom * size,
                       std::max(t3, t1) - up + ink.top * size);
        }
      }
  CHECK(job.diag.messages().empty());
}

TEST_CASE("text without a FontStyle has the default one", "[text]") {
  Job with, without;
  with.strings({"Agfa", "  x"});
  without.strings({"Agfa", "  x"});
  without.scene.set(without.text, nodes::text::fontStyle, NodeId{});
  with.make();
  without.make();
  REQUIRE(with.mesh.corners.size() > 100);
  CHECK(std::ranges::equal(with.mesh.positions.span(), without.mesh.positions.span()));
  CHECK(with.mesh.corners == without.mesh.corners);
  auto b = bounds(with.mesh);
  CHECK(b.left > -0.05);
  CHECK(b.top > 0.6);
  CHECK(b.top < 0.9);
  CHECK(b.bottom == Approx(-1).margin(0.03));
}

TEST_CASE("letters run the way the text does", "[text]") {
  Job job;
  job.strings({"L."});
  job.scene.set(job.style, nodes::font_style::family, std::vector<std::string_view>{"TYPEWRITER"});
  auto dot_is = [&](bool horizontal, bool right, bool down) {
    job.scene.set(job.style, nodes::font_style::horizontal, horizontal);
    job.scene.set(job.style, nodes::font_style::leftToRight, right);
    job.scene.set(job.style, nodes::font_style::topToBottom, down);
    auto f = flat(job.make());
    Bounds l, dot;
    auto n = Fonts::installed().find(FontFamily::typewriter, false, false)->glyph('L')->points.size();
    for (std::size_t i = 0; i < f.points.size(); ++i) (i < n ? l : dot).add(f.points[i][0], f.points[i][1]);
    return horizontal           ? dot.left > l.right - 1e-9 ? "right"
                                  : dot.right < l.left      ? "left"
                                                            : "in"
           : dot.bottom > l.top ? "above"
           : dot.top < l.bottom ? "below"
                                : "in";
  };
  CHECK(dot_is(true, true, true) == std::string("right"));
  CHECK(dot_is(true, false, true) == std::string("left"));
  CHECK(dot_is(false, true, true) == std::string("below"));
  CHECK(dot_is(false, true, false) == std::string("above"));
}

TEST_CASE("length and maxExtent", "[text]") {
  Job job;
  job.strings({"HHHH", "HH", "", "H"});
  auto* font = Fonts::installed().find(FontFamily::typewriter, false, false);
  const Glyph& h = *font->glyph('H');
  const Bounds ink = bounds(h);
  namespace fields = nodes::font_style;
  job.scene.set(job.style, fields::family, std::vector<std::string_view>{"TYPEWRITER"});
  auto width_is = [&](double scale, double characters) {
    auto b = bounds(job.make());
    CHECK(b.right == Approx(scale * ((characters - 1) * h.advance + ink.right)));
    CHECK(b.top == Approx(ink.top));
    CHECK(b.bottom == Approx(ink.bottom - 3));
  };
  width_is(1, 4);
  CHECK(bounds(job.mesh).left == Approx(ink.left));
  job.scene.set(job.text, nodes::text::maxExtent, 100.0);
  width_is(1, 4);
  job.scene.set(job.text, nodes::text::maxExtent, 2 * h.advance);
  width_is(0.5, 4);
  CHECK(bounds(job.mesh).left == Approx(0.5 * ink.left));
  job.scene.set(job.text, nodes::text::maxExtent, 0.0);
  job.scene.set(job.text, nodes::text::length, std::vector<double>{40 * h.advance, 0, 7, -1});
  width_is(10, 4);
  job.scene.set(job.text, nodes::text::length, std::vector<double>{0, 60 * h.advance});
  auto b = bounds(job.make());
  CHECK(b.right == Approx(30 * (h.advance + ink.right)));
  CHECK(b.left == Approx(ink.left));
  // vertical: the characters are `size` high each
  job.scene.set(job.style, fields::horizontal, false);
  job.scene.set(job.text, nodes::text::length, std::vector<double>{8, 0, 0, 0});
  b = bounds(job.make());
  CHECK(b.top == Approx(ink.top - font->ascent()));
  CHECK(b.bottom == Approx(-6 + 2 * (ink.bottom - font->ascent())));
}

TEST_CASE("normals, sides and texture coordinates", "[text]") {
  Job job;
  job.strings({"Ag", "g"});
  namespace fields = nodes::font_style;
  job.scene.set(job.style, fields::size, 4.0);
  job.scene.set(job.style, fields::justify, std::vector<std::string_view>{"MIDDLE", "END"});
  const Mesh& mesh = job.make();
  auto* font = Fonts::installed().find(FontFamily::serif, false, false);
  CHECK(mesh.is_triangles());
  CHECK(mesh.primitive);
  CHECK(!mesh.solid);
  CHECK(mesh.ccw);
  CHECK(all_face_up(flat(mesh)));
  REQUIRE(mesh.normal.index.size() == mesh.corners.size());
  REQUIRE(mesh.texcoord.index.size() == mesh.corners.size());
  CHECK(mesh.normal.values == std::vector<float>{0, 0, 1});
  double x0 = -2 * (font->glyph('A')->advance + font->glyph('g')->advance), y0 = 4 + 4 * (1 - font->ascent());
  for (std::size_t i = 0; i < mesh.corners.size(); ++i) {
    const double* p = mesh.positions.data() + 3 * mesh.corners[i];
    const float* t = mesh.texcoord.at(mesh.texcoord.index[i]);
    CHECK(p[2] == 0);
    CHECK(t[0] == Approx((p[0] - x0) / 4).margin(1e-6));
    CHECK(t[1] == Approx((p[1] - y0) / 4).margin(1e-6));
    CHECK(mesh.normal.index[i] == 0);
  }
  // What comes out is fit for the passes that follow.
  MeshJob next{job.scene, job.text, job.mesh, job.scratch, job.ctx};
  CHECK(triangulate(next, {}) == Outcome::unchanged);
  CHECK(job.diag.messages().empty());
}

TEST_CASE("letters have their holes", "[text]") {
  Job job;
  for (auto family : {"SERIF", "SANS", "TYPEWRITER"})
    for (auto style : {"PLAIN", "BOLD", "ITALIC", "BOLDITALIC"}) {
      job.scene.set(job.style, nodes::font_style::family, std::vector<std::string_view>{family});
      job.scene.set(job.style, nodes::font_style::style, style);
      job.strings({"O"});
      auto o = flat(job.make());
      auto b = bounds(job.mesh);
      CHECK(covered(o, {(b.left + b.right) / 2 + 1e-5, (b.bottom + b.top) / 2 + 1e-5}) == 0);
      CHECK(covered(o, {b.left + 0.08 * (b.right - b.left), (b.bottom + b.top) / 2 + 1e-5}) == 1);
      CHECK(area(o) < 0.85 * 0.7854 * (b.right - b.left) * (b.top - b.bottom));
      CHECK(area(o) > 0.1 * (b.right - b.left) * (b.top - b.bottom));
      job.strings({"I"});
      job.make();
      b = bounds(job.mesh);
      auto i = flat(job.mesh);
      CHECK(covered(i, {(b.left + b.right) / 2 + 1e-5, (b.bottom + b.top) / 2 + 1e-5}) == 1);
    }
}

TEST_CASE("families and styles choose the font", "[text]") {
  auto& fonts = Fonts::installed();
  Job job;
  job.strings({"Hg"});
  auto ink = [&](const std::vector<std::string_view>& family, std::string_view style) {
    job.scene.set(job.style, nodes::font_style::family, family);
    job.scene.set(job.style, nodes::font_style::style, style);
    return area(flat(job.make()));
  };
  auto expected = [&](FontFamily family, bool bold, bool italic) {
    auto* font = fonts.find(family, bold, italic);
    double sum = 0;
    for (char c : {'H', 'g'}) sum += area({font->glyph(char32_t(c))->points, font->glyph(char32_t(c))->triangles});
    return Approx(sum);
  };
  CHECK(ink({}, "") == expected(FontFamily::serif, false, false));
  CHECK(ink({""}, "PLAIN") == expected(FontFamily::serif, false, false));
  CHECK(ink({"SANS"}, "BOLD") == expected(FontFamily::sans, true, false));
  CHECK(ink({"TYPEWRITER", "SANS"}, "ITALIC") == expected(FontFamily::typewriter, false, true));
  CHECK(ink({"Wingdings", "SERIF"}, "BOLDITALIC") == expected(FontFamily::serif, true, true));
  CHECK(ink({"Arial"}, "BOLD") == expected(FontFamily::sans, true, false));
  CHECK(ink({"Wingdings"}, "LIGHT") == expected(FontFamily::serif, false, false));
  CHECK(ink({"SANS"}, "BOLD") > 1.2 * ink({"SANS"}, "PLAIN"));
}

TEST_CASE("an italic that is not there is the upright font, slanted", "[text]") {
  TempFolder folder;
  std::filesystem::copy_file("/usr/share/fonts/truetype/dejavu/DejaVuSans-Bold.ttf",
                             folder.path() / "DejaVuSans-Bold.ttf");
  Fonts fonts({folder.path().string()});
  auto *upright = fonts.find(FontFamily::sans, true, false), *italic = fonts.find(FontFamily::sans, true, true);
  REQUIRE(upright);
  REQUIRE(italic);
  auto &u = upright->glyph('L')->points, &i = italic->glyph('L')->points;
  REQUIRE(u.size() == i.size());
  for (std::size_t k = 0; k < u.size(); ++k) {
    CHECK(i[k][0] == Approx(u[k][0] + 0.2 * u[k][1]));
    CHECK(i[k][1] == u[k][1]);
  }
  CHECK(fonts.find(FontFamily::sans, false, false) == upright);
  CHECK(fonts.find(FontFamily::serif, true, false) == upright);
}

TEST_CASE("UTF-8, good and bad", "[text]") {
  Job job;
  auto mesh_of = [&](std::string_view s) {
    job.strings({s});
    auto f = flat(job.make());
    return f.points;
  };
  CHECK(mesh_of("\xc3\x84").size() > mesh_of("A").size());  // A with two dots
  CHECK(mesh_of("\xd0\x96\xce\xa9") != mesh_of("\xce\xa9\xd0\x96"));
  const std::string bad = "\xef\xbf\xbd";  // what stands for an invalid byte
  REQUIRE(!mesh_of(bad).empty());
  CHECK(mesh_of("a\xff"
                "b") == mesh_of("a" + bad + "b"));
  CHECK(mesh_of("a\x80"
                "b") == mesh_of("a" + bad + "b"));
  CHECK(mesh_of("a\xc3") == mesh_of("a" + bad));
  CHECK(mesh_of("a\xf0\x9f\x98") == mesh_of("a" + bad + bad + bad));
  CHECK(mesh_of("\xc0\xaf") == mesh_of(bad + bad));            // '/' in too many bytes
  CHECK(mesh_of("\xed\xa0\x80") == mesh_of(bad + bad + bad));  // half of a surrogate pair
  CHECK(mesh_of("\xf5\x80\x80\x80") == mesh_of(bad + bad + bad + bad));
  CHECK(mesh_of("\xe4\xb8\xad") == mesh_of("\xe5\x9b\xbd"));  // not in DejaVu: the same box for both
  CHECK(mesh_of("a\nb\x01\x7f") == mesh_of("ab"));
  CHECK(mesh_of("a\tb") == mesh_of("a b"));
  CHECK(job.diag.count(Diag::missing_glyph) == 2);  // of those two
  CHECK(job.diag.messages().size() == 2);
}

TEST_CASE("Arabic letters join, Hebrew ones run from right to left", "[text]") {
  if (!can_shape()) return;
  Job job;
  const auto box = [&](std::string_view s) {
    job.strings({s});
    return bounds(job.make());
  };
  // Seen, lam, alef, meem: lam and alef are one glyph, and seen and meem have shorter forms.
  const auto word = box("\u0633\u0644\u0627\u0645");
  double alone = 0;
  for (const auto* letter : {"\u0633", "\u0644", "\u0627", "\u0645"}) alone += box(letter).right;
  CHECK(word.right > 0);
  CHECK(word.right < 0.85 * alone);
  // Qof, which is read first, has a foot below the line.
  job.strings({"\u05e7  \u05d0"});  // qof, alef
  const Mesh& mesh = job.make();
  double lowest = 0, where = 0;
  for (std::size_t i = 0; i < mesh.positions.size(); i += 3)
    if (mesh.positions[i + 1] < lowest) {
      lowest = mesh.positions[i + 1];
      where = mesh.positions[i];
    }
  CHECK(lowest < -0.1);  // the foot of qof
  CHECK(where > bounds(mesh).right / 2);
  CHECK(job.diag.messages().empty());
}

TEST_CASE("runs of a line by UAX #9", "[text]") {
  if (!can_shape()) return;
  const auto runs = [](std::u32string_view line, std::optional<bool> right_to_left) {
    std::string out;
    for (const auto& r : visual_runs(line, std::vector<std::uint32_t>(line.size(), 0), right_to_left))
      out += std::to_string(r.begin) + "-" + std::to_string(r.end) + (r.right_to_left ? "< " : "> ");
    return out;
  };
  CHECK(runs(U"A (\u05d0\u05d1) B", {}) == "0-3> 3-5< 5-8> ");
  CHECK(runs(U"\u05d0\u05d1 12", {}) == "3-5> 0-3< ");
  CHECK(runs(U"A \u05d0", true) == "1-3< 0-1> ");
  CHECK(runs(U"", {}).empty());
  CHECK(needs_shaping(U'\u0633'));
  for (const char32_t c : {U'A', U'\u00c4', U'\u03a9', U'\u0416', U'\u4e2d', U'\u1e00', U'\u2013'})
    CHECK_FALSE(needs_shaping(c));
}

TEST_CASE("letters that DejaVu lacks come from a font of their script, or its package is named", "[text]") {
  const TempFolder folder;
  const std::string dejavu = "/usr/share/fonts/truetype/dejavu/";
  std::filesystem::copy(dejavu + "DejaVuSansMono.ttf", folder / "DejaVuSansMono.ttf");
  Fonts without({folder.path().string()});
  Job job;
  job.strings({"\u05d0"});
  const auto box = flat(job.make(without)).points;
  REQUIRE(job.diag.count(Diag::missing_glyph) == 1);
  CHECK(job.diag.messages()[0].text().find("U+05D0 (the Debian package fonts-noto-core has one)") != std::string::npos);
  std::filesystem::copy(dejavu + "DejaVuSans.ttf", folder / "NotoSansHebrew-Regular.ttf");
  Fonts with({folder.path().string()});
  CHECK(flat(job.make(with)).points != box);
  CHECK(job.diag.count(Diag::missing_glyph) == 1);
  CHECK_FALSE(with.find_for(U'\u05d0') == nullptr);
  CHECK(with.find_for(U'\u4e2d') == nullptr);
  CHECK(with.find_for(U'A') == nullptr);
}

TEST_CASE("empty texts are empty", "[text]") {
  Job job;
  for (auto& s : std::vector<std::vector<std::string_view>>{{}, {""}, {"", ""}, {" "}, {"  ", "", "\n"}}) {
    job.strings(s);
    const Mesh& mesh = job.make();
    CHECK(mesh.kind == Mesh::Kind::faces);
    CHECK(mesh.n_faces() == 0);
    CHECK(mesh.is_triangles());
    CHECK(mesh.positions.empty());
  }
  CHECK(job.diag.messages().empty());
  job.strings({"x"});
  for (double size : {0.0, std::nan(""), HUGE_VAL}) {
    job.scene.set(job.style, nodes::font_style::size, size);
    CHECK(job.make().n_faces() == 0);
  }
  CHECK(job.diag.count(Diag::degenerate_geometry) == 3);
  job.scene.set(job.style, nodes::font_style::size, -2.0);
  CHECK(all_face_up(flat(job.make())));
  CHECK(!job.mesh.corners.empty());
}

TEST_CASE("too much text is cut off", "[text]") {
  Job job;
  std::string line(60'000, '-');
  job.strings({line, line, line});
  const Mesh& mesh = job.make();
  CHECK(mesh.n_faces() == 200'000);
  CHECK(bounds(mesh).bottom > -2);
  REQUIRE(job.diag.count(Diag::expansion_limit) == 1);
  CHECK(job.diag.messages()[0].text() == "more than 100000 characters in one Text node; the rest is dropped");
}

TEST_CASE("without a font there is a message and no text", "[text]") {
  Job job;
  job.strings({"x"});
  TempFolder folder;
  Fonts none({folder.path().string(), "/nowhere/at/all"});
  CHECK(job.make(none).n_faces() == 0);
  CHECK(job.diag.count(Diag::no_font) == 1);
  job.strings({""});
  job.make(none);
  CHECK(job.diag.count(Diag::no_font) == 1);
}

TEST_CASE("broken fonts do no harm", "[text]") {
  TempFolder folder;
  std::filesystem::copy_file("/usr/share/fonts/truetype/dejavu/DejaVuSansMono.ttf", folder.path() / "good.ttf");
  const std::string good = folder.read("good.ttf");
  Job job;
  job.strings({"The quick brown fox, 0123456789!", "\xc3\x84\xc3\x96\xc3\x9c%&@"});
  auto try_font = [&](const std::string& bytes) {
    folder.write("DejaVuSerif.ttf", bytes);
    Fonts fonts({folder.path().string()});
    job.make(fonts);
  };
  try_font(good);
  auto faces = job.mesh.n_faces();
  CHECK(faces > 500);
  try_font("");
  CHECK(job.mesh.n_faces() == 0);
  try_font("not a font");
  try_font(good.substr(0, good.size() / 2));
  std::mt19937 random(1);
  for (int k = 0; k < 100; ++k) {
    auto bad = good;
    for (int i = 0; i < 2000; ++i) bad[random() % bad.size()] = static_cast<char>(random());
    try_font(bad);
  }
  CHECK(job.mesh.n_faces() < 10 * faces);
}

TEST_CASE("threads share fonts", "[text]") {
  const char* folder = "/usr/share/fonts/truetype/dejavu";
  std::vector<std::string_view> strings{"The quick brown fox jumps over the lazy dog.", "\xc3\x84\xc3\x96\xc3\x9c @%&"};
  Job alone;
  alone.strings(strings);
  Fonts own({folder});
  alone.make(own);
  Fonts shared({folder});
  std::vector<Job> jobs(4);
  std::vector<std::thread> threads;
  for (auto& job : jobs) {
    job.strings(strings);
    threads.emplace_back([&] { job.make(shared); });
  }
  for (auto& t : threads) t.join();
  for (auto& job : jobs) {
    CHECK(job.mesh.corners == alone.mesh.corners);
    CHECK(std::ranges::equal(job.mesh.positions.span(), alone.mesh.positions.span()));
  }
}
