// The page of compare-lod.
#include <fmt/format.h>

#include <cmath>
#include <iterator>
#include <numbers>

#include "base/text/base64.h"
#include "base/text/xml_text.h"
#include "tools/report/chart.h"
#include "tools/report/comparison.h"
#include "tools/report/report_frame.h"

namespace wrlkit {
namespace {

double in_degrees(double radians) { return radians * 180 / std::numbers::pi; }

class Page {
 public:
  explicit Page(const Comparison& c) : c_(c) {}

  std::optional<std::string> write(std::string& why) {
    head();
    charts();
    pictures();
    figures();
    out_ += report_end();
    why = why_;
    return why_.empty() ? std::optional(std::move(out_)) : std::nullopt;
  }

 private:
  template <class... T>
  void put(fmt::format_string<T...> format, T&&... values) {
    fmt::format_to(std::back_inserter(out_), format, std::forward<T>(values)...);
  }

  void head() {
    out_ += report_begin(fmt::format("{} simplified", c_.model));
    put("<p>{} triangles, fewer and fewer by each criterion.</p>\n", c_.n_faces);
    picture(c_.picture, "model", fmt::format("<b>the model</b>, {} triangles", c_.n_faces));
  }

  void picture(const Image& image, std::string_view css, std::string_view caption) {
    auto png = encode_png(image, why_);
    if (png)
      put("<figure class=\"{}\"><img width=\"{}\" height=\"{}\" alt=\"\" "
          "src=\"data:image/png;base64,{}\"><figcaption>{}</figcaption></figure>\n",
          css, image.width, image.height, base64(*png), caption);
  }

  void charts() {
    put("<h2>How far, how fast</h2>\n<p>Distances are measured from both surfaces to the other, in the unit of the "
        "geometry. What is "
        "lower is better; what lies on the lower edge is less than can be shown. Time is of the processor, for the "
        "collapses from the model on.</p>\n<ul class=\"keys\">");
    for (std::size_t k = 0; k < c_.criteria.size(); ++k)
      put("<li>{}{}</li>", chart_mark(k), xml_text(c_.criteria[k].name));
    put("</ul>\n<div class=\"charts\">\n");
    chart("Distance, root of the mean square", "", [](const InteractionPoint& p) { return p.rms; });
    chart("Distance, largest", "", [](const InteractionPoint& p) { return p.error; });
    chart("Angle between normals, mean, in degrees", "degrees",
          [](const InteractionPoint& p) { return in_degrees(p.normals); });
    chart("Time, in seconds", "s", [](const InteractionPoint& p) { return p.seconds; });
    put("</div>\n");
  }

  void chart(std::string_view title, std::string_view unit, auto&& value) {
    std::vector<ChartSeries> series;
    for (const auto& criterion : c_.criteria) {
      auto& s = series.emplace_back(ChartSeries{criterion.name, {}});
      for (const auto& p : criterion.points)
        if (p.n_faces > 0 && p.n_faces < c_.n_faces && std::isfinite(value(p)))
          s.points.push_back({static_cast<double>(p.n_faces), value(p)});
    }
    put("<figure><figcaption><b>{}</b></figcaption>\n{}</figure>\n", title, log_chart(title, unit, series));
  }

  void pictures() {
    put("<h2>How it looks</h2>\n");
    for (std::size_t i = 0; i < c_.counts.size(); ++i) {
      put("<h3>{} triangles</h3>\n<div class=\"pictures\">\n", c_.counts[i]);
      for (const auto& criterion : c_.criteria)
        if (i < criterion.points.size()) {
          const auto& p = criterion.points[i];
          picture(criterion.pictures[i], "",
                  fmt::format("<b>{}</b>, {} triangles, rms {:.3g}", xml_text(criterion.name), p.n_faces, p.rms));
        }
      put("</div>\n");
    }
  }

  void figures() {
    put("<h2>Figures</h2>\n{}<tr><th "
        "class=\"text\">criterion</th><th>triangles</th><th>rms</th><th>max</th><th>normals, "
        "degrees</th><th>seconds</th></tr>\n",
        table_begin("Figures"));
    for (const auto& criterion : c_.criteria)
      for (const auto& p : criterion.points)
        put("<tr><td "
            "class=\"text\">{}</td><td>{}</td><td>{:.3g}</td><td>{:.3g}</td><td>{:.2g}</td><td>{:.3f}</td></tr>\n",
            xml_text(criterion.name), p.n_faces, p.rms, p.error, in_degrees(p.normals), p.seconds);
    out_ += table_end();
  }

  const Comparison& c_;
  std::string out_, why_;
};

}  // namespace

std::optional<std::string> comparison_page(const Comparison& c, std::string& why) { return Page(c).write(why); }

}  // namespace wrlkit
