#include "writers/patches/patches.h"

#include <cmath>

#include "base/text/xml_text.h"

namespace wrlkit {
namespace {

namespace word = patch_words;
constexpr int coordinate_digits = 12, radiance_digits = 6;

class PatchWriter {
 public:
  explicit PatchWriter(const Sink& sink) : out_(sink) {}

  void write(const PatchSet& set) {
    out_ << "<?xml version=\"1.0\" encoding=\"UTF-8\"?>\n";
    open("", word::patches);
    text(word::version, "1");
    if (!set.source.empty()) text(word::source, set.source);
    text(word::unit, "m");
    if (!set.method.empty()) text(word::method, set.method);
    if (set.samples) integer(word::samples, set.samples);
    out_ << ">\n";
    for (std::size_t s = 0; s < set.shapes.size(); ++s) write_shape(set, s);
    close("", word::patches);
  }

 private:
  void write_shape(const PatchSet& set, std::size_t s) {
    const auto& shape = set.shapes[s];
    open("  ", word::shape);
    if (!shape.name.empty()) text(word::name, shape.name);
    if (shape.index != PatchSet::unknown) integer(word::index, shape.index);
    out_ << ">\n";
    for (std::size_t t = shape.first_triangle; t < set.end_of_shape(s); ++t) write_triangle(set, t);
    close("  ", word::shape);
  }

  void write_triangle(const PatchSet& set, std::size_t t) {
    const auto& triangle = set.triangles[t];
    if (triangle.given) {
      open("    ", word::triangle);
      if (triangle.index != PatchSet::unknown) integer(word::index, triangle.index);
      corners(triangle.corners);
      out_ << ">\n";
    }
    for (const auto& p : set.patches_of(t)) write_patch(p, triangle.given ? "      " : "    ");
    if (triangle.given) close("    ", word::triangle);
  }

  void write_patch(const Patch& p, std::string_view indent) {
    open(indent, word::patch);
    if (p.back) text(word::side, word::back);
    corners(p.corners);
    begin(word::rgb);
    for (std::size_t i = 0; i < 3; ++i) number(i, p.rgb[i], radiance_digits);
    out_ << "\"/>\n";
  }

  void open(std::string_view indent, std::string_view element) { out_ << indent << '<' << element; }
  void close(std::string_view indent, std::string_view element) { out_ << indent << "</" << element << ">\n"; }
  void begin(std::string_view attribute) { out_ << ' ' << attribute << "=\""; }
  void text(std::string_view attribute, std::string_view value) {
    begin(attribute);
    out_ << xml_text(value) << '"';
  }
  void integer(std::string_view attribute, std::uint32_t value) {
    begin(attribute);
    out_.integer(value);
    out_ << '"';
  }
  void corners(const Corners& v) {
    begin(word::v);
    for (std::size_t i = 0; i < 9; ++i) number(i, v[i / 3][i % 3], coordinate_digits);
    out_ << '"';
  }
  void number(std::size_t i, double v, int digits) {
    if (i > 0) out_ << ' ';
    out_.number(std::isfinite(v) ? v : 0, digits);
  }

  TextOut out_;
};

}  // namespace

void write_patches(const PatchSet& set, const Sink& sink) { PatchWriter(sink).write(set); }

}  // namespace wrlkit
